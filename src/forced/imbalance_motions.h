#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "model/rotor.h"
#include "results/formulation.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace whirl::forced {

/// The steady motions of one rotor under several sets of imbalances, each set alone, on one mesh:
/// those that are there, and a unit imbalance in each of some planes, make all that weights in
/// these planes can do.
class ImbalanceMotions {
  public:
    using Imbalances = std::vector<model::Imbalance>;

    /// @param rotor  whose own imbalances count only where they are among the sets
    /// @param parts  of equal length for each element of the case
    ImbalanceMotions(const model::Rotor &rotor, int order, results::Form form,
                     const std::vector<Imbalances> &sets, int parts = 1);

    /// False at a resonance without damping, where one of the motions has no limit.
    [[nodiscard]] bool solve(double speed);
    /// The same without asking how far rounding goes: to compare with.
    [[nodiscard]] bool solve_unjudged(double speed);

    /// Under one of the sets, at the speed solved last; until another is asked for.
    [[nodiscard]] const ForcedMotion &of(std::size_t set) {
        _motion.look_at(set);
        return _motion;
    }
    [[nodiscard]] const assembly::Discretization &discretization() const { return *_mesh; }
    /// Relative error of the last solution by rounding, of all sets the largest.
    [[nodiscard]] double rounding() const { return _rounding; }

  private:
    std::unique_ptr<assembly::Discretization> _mesh;
    ForcedMotion _motion;
    double _rounding = 0; ///< of the solution judged last
};

} // namespace whirl::forced

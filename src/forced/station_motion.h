#pragma once

#include "forced/condensed/condensed_motion.h"
#include "forced/forced_motion.h"
#include "results/formulation.h"

#include <optional>

namespace whirl::forced {

/// Steady motion like ForcedMotion under the imbalances, looked at where something is attached to
/// the shaft: all other nodes are eliminated (CondensedMotion) unless that may leave more rounding
/// than is acceptable; then, and where something acts across elements, by the whole system.
class StationMotion {
  public:
    static constexpr double usual_rounding = 1e-8;

    /// @param discretization  must outlive this
    /// @param acceptable      relative rounding
    StationMotion(const assembly::Discretization &discretization, results::Form form,
                  const Drive &drive = {}, double acceptable = usual_rounding);

    /// @throws linalg::SolverError where the rotor is at an undamped resonance.
    void solve(double speed);

    /// At a place where something is attached, in the last solution.
    [[nodiscard]] Phasor at(double z) const;
    [[nodiscard]] Phasor bearing_force(int bearing) const;
    /// Of the shaft in a bearing, from the pedestal where there is one.
    [[nodiscard]] Phasor stretch(int bearing) const;
    [[nodiscard]] Phasor of(const Quantity &quantity) const;
    /// Relative error of the last solution by rounding.
    [[nodiscard]] double rounding() const { return _rounding; }

    /// The whole system, solved at the speed of the last solution.
    [[nodiscard]] const ForcedMotion &whole();
    /// Unknowns of the whole system.
    [[nodiscard]] int unknowns() const { return _whole.unknowns(); }

  private:
    const assembly::Discretization &_discretization;
    ForcedMotion _whole;
    std::optional<CondensedMotion> _condensed;
    double _acceptable;
    bool _by_whole = true; ///< the last solution
    double _speed = 0;
    double _rounding = 0;

    [[nodiscard]] bool condensed(double speed);
    void solve_whole();
};

} // namespace whirl::forced

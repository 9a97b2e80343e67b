#pragma once

#include "balancers/arrangement.h"
#include "stability/hill/motions.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::stability {

class PeriodicMotions;
struct StabilityModel;

/// Free motions of one rotor of form hill at any spin speed, for questions of stability: by the
/// monodromy matrix, or by Hill's series where the rotor is not to be reduced.
class HillSolver {
  public:
    /// @param model        whose `harmonics` are those to begin with: every speed is solved with as
    ///                     many as it needs; none: by the monodromy matrix
    /// @param arrangement  where the balls of each balancer stand
    /// @param shapes       for the monodromy matrix (PeriodicMotions), or none
    HillSolver(const StabilityModel &model, const balancers::Arrangement &arrangement,
               std::shared_ptr<const Eigen::MatrixXd> shapes = nullptr);
    ~HillSolver();
    HillSolver(const HillSolver &) = delete;
    HillSolver &operator=(const HillSolver &) = delete;
    HillSolver(HillSolver &&) = delete;
    HillSolver &operator=(HillSolver &&) = delete;

    /// All motions that count at the speed (HillMotions, PeriodicMotions), by the series each once,
    /// at its place next to zero.
    /// @throws model::AnalysisFailure where they cannot be found, or a Hill series does not settle.
    [[nodiscard]] std::vector<Motion> at(double speed) const;

    /// How the monodromy matrix gives them; none where the series does.
    [[nodiscard]] const PeriodicMotions *by_monodromy() const;

    /// Real unknowns of the eigenproblem, the largest so far.
    [[nodiscard]] int unknowns() const;
    /// Most harmonics of the series that a speed so far needed; 0: by the monodromy matrix.
    [[nodiscard]] int harmonics() const;

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

} // namespace whirl::stability

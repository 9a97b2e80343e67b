#pragma once

#include "ends/all_motions.h"
#include "stability/hill/hill_solver.h"
#include "stability/rotor_at_speeds.h"

#include <memory>
#include <optional>
#include <vector>

namespace whirl::ends {

/// Growth of one rotor at any speeds of a range, in every form: that of the motion that grows most
/// there. Forms general and rotating by AllMotions, Hill's by its own solver.
class Growth {
  public:
    /// On planar shapes that are found for these speeds.
    /// @param speeds  ascending, over the range
    Growth(const stability::StabilityModel &model, const balancers::Arrangement &arrangement,
           const std::vector<double> &speeds);
    /// @param shapes  good for the range, or none: the whole rotor
    Growth(const stability::StabilityModel &model, const balancers::Arrangement &arrangement,
           std::shared_ptr<const Eigen::MatrixXd> shapes, const results::Interval &range);
    Growth(const Growth &) = delete; // the motions refer to the discretization
    Growth &operator=(const Growth &) = delete;

    /// Largest real part, 1/s; 0 where rounding hides whether it is one, not a number where a Hill
    /// series does not describe the speed.
    /// @throws model::AnalysisFailure, linalg::SolverError where motions are not found
    [[nodiscard]] double at(double speed) const;

    /// Of forms general and rotating.
    [[nodiscard]] const AllMotions &motions() const { return *_motions; }
    /// Of form hill.
    [[nodiscard]] const stability::HillSolver &hill() const { return *_hill; }

  private:
    double _from; ///< least |speed| that is described, rad/s
    assembly::Discretization _discretization;
    std::optional<AllMotions> _motions; ///< neither this nor the next: nothing can grow
    std::optional<stability::HillSolver> _hill;
};

} // namespace whirl::ends

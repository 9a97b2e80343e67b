#pragma once

#include "assembly/discretization.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::analyses {

/// The rotor without damping and without coupling between x and y in its bearings: its forward
/// synchronous motion is governed by a real symmetric pair, (K - Omega^2 A) u = f, whose signs can
/// be counted. Isotropic bearings: planar unknowns, A = M - G. Else: A = M - S in (x, i y), see
/// docs/theory.md, "The criterion on a flexible rotor".
class UndampedTwin {
  public:
    /// @param bearing_speed  at which bearing tables are read, rad/s
    UndampedTwin(const assembly::Discretization &rotor, bool planar, double bearing_speed);

    /// Synchronous critical speeds in (from, to), ascending, rad/s.
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<double> critical_speeds(double from, double to) const;

    /// The same with the forward motion of these combinations of planar unknowns held at zero.
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<double>
    pinned_critical_speeds(const std::vector<assembly::Combination> &places, double from,
                           double to) const;

  private:
    bool _planar;
    Eigen::SparseMatrix<double> _K;
    Eigen::SparseMatrix<double> _A;
};

/// Supports without damping and without coupling; tables and everything else as they are.
[[nodiscard]] model::Rotor without_damping(model::Rotor rotor);

/// Bearings isotropic, with the mean of the x and y coefficients; nothing changes for isotropic
/// ones.
[[nodiscard]] model::Rotor with_mean_bearings(model::Rotor rotor);

} // namespace whirl::analyses

#pragma once

#include "assembly/discretization.h"
#include "results/formulation.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::criterion {

/// The rotor without damping and with symmetric stiffness: its forward synchronous motion is
/// governed by a Hermitian pair, (K - Omega^2 A) u = f, whose signs can be counted. Forms:
/// planar: A = M - G. general: (x, i y), A = M - S; real where the bearings are orthotropic, and
/// K + i Kc with Kc = [0 -kxy; kxy 0] where they couple x and y. rotating: pairs (x, y) in rotating
/// axes, A = -Kss. hill: the same of the series. See docs/theory.md, "The criterion on a flexible
/// rotor".
class UndampedRotor {
  public:
    /// @param bearing_speed  at which bearing tables are read, rad/s
    /// @param harmonics      form hill: terms of the series in twice the spin speed
    UndampedRotor(const assembly::Discretization &rotor, results::Form form, double bearing_speed,
                  int harmonics = 0);

    /// Synchronous critical speeds in (from, to), ascending, rad/s.
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<double> critical_speeds(double from, double to) const;

    /// The same with the forward motion of these combinations of planar unknowns held at zero: in
    /// rotating axes the motion that stands still there.
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<double>
    pinned_critical_speeds(const std::vector<assembly::Combination> &places, double from,
                           double to) const;

  private:
    results::Form _form;
    Eigen::SparseMatrix<double> _K;
    Eigen::SparseMatrix<double> _K_imaginary; ///< skew; empty where nothing couples x and y
    Eigen::SparseMatrix<double> _A;

    [[nodiscard]] std::vector<double> roots(const Eigen::SparseMatrix<double> &motions, double from,
                                            double to) const;
};

} // namespace whirl::criterion

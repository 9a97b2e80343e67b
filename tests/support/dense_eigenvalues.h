#pragma once

#include "assembly/rotating_system.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace whirl::tests {

/// All eigenvalues of l^2 M + l D + K with regular M, by the companion matrix; both conjugates.
inline std::vector<std::complex<double>>
dense_eigenvalues(const Eigen::MatrixXd &M, const Eigen::MatrixXd &D, const Eigen::MatrixXd &K) {
    const Eigen::Index n = M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> mass(M);
    const Eigen::MatrixXd stiffness = mass.solve(K);
    // In units of the highest frequency, so that displacements and velocities are comparable.
    const double unit = std::sqrt(stiffness.cwiseAbs().rowwise().sum().maxCoeff());
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    state.topRightCorner(n, n).setIdentity();
    state.bottomLeftCorner(n, n) = -stiffness / (unit * unit);
    state.bottomRightCorner(n, n) = -mass.solve(D) / unit;
    const Eigen::VectorXcd values = unit * state.eigenvalues();
    return {values.begin(), values.end()};
}

inline std::vector<std::complex<double>> dense_eigenvalues(const assembly::RotatingSystem &system,
                                                           double speed) {
    return dense_eigenvalues(Eigen::MatrixXd(system.M.view()),
                             Eigen::MatrixXd(system.damping(speed).view()),
                             Eigen::MatrixXd(system.stiffness(speed).view()));
}

inline double largest_real_part(const std::vector<std::complex<double>> &values) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const auto value : values)
        largest = std::max(largest, value.real());
    return largest;
}

} // namespace whirl::tests

#pragma once

#include "stability/unstable_bands.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <functional>

namespace whirl::tests {

/// A system z' = A(speed) z.
using SystemAt = std::function<Eigen::MatrixXd(double)>;

/// Its motions by a dense eigensolver, both conjugates. Noise: rounding of the matrix, 1e-15 of its
/// norm, times the condition of the eigenvalue, and ten of that.
inline stability::MotionsAt motions_of(const SystemAt &system) {
    return [system](double speed) {
        const Eigen::MatrixXd A = system(speed);
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
        const Eigen::MatrixXcd left = solver.eigenvectors().inverse(); // its rows
        std::vector<stability::Motion> out;
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            stability::Motion motion;
            motion.value = solver.eigenvalues()(i);
            motion.state = solver.eigenvectors().col(i).normalized();
            motion.noise = 1e-14 * A.norm() * left.row(i).norm();
            out.push_back(motion);
        }
        return out;
    };
}

/// State matrix of M q'' + D q' + K q = 0, for q and q' over a frequency.
inline Eigen::MatrixXd state_matrix(const Eigen::Matrix2d &M, const Eigen::Matrix2d &D,
                                    const Eigen::Matrix2d &K, double frequency) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
    A.topRightCorner(2, 2) = frequency * Eigen::Matrix2d::Identity();
    A.bottomLeftCorner(2, 2) = -M.inverse() * K / frequency;
    A.bottomRightCorner(2, 2) = -M.inverse() * D;
    return A;
}

} // namespace whirl::tests

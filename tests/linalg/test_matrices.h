#pragma once

#include "linalg/matrix.h"

#include <Eigen/Dense>

#include <random>
#include <vector>

namespace whirl::tests {

inline linalg::Matrix matrix_of(const Eigen::MatrixXd &A) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < A.rows(); ++i)
        for (int j = 0; j < A.cols(); ++j)
            if (A(i, j) != 0)
                entries.emplace_back(i, j, A(i, j));
    return linalg::Matrix::from_entries(static_cast<int>(A.rows()), entries);
}

inline linalg::Matrix diagonal(const std::vector<double> &values) {
    return matrix_of(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<int>(values.size()))
            .asDiagonal()
            .toDenseMatrix());
}

/// Symmetric matrix of standard normal entries; the same for a seed.
inline Eigen::MatrixXd random_symmetric(int n, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd A(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            A(i, j) = normal(generator);
    return (A + A.transpose()) / 2;
}

/// Symmetric positive definite.
inline Eigen::MatrixXd random_definite(int n, unsigned seed) {
    const Eigen::MatrixXd A = random_symmetric(n, seed);
    return A * A + 0.1 * n * Eigen::MatrixXd::Identity(n, n);
}

} // namespace whirl::tests

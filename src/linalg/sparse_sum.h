#pragma once

#include <Eigen/SparseCore>

#include <complex>

namespace whirl::linalg {

// Sums of sparse matrices of one size, compiled once (see dense/products.h); all places that one of
// them stores are stored in the sum.

/// a A + b B + c C
[[nodiscard]] Eigen::SparseMatrix<double> sum(double a, const Eigen::SparseMatrix<double> &A,
                                              double b, const Eigen::SparseMatrix<double> &B,
                                              double c, const Eigen::SparseMatrix<double> &C);
[[nodiscard]] Eigen::SparseMatrix<std::complex<double>>
sum(std::complex<double> a, const Eigen::SparseMatrix<std::complex<double>> &A,
    std::complex<double> b, const Eigen::SparseMatrix<std::complex<double>> &B,
    std::complex<double> c, const Eigen::SparseMatrix<std::complex<double>> &C);
[[nodiscard]] Eigen::SparseMatrix<std::complex<double>>
sum(std::complex<double> a, const Eigen::SparseMatrix<double> &A, std::complex<double> b,
    const Eigen::SparseMatrix<double> &B, std::complex<double> c,
    const Eigen::SparseMatrix<double> &C);

} // namespace whirl::linalg

#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>

namespace whirl::linalg {

/// Q(l) = l^2 M + l D + K for many l: the entries of all three on the pattern of their sum.
class QuadraticPattern {
  public:
    using Sparse = Eigen::SparseMatrix<double>;
    using ComplexSparse = Eigen::SparseMatrix<std::complex<double>>;

    QuadraticPattern(const Sparse &M, const Sparse &D, const Sparse &K);

    /// Valid until the next call.
    [[nodiscard]] const ComplexSparse &at(std::complex<double> l);

    /// |y|^T (|l|^2 |M| + |l| |D| + |K|) |x|
    [[nodiscard]] double size(const Eigen::VectorXcd &y, double l, const Eigen::VectorXcd &x) const;

  private:
    Eigen::VectorXd _M, _D, _K;
    ComplexSparse _Q;
};

} // namespace whirl::linalg

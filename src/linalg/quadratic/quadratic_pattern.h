#pragma once

#include "linalg/lanes/complex4.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
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

    /// The pattern: all entries with their mirror images, and the diagonal.
    [[nodiscard]] const ComplexSparse &pattern() const { return _Q; }
    using Four = std::array<std::complex<double>, lanes>;
    /// Entries of Q at four l, in the order of the pattern.
    void set_values(const Four &l, Vector4 &out) const;
    /// Those of its derivative 2 l M + D.
    void set_slopes(const Four &l, Vector4 &out) const;
    /// Four matrices with such entries, or their transposes, times x.
    void multiply(const Vector4 &entries, const Vector4 &x, Vector4 &out) const;
    void multiply_transposed(const Vector4 &entries, const Vector4 &x, Vector4 &out) const;
    /// |y|^T (|l|^2 |M| + |l| |D| + |K|) |x|
    [[nodiscard]] double size(const Eigen::VectorXcd &y, double l, const Eigen::VectorXcd &x) const;

  private:
    Eigen::VectorXd _M, _D, _K;
    ComplexSparse _Q;
};

} // namespace whirl::linalg

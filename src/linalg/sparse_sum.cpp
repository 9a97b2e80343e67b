#include "linalg/sparse_sum.h"

namespace whirl::linalg {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

} // namespace

Sparse sum(double a, const Sparse &A, double b, const Sparse &B, double c, const Sparse &C) {
    return a * A + b * B + c * C;
}

ComplexSparse sum(Complex a, const ComplexSparse &A, Complex b, const ComplexSparse &B, Complex c,
                  const ComplexSparse &C) {
    return a * A + b * B + c * C;
}

ComplexSparse sum(Complex a, const Sparse &A, Complex b, const Sparse &B, Complex c,
                  const Sparse &C) {
    return a * A.cast<Complex>() + b * B.cast<Complex>() + c * C.cast<Complex>();
}

} // namespace whirl::linalg

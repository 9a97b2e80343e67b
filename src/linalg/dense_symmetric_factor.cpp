#include "linalg/dense_symmetric_factor.h"

#include "linalg/check.h"

#include <cmath>

namespace whirl::linalg {

namespace {

/// a -= f b for complex columns with their parts apart.
void subtract(Eigen::Index count, double f_re, double f_im, const double *b_re, const double *b_im,
              double *__restrict a_re, double *__restrict a_im) {
    for (Eigen::Index i = 0; i < count; ++i) {
        a_re[i] -= f_re * b_re[i] - f_im * b_im[i];
        a_im[i] -= f_re * b_im[i] + f_im * b_re[i];
    }
}

} // namespace

void DenseSymmetricFactor::factorize(const Eigen::MatrixXcd &A) {
    _re = A.real();
    _im = A.imag();
    const Eigen::Index n = _re.rows();
    for (Eigen::VectorXd *row : {&_row_re, &_row_im})
        row->resize(n);
    _inverse.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const std::complex<double> pivot(_re(k, k), _im(k, k));
        const double size = std::abs(pivot);
        if (!(size > 0) || !std::isfinite(size))
            throw SolverError("a pivot of the symmetric factorisation is zero");
        const std::complex<double> inverse = std::conj(pivot) / (size * size);
        _inverse(k) = inverse;
        const Eigen::Index below = n - k - 1;
        // The column times the inverse of the pivot is that of L.
        for (Eigen::Index i = k + 1; i < n; ++i) {
            _row_re(i) = _re(i, k) * inverse.real() - _im(i, k) * inverse.imag();
            _row_im(i) = _re(i, k) * inverse.imag() + _im(i, k) * inverse.real();
        }
        for (Eigen::Index j = k + 1; j < n; ++j)
            subtract(n - j, _row_re(j), _row_im(j), &_re(j, k), &_im(j, k), &_re(j, j), &_im(j, j));
        _re.col(k).tail(below) = _row_re.tail(below);
        _im.col(k).tail(below) = _row_im.tail(below);
    }
}

Eigen::VectorXcd DenseSymmetricFactor::solve(const Eigen::VectorXcd &b) const {
    const Eigen::Index n = _re.rows();
    Eigen::VectorXd re = b.real();
    Eigen::VectorXd im = b.imag();
    for (Eigen::Index k = 0; k + 1 < n; ++k)
        subtract(n - k - 1, re(k), im(k), &_re(k + 1, k), &_im(k + 1, k), &re(k + 1), &im(k + 1));
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        const std::complex<double> x(re(k) * _inverse(k).real() - im(k) * _inverse(k).imag(),
                                     re(k) * _inverse(k).imag() + im(k) * _inverse(k).real());
        const Eigen::Index below = n - k - 1;
        const auto L_re = _re.col(k).tail(below);
        const auto L_im = _im.col(k).tail(below);
        re(k) = x.real() - L_re.dot(re.tail(below)) + L_im.dot(im.tail(below));
        im(k) = x.imag() - L_re.dot(im.tail(below)) - L_im.dot(re.tail(below));
    }
    Eigen::VectorXcd out(n);
    out.real() = re;
    out.imag() = im;
    return out;
}

} // namespace whirl::linalg

#include "linalg/dense_symmetric_factor.h"

#include "linalg/check.h"

#include <limits>

namespace whirl::linalg {

namespace {

/// Parts of the columns of L, whose heights are those of the whole matrix, and of the inverse
/// pivots.
template <class Number> struct PartsOf {
    Eigen::Index size;
    Number *re, *im;
    Number *inverse_re, *inverse_im;
};
using Parts = PartsOf<double>;
using Factors = PartsOf<const double>;

// Inlined into each of the versions for one kind of machine below.
#define WHIRL_INLINED inline __attribute__((always_inline))

/// a -= f b for complex columns with their parts apart.
WHIRL_INLINED void subtract(Eigen::Index count, double f_re, double f_im, const double *b_re,
                            const double *b_im, double *__restrict a_re, double *__restrict a_im) {
    for (Eigen::Index i = 0; i < count; ++i) {
        a_re[i] -= f_re * b_re[i] - f_im * b_im[i];
        a_im[i] -= f_re * b_im[i] + f_im * b_re[i];
    }
}

/// @param row  room for two columns
/// @returns whether no pivot is zero or not a number
WHIRL_INLINED bool eliminate(const Parts &L, double *row_re, double *row_im) {
    const Eigen::Index n = L.size;
    for (Eigen::Index k = 0; k < n; ++k) {
        double *re = L.re + k * n;
        double *im = L.im + k * n;
        const double square = re[k] * re[k] + im[k] * im[k];
        if (!(square > 0) || !(square <= std::numeric_limits<double>::max()))
            return false;
        const double inverse_re = re[k] / square;
        const double inverse_im = -im[k] / square;
        L.inverse_re[k] = inverse_re;
        L.inverse_im[k] = inverse_im;
        // The column times the inverse of the pivot is that of L.
        for (Eigen::Index i = k + 1; i < n; ++i) {
            row_re[i] = re[i] * inverse_re - im[i] * inverse_im;
            row_im[i] = re[i] * inverse_im + im[i] * inverse_re;
        }
        for (Eigen::Index j = k + 1; j < n; ++j)
            subtract(n - j, row_re[j], row_im[j], re + j, im + j, L.re + j * n + j,
                     L.im + j * n + j);
        for (Eigen::Index i = k + 1; i < n; ++i) {
            re[i] = row_re[i];
            im[i] = row_im[i];
        }
    }
    return true;
}

/// @param re, im  the right side, then the solution
WHIRL_INLINED void substitute(const Factors &L, double *re, double *im) {
    const Eigen::Index n = L.size;
    for (Eigen::Index k = 0; k + 1 < n; ++k)
        subtract(n - k - 1, re[k], im[k], L.re + k * n + k + 1, L.im + k * n + k + 1, re + k + 1,
                 im + k + 1);
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        const double *L_re = L.re + k * n;
        const double *L_im = L.im + k * n;
        // Four sums each: the order is that of vector instructions.
        double sums[8] = {};
        Eigen::Index i = k + 1;
        for (; i + 4 <= n; i += 4)
            for (int p = 0; p < 4; ++p) {
                sums[p] += L_re[i + p] * re[i + p] - L_im[i + p] * im[i + p];
                sums[4 + p] += L_re[i + p] * im[i + p] + L_im[i + p] * re[i + p];
            }
        for (; i < n; ++i) {
            sums[0] += L_re[i] * re[i] - L_im[i] * im[i];
            sums[4] += L_re[i] * im[i] + L_im[i] * re[i];
        }
        const double x_re = re[k] * L.inverse_re[k] - im[k] * L.inverse_im[k];
        const double x_im = re[k] * L.inverse_im[k] + im[k] * L.inverse_re[k];
        re[k] = x_re - (sums[0] + sums[1] + sums[2] + sums[3]);
        im[k] = x_im - (sums[4] + sums[5] + sums[6] + sums[7]);
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) bool eliminate_wide(const Parts &L, double *row_re,
                                                        double *row_im) {
    return eliminate(L, row_re, row_im);
}
__attribute__((target("avx2,fma"))) void substitute_wide(const Factors &L, double *re, double *im) {
    substitute(L, re, im);
}
/// Vectors of four numbers, as on most machines: twice as fast as those that any has.
bool wide() {
    static const bool found = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return found;
}
#else
bool eliminate_wide(const Parts &L, double *row_re, double *row_im) {
    return eliminate(L, row_re, row_im);
}
void substitute_wide(const Factors &L, double *re, double *im) { substitute(L, re, im); }
bool wide() { return false; }
#endif

bool eliminate_plain(const Parts &L, double *row_re, double *row_im) {
    return eliminate(L, row_re, row_im);
}
void substitute_plain(const Factors &L, double *re, double *im) { substitute(L, re, im); }

} // namespace

void DenseSymmetricFactor::factorize(const Eigen::MatrixXd &re, const Eigen::MatrixXd &im) {
    _re = re;
    _im = im;
    const Eigen::Index n = _re.rows();
    for (Eigen::VectorXd *column : {&_row_re, &_row_im, &_inverse_re, &_inverse_im})
        column->resize(n);
    const Parts L{n, _re.data(), _im.data(), _inverse_re.data(), _inverse_im.data()};
    if (!(wide() ? eliminate_wide : eliminate_plain)(L, _row_re.data(), _row_im.data()))
        throw SolverError("a pivot of the symmetric factorisation is zero");
}

Eigen::VectorXcd DenseSymmetricFactor::solve(const Eigen::VectorXcd &b) const {
    Eigen::VectorXd re = b.real();
    Eigen::VectorXd im = b.imag();
    const Factors L{_re.rows(), _re.data(), _im.data(), _inverse_re.data(), _inverse_im.data()};
    (wide() ? substitute_wide : substitute_plain)(L, re.data(), im.data());
    Eigen::VectorXcd out(b.size());
    out.real() = re;
    out.imag() = im;
    return out;
}

} // namespace whirl::linalg

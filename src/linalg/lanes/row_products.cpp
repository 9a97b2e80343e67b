#include "linalg/lanes/row_products.h"

#include "linalg/check.h"
#include "linalg/lanes/complex4.h"

#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace whirl::linalg {

namespace {

using Eigen::Index;

/// A row of a product.
struct RowOfProduct {
    const double *a; ///< row of the left factor
    const RowsIn &B;
    bool add;
    double *out;

    template <int vectors> WHIRL_INLINED void operator()(Index from) const {
        std::array<Real4, vectors> sum{};
        for (int v = 0; add && v < vectors; ++v)
            load(sum[v], out + from + lanes * v);
        const double *b = B.data() + from;
        for (Index k = 0; k < B.rows(); ++k, b += B.outerStride()) {
            const double f = a[k];
            const Real4 factor{f, f, f, f};
            for (int v = 0; v < vectors; ++v) {
                Real4 next;
                load(next, b + lanes * v);
                sum[v] += factor * next;
            }
        }
        for (int v = 0; v < vectors; ++v)
            store(sum[v], out + from + lanes * v);
    }

    WHIRL_INLINED void one(Index column) const {
        double sum = add ? out[column] : 0;
        for (Index k = 0; k < B.rows(); ++k)
            sum += a[k] * B.data()[k * B.outerStride() + column];
        out[column] = sum;
    }
};

void multiply(const RowsIn &A, const RowsIn &B, bool add, RowsOut &out) {
    in_lanes([&]() __attribute__((always_inline)) {
        for (Index row = 0; row < A.rows(); ++row) {
            const RowOfProduct work{A.data() + row * A.outerStride(), B, add,
                                    out.data() + row * out.outerStride()};
            for (Index at = along_row(0, B.cols(), work); at < B.cols(); ++at)
                work.one(at);
        }
    });
}

/// to -= factor from
WHIRL_INLINED void subtract(double factor, const double *from, Index count, double *to) {
    for (Index i = 0; i < count; ++i)
        to[i] -= factor * from[i];
}

/// Right sides, by rows, through L and U.
struct Substitution {
    const Eigen::MatrixXcd &lu;
    const Eigen::VectorXcd &inverse; ///< of the diagonal
    double *re;
    double *im;
    Index apart; ///< from row to row

    template <int vectors> WHIRL_INLINED void operator()(Index from) const {
        const Index n = lu.rows();
        for (Index row = 1; row < n; ++row)
            subtract_rows<vectors>(row, 0, row, 1, from);
        for (Index row = n - 1; row >= 0; --row)
            subtract_rows<vectors>(row, row + 1, n, inverse(row), from);
    }

  private:
    /// Row less those from the first on by their entries, times a factor.
    template <int vectors>
    WHIRL_INLINED void subtract_rows(Index row, Index first, Index last,
                                     std::complex<double> factor, Index from) const {
        double *own_re = re + row * apart + from;
        double *own_im = im + row * apart + from;
        std::array<Real4, vectors> p;
        std::array<Real4, vectors> q;
        for (int v = 0; v < vectors; ++v) {
            load(p[v], own_re + lanes * v);
            load(q[v], own_im + lanes * v);
        }
        for (Index k = first; k < last; ++k) {
            const std::complex<double> entry = lu.data()[k * lu.rows() + row];
            const Real4 a{entry.real(), entry.real(), entry.real(), entry.real()};
            const Real4 b{entry.imag(), entry.imag(), entry.imag(), entry.imag()};
            for (int v = 0; v < vectors; ++v) {
                Real4 x;
                Real4 y;
                load(x, re + k * apart + from + lanes * v);
                load(y, im + k * apart + from + lanes * v);
                p[v] += b * y - a * x;
                q[v] -= b * x + a * y;
            }
        }
        const Real4 c{factor.real(), factor.real(), factor.real(), factor.real()};
        const Real4 d{factor.imag(), factor.imag(), factor.imag(), factor.imag()};
        for (int v = 0; v < vectors; ++v) {
            store(c * p[v] - d * q[v], own_re + lanes * v);
            store(c * q[v] + d * p[v], own_im + lanes * v);
        }
    }
};

} // namespace

void set_product(const RowsIn &A, const RowsIn &B, RowsOut out) { multiply(A, B, false, out); }

void add_product(const RowsIn &A, const RowsIn &B, RowsOut out) { multiply(A, B, true, out); }

void solve_beside(Rows &both) {
    const Index n = both.rows();
    const Index columns = both.cols();
    bool singular = false;
    in_lanes([&]() __attribute__((always_inline)) {
        double *A = both.data();
        for (Index k = 0; k < n; ++k) {
            Index pivot = k;
            for (Index i = k + 1; i < n; ++i)
                if (std::abs(A[i * columns + k]) > std::abs(A[pivot * columns + k]))
                    pivot = i;
            if (A[pivot * columns + k] == 0) {
                singular = true;
                return;
            }
            for (Index j = k; pivot != k && j < columns; ++j)
                std::swap(A[k * columns + j], A[pivot * columns + j]);
            const double inverse = 1 / A[k * columns + k];
            for (Index i = k + 1; i < n; ++i)
                subtract(A[i * columns + k] * inverse, A + k * columns + k + 1, columns - k - 1,
                         A + i * columns + k + 1);
        }
        for (Index k = n - 1; k >= 0; --k) {
            double *solved = A + k * columns;
            for (Index j = n; j < columns; ++j)
                solved[j] /= solved[k];
            for (Index i = 0; i < k; ++i)
                subtract(A[i * columns + k], solved + n, columns - n, A + i * columns + n);
        }
    });
    if (singular)
        throw SolverError("a dense linear system is singular");
}

RowSolver::RowSolver(const Eigen::MatrixXcd &A)
    : _lu(A), _inverse(_lu.matrixLU().diagonal().cwiseInverse()) {}

void RowSolver::solve(RowsOut re, RowsOut im) const {
    re = (_lu.permutationP() * re).eval();
    im = (_lu.permutationP() * im).eval();
    const Substitution work{_lu.matrixLU(), _inverse, re.data(), im.data(), re.outerStride()};
    in_lanes([&]() __attribute__((always_inline)) { (void)along_row<4>(0, re.cols(), work); });
}

} // namespace whirl::linalg

#include "oracles/wide_algebra.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace whirl::oracles {

namespace {

constexpr Real rounding = std::numeric_limits<Real>::epsilon();

template <class Matrix> Eigen::Index pivot_row(const Matrix &A, Eigen::Index k) {
    Eigen::Index out = k;
    for (Eigen::Index i = k + 1; i < A.rows(); ++i)
        if (std::abs(A(i, k)) > std::abs(A(out, k)))
            out = i;
    return out;
}

template <class Matrix> void exchange_rows(Matrix &A, Eigen::Index i, Eigen::Index j) {
    for (Eigen::Index k = 0; k < A.cols() && i != j; ++k)
        std::swap(A(i, k), A(j, k));
}

/// Column k of `from`, from row `first` on, times -factor into column j of A.
template <class Matrix>
void subtract(const Matrix &from, Eigen::Index k, Eigen::Index first, Eigen::Index last,
              const typename Matrix::Scalar &factor, Matrix &A, Eigen::Index j) {
    for (Eigen::Index i = first; i < last; ++i)
        A(i, j) -= from(i, k) * factor;
}

template <class Matrix> Matrix eliminated(Matrix A, Matrix B) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index pivot = pivot_row(A, k);
        exchange_rows(A, k, pivot);
        exchange_rows(B, k, pivot);
        for (Eigen::Index i = k + 1; i < n; ++i)
            A(i, k) /= A(k, k);
        for (Eigen::Index j = k + 1; j < n; ++j)
            subtract(A, k, k + 1, n, A(k, j), A, j);
        for (Eigen::Index j = 0; j < B.cols(); ++j)
            subtract(A, k, k + 1, n, B(k, j), B, j);
    }
    for (Eigen::Index j = 0; j < B.cols(); ++j)
        for (Eigen::Index k = n; k-- > 0;) {
            B(k, j) /= A(k, k);
            subtract(A, k, 0, k, B(k, j), B, j);
        }
    return B;
}

/// I - 2 v v^T/(v^T v), which takes a given x to a multiple of the first unit vector.
struct Reflection {
    std::vector<Real> v;
    Real weight = 0; ///< 2/(v^T v)

    explicit Reflection(std::vector<Real> x) : v(std::move(x)) {
        Real square = 0;
        for (const Real value : v)
            square += value * value;
        if (square == 0)
            return;
        v[0] += std::copysign(std::sqrt(square), v[0]);
        square = 0;
        for (const Real value : v)
            square += value * value;
        weight = 2 / square;
    }
    /// Rows row, row + 1, .. of A, in columns from .. to.
    void rows(RealMatrix &A, Eigen::Index row, Eigen::Index from, Eigen::Index to) const {
        for (Eigen::Index j = from; j <= to; ++j) {
            Real sum = 0;
            for (std::size_t i = 0; i < v.size(); ++i)
                sum += v[i] * A(row + static_cast<Eigen::Index>(i), j);
            for (std::size_t i = 0; i < v.size(); ++i)
                A(row + static_cast<Eigen::Index>(i), j) -= weight * sum * v[i];
        }
    }
    /// Columns column, column + 1, .. of A, in rows from .. to.
    void columns(RealMatrix &A, Eigen::Index column, Eigen::Index from, Eigen::Index to) const {
        for (Eigen::Index j = from; j <= to; ++j) {
            Real sum = 0;
            for (std::size_t i = 0; i < v.size(); ++i)
                sum += v[i] * A(j, column + static_cast<Eigen::Index>(i));
            for (std::size_t i = 0; i < v.size(); ++i)
                A(j, column + static_cast<Eigen::Index>(i)) -= weight * sum * v[i];
        }
    }
};

/// Zeros below the first subdiagonal.
RealMatrix hessenberg(RealMatrix A) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k + 2 < n; ++k) {
        std::vector<Real> below;
        for (Eigen::Index i = k + 1; i < n; ++i)
            below.push_back(A(i, k));
        const Reflection reflection(below);
        reflection.rows(A, k + 1, k, n - 1);
        reflection.columns(A, k + 1, 0, n - 1);
        for (Eigen::Index i = k + 2; i < n; ++i)
            A(i, k) = 0;
    }
    return A;
}

/// First row of the block that ends at `last`: entries below it that are rounding become zero.
Eigen::Index first_of_block(RealMatrix &H, Eigen::Index last, Real size) {
    for (Eigen::Index k = last; k > 0; --k) {
        const Real beside = std::abs(H(k - 1, k - 1)) + std::abs(H(k, k));
        if (std::abs(H(k, k - 1)) <= rounding * (beside > 0 ? beside : size)) {
            H(k, k - 1) = 0;
            return k;
        }
    }
    return 0;
}

/// One double step on the block first .. last of at least three rows, with the sum and the product
/// of both shifts.
void double_step(RealMatrix &H, Eigen::Index first, Eigen::Index last, Real sum, Real product) {
    const Eigen::Index next = first + 1;
    std::vector<Real> x{H(first, first) * (H(first, first) - sum) +
                            H(first, next) * H(next, first) + product,
                        H(next, first) * (H(first, first) + H(next, next) - sum),
                        H(next, first) * H(next + 1, next)};
    for (Eigen::Index k = first; k < last; ++k) {
        const Reflection reflection(x);
        reflection.rows(H, k, std::max(first, k - 1), last);
        reflection.columns(H, k, first, std::min(k + 3, last));
        if (k > first)
            for (Eigen::Index i = k + 1; i <= std::min(k + 2, last); ++i)
                H(i, k - 1) = 0;
        x.clear();
        for (Eigen::Index i = k + 1; i <= std::min(k + 3, last); ++i)
            x.push_back(H(i, k));
    }
}

void push_pair(const RealMatrix &H, Eigen::Index k, std::vector<Complex> &out) {
    const Real half = (H(k, k) - H(k + 1, k + 1)) / 2;
    const Real coupling = H(k, k + 1) * H(k + 1, k);
    const Real square = half * half + coupling;
    if (square < 0) {
        out.emplace_back(H(k + 1, k + 1) + half, std::sqrt(-square));
        out.push_back(std::conj(out.back()));
        return;
    }
    const Real far = half + std::copysign(std::sqrt(square), half);
    out.emplace_back(H(k + 1, k + 1) + far);
    out.emplace_back(far != 0 ? H(k + 1, k + 1) - coupling / far : H(k + 1, k + 1));
}

/// One rotation of a symmetric matrix that makes entry (p, q) zero.
void rotate(RealMatrix &A, Eigen::Index p, Eigen::Index q) {
    if (A(p, q) == 0)
        return;
    const Real ratio = (A(q, q) - A(p, p)) / (2 * A(p, q));
    const Real t = std::copysign(1 / (std::abs(ratio) + std::hypot(ratio, Real(1))), ratio);
    const Real c = 1 / std::hypot(t, Real(1));
    const Real s = t * c;
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        const Real at_p = A(k, p);
        A(k, p) = c * at_p - s * A(k, q);
        A(k, q) = s * at_p + c * A(k, q);
    }
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        const Real at_p = A(p, k);
        A(p, k) = c * at_p - s * A(q, k);
        A(q, k) = s * at_p + c * A(q, k);
    }
    A(p, q) = A(q, p) = 0;
}

} // namespace

RealMatrix product(const RealMatrix &A, const RealMatrix &B) { return A.lazyProduct(B); }

RealMatrix solve(RealMatrix A, RealMatrix B) { return eliminated(std::move(A), std::move(B)); }
ComplexMatrix solve(ComplexMatrix A, ComplexMatrix B) {
    return eliminated(std::move(A), std::move(B));
}
RealMatrix inverse(const RealMatrix &A) {
    return solve(A, RealMatrix::Identity(A.rows(), A.rows()));
}

Real determinant(RealMatrix A) {
    Real out = 1;
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
        const Eigen::Index pivot = pivot_row(A, k);
        exchange_rows(A, k, pivot);
        out *= (pivot == k ? 1 : -1) * A(k, k);
        for (Eigen::Index i = k + 1; i < A.rows(); ++i)
            A(i, k) /= A(k, k);
        for (Eigen::Index j = k + 1; j < A.rows(); ++j)
            subtract(A, k, k + 1, A.rows(), A(k, j), A, j);
    }
    return out;
}

std::vector<Complex> eigenvalues(const RealMatrix &A) {
    constexpr int most = 60; // steps for one eigenvalue
    RealMatrix H = hessenberg(A);
    const Real size = A.cwiseAbs().sum();
    std::vector<Complex> out;
    int steps = 0;
    for (Eigen::Index last = A.rows() - 1; last >= 0;) {
        const Eigen::Index first = first_of_block(H, last, size);
        if (last - first < 2) {
            if (first == last)
                out.emplace_back(H(last, last));
            else
                push_pair(H, first, out);
            last = first - 1;
            steps = 0;
            continue;
        }
        if (++steps > most || !std::isfinite(size))
            throw std::runtime_error("eigenvalues of the oracles: no convergence");
        if (steps % 10 == 0) { // shifts of no meaning, against cycles
            const Real off = std::abs(H(last, last - 1)) + std::abs(H(last - 1, last - 2));
            double_step(H, first, last, 1.5L * off, off * off);
            continue;
        }
        double_step(H, first, last, H(last - 1, last - 1) + H(last, last),
                    H(last - 1, last - 1) * H(last, last) - H(last - 1, last) * H(last, last - 1));
    }
    return out;
}

std::vector<Real> hermitian_eigenvalues(const ComplexMatrix &A) {
    RealMatrix form = real_form(A, ComplexMatrix::Zero(A.rows(), A.rows()));
    const Eigen::Index n = form.rows();
    const Real size = form.cwiseAbs().sum();
    for (int sweep = 0;; ++sweep) {
        Real off = 0;
        for (Eigen::Index p = 0; p < n; ++p)
            for (Eigen::Index q = p + 1; q < n; ++q)
                off += std::abs(form(p, q));
        if (off <= rounding * rounding * size)
            break;
        if (sweep == 60)
            throw std::runtime_error("eigenvalues of the oracles: no convergence");
        for (Eigen::Index p = 0; p < n; ++p)
            for (Eigen::Index q = p + 1; q < n; ++q)
                rotate(form, p, q);
    }
    std::vector<Real> all;
    for (Eigen::Index k = 0; k < n; ++k)
        all.push_back(form(k, k));
    std::sort(all.begin(), all.end());
    std::vector<Real> out; // each stands twice in the real form
    for (std::size_t k = 0; k < all.size(); k += 2)
        out.push_back(all[k]);
    return out;
}

RealMatrix real_form(const ComplexMatrix &A, const ComplexMatrix &B) {
    const Eigen::Index n = A.rows();
    RealMatrix out(2 * n, 2 * n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i) {
            out(i, j) = A(i, j).real() + B(i, j).real();
            out(i, n + j) = B(i, j).imag() - A(i, j).imag();
            out(n + i, j) = A(i, j).imag() + B(i, j).imag();
            out(n + i, n + j) = A(i, j).real() - B(i, j).real();
        }
    return out;
}

} // namespace whirl::oracles

#include "forced/condensed/equal_chain.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace whirl::forced {

namespace {

using Complex = std::complex<double>;
using Values = FewRows<Complex>;
using Sizes = FewRows<double>;
using Index = std::size_t;

/// a b without the language's look for infinities.
Complex times(const Complex &a, const Complex &b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
double times(double a, double b) { return a * b; }

/// out += a b, of (n, half) and (half, m).
template <class Scalar>
void add_product(FewRows<Scalar> &out, const FewRows<Scalar> &a, const FewRows<Scalar> &b, Index n,
                 Index half, Index m) {
    for (Index i = 0; i < n; ++i)
        for (Index k = 0; k < half; ++k)
            for (Index j = 0; j < m; ++j)
                out[i][j] += times(a[i][k], b[k][j]);
}

/// Of the first n rows, with row pivots (Gauss and Jordan).
Values inverse(Values A, Index n) {
    Values out{};
    for (Index i = 0; i < n; ++i)
        out[i][i] = 1;
    for (Index k = 0; k < n; ++k) {
        Index pivot = k;
        for (Index i = k + 1; i < n; ++i)
            if (std::norm(A[i][k]) > std::norm(A[pivot][k]))
                pivot = i;
        std::swap(A[k], A[pivot]);
        std::swap(out[k], out[pivot]);
        const Complex scale = 1.0 / A[k][k];
        for (Index j = 0; j < n; ++j) {
            A[k][j] = times(A[k][j], scale);
            out[k][j] = times(out[k][j], scale);
        }
        for (Index i = 0; i < n; ++i) {
            const Complex factor = A[i][k];
            for (Index j = 0; i != k && j < n; ++j) {
                A[i][j] -= times(factor, A[k][j]);
                out[i][j] -= times(factor, out[k][j]);
            }
        }
    }
    return out;
}

/// Of two chains that share an end, [D P; Q M] with the unknowns of that end last.
template <class Scalar> struct SharedEnd {
    FewRows<Scalar> D{}, P{}, Q{}, M{};

    SharedEnd(const FewRows<Scalar> &a, const FewRows<Scalar> &b, Index half) {
        for (Index i = 0; i < half; ++i)
            for (Index j = 0; j < half; ++j) {
                D[i][j] = a[i][j];
                D[half + i][half + j] = b[half + i][half + j];
                P[i][j] = a[i][half + j];
                P[half + i][j] = b[half + i][j];
                Q[i][j] = a[half + i][j];
                Q[i][half + j] = b[i][half + j];
                M[i][j] = a[half + i][half + j] + b[i][j];
            }
    }
};

Sizes sizes_of(const Values &A, Index n, Index m) {
    Sizes out{};
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < m; ++j)
            out[i][j] = std::abs(A[i][j]);
    return out;
}

} // namespace

/// D - P M^-1 Q. What rounding changes in D, P, M and Q goes on into it.
Chain joined(const Chain &a, const Chain &b) {
    const auto half = static_cast<Index>(a.half);
    const Index n = 2 * half;
    const SharedEnd<Complex> value(a.values, b.values, half);
    SharedEnd<double> size(a.sizes, b.sizes, half);
    const Values inverted = inverse(value.M, half);
    Values Y{};
    add_product(Y, inverted, value.Q, half, half, n);
    Values X{}; // -P M^-1
    add_product(X, value.P, inverted, n, half, half);
    for (auto &row : X)
        for (Complex &entry : row)
            entry = -entry;
    Chain out{a.half, value.D, size.D};
    add_product(out.values, X, value.Q, n, half, n);
    const Sizes y = sizes_of(Y, half, n);
    add_product(size.Q, size.M, y, half, half, n);
    add_product(out.sizes, size.P, y, n, half, n);
    add_product(out.sizes, sizes_of(X, n, half), size.Q, n, half, n);
    return out;
}

Chain equal_chain(const Chain &one, int count) {
    if (count == 1)
        return one;
    const Chain half = equal_chain(one, count / 2);
    const Chain both = joined(half, half);
    return count % 2 == 0 ? both : joined(both, one);
}

} // namespace whirl::forced

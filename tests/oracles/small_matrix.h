#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace whirl::oracles {

inline long double conjugate(long double value) { return value; }
inline std::complex<long double> conjugate(const std::complex<long double> &value) {
    return std::conj(value);
}
inline long double real_part(long double value) { return value; }
inline long double real_part(const std::complex<long double> &value) { return value.real(); }

/// Square matrix of few rows.
template <class Number, int size> struct Small {
    std::array<std::array<Number, size>, size> entry{};

    Number &operator()(int i, int j) {
        return entry[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    const Number &operator()(int i, int j) const {
        return entry[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
};

/// a b, or a^H b.
template <class Number, int size>
Small<Number, size> product(const Small<Number, size> &a, const Small<Number, size> &b,
                            bool adjoint = false) {
    Small<Number, size> out;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            Number sum(0);
            for (int k = 0; k < size; ++k)
                sum += (adjoint ? conjugate(a(k, i)) : a(i, k)) * b(k, j);
            out(i, j) = sum;
        }
    return out;
}

/// By elimination with row pivots.
template <class Number, int size> Number determinant(Small<Number, size> a) {
    Number out(1);
    for (int k = 0; k < size; ++k) {
        int pivot = k;
        for (int i = k + 1; i < size; ++i)
            if (std::abs(a(i, k)) > std::abs(a(pivot, k)))
                pivot = i;
        if (std::abs(a(pivot, k)) == 0)
            return Number(0);
        if (pivot != k) {
            std::swap(a.entry[static_cast<std::size_t>(pivot)],
                      a.entry[static_cast<std::size_t>(k)]);
            out = -out;
        }
        out *= a(k, k);
        for (int i = k + 1; i < size; ++i) {
            const Number factor = a(i, k) / a(k, k);
            for (int j = k + 1; j < size; ++j)
                a(i, j) -= factor * a(k, j);
        }
    }
    return out;
}

/// Exchanges rows and columns i and j.
template <class Number, int size> void exchange(Small<Number, size> &a, int i, int j) {
    if (i == j)
        return;
    for (int k = 0; k < size; ++k)
        std::swap(a(i, k), a(j, k));
    for (int k = 0; k < size; ++k)
        std::swap(a(k, i), a(k, j));
}

/// Eliminates rows and columns first, first + 1, .. first + width - 1 from a Hermitian matrix.
template <class Number, int size> void eliminate(Small<Number, size> &a, int first, int width) {
    const int rest = first + width;
    for (int i = rest; i < size; ++i)
        for (int j = rest; j < size; ++j) {
            if (width == 1) {
                a(i, j) -= a(i, first) * a(first, j) / a(first, first);
                continue;
            }
            const int next = first + 1;
            const Number det = a(first, first) * a(next, next) - a(first, next) * a(next, first);
            a(i, j) -=
                (a(i, first) * (a(next, next) * a(first, j) - a(first, next) * a(next, j)) +
                 a(i, next) * (a(first, first) * a(next, j) - a(next, first) * a(first, j))) /
                det;
        }
}

/// Negative eigenvalues of a Hermitian matrix, by Sylvester's law (Bunch and Parlett 1971).
template <class Number, int size> int negative_eigenvalues(Small<Number, size> a) {
    int negative = 0;
    for (int k = 0; k < size;) {
        int diagonal = k;
        int row = k;
        int column = k;
        for (int i = k; i < size; ++i) {
            if (std::abs(a(i, i)) > std::abs(a(diagonal, diagonal)))
                diagonal = i;
            for (int j = k; j < i; ++j)
                if (row == column || std::abs(a(i, j)) > std::abs(a(row, column))) {
                    row = i;
                    column = j;
                }
        }
        if (row == column || std::abs(a(diagonal, diagonal)) >= 0.64L * std::abs(a(row, column))) {
            exchange(a, k, diagonal);
            negative += real_part(a(k, k)) < 0 ? 1 : 0;
            if (real_part(a(k, k)) != 0)
                eliminate(a, k, 1);
            ++k;
            continue;
        }
        exchange(a, k, column); // column < row, so the second exchange finds it in place
        exchange(a, k + 1, row);
        ++negative; // a pivot of two rows with a large product beside small squares
        eliminate(a, k, 2);
        k += 2;
    }
    return negative;
}

} // namespace whirl::oracles

#pragma once

// Uniform shaft and the motions carried along it, for real and for complex numbers.

#include "oracles/continuum.h"
#include "oracles/small_matrix.h"

#include <algorithm>
#include <numbers>
#include <type_traits>

namespace whirl::oracles {

/// Everything of the walk that depends on the motion looked at.
template <class Number> struct Dynamics {
    Number lambda2;    ///< lambda^2
    Number gyroscopic; ///< -i Omega lambda
    Complex lambda;
    Complex spin; ///< Omega
};

template <class Number> Number narrowed(const Complex &value) {
    if constexpr (std::is_same_v<Number, Real>)
        return value.real();
    else
        return value;
}

/// y' = A y for y = (w, phi, Q, M): w' = phi + Q/S, phi' = M/B, Q' = a w, M' = b phi - Q.
template <class Number> struct Wave {
    Number S, B, a, b;

    /// At least the modulus of the largest characteristic exponent.
    [[nodiscard]] Real largest() const {
        const Real p = std::abs(b / B + a / S);
        const Real q = std::abs(a / B * (Number(1) + b / S));
        return std::sqrt((p + std::sqrt(p * p + 4 * q)) / 2);
    }

    /// exp(A h), by A^4 = p A^2 + q.
    [[nodiscard]] Small<Number, 4> transfer(Real h) const {
        Small<Number, 4> A;
        A(0, 1) = Number(1);
        A(0, 2) = Number(1) / S;
        A(1, 3) = Number(1) / B;
        A(2, 0) = a;
        A(3, 1) = b;
        A(3, 2) = Number(-1);
        const Number p = b / B + a / S;
        const Number q = -a / B * (Number(1) + b / S);
        Number u(0);
        Number v(1); // A^(2m) = u A^2 + v
        Number e0(0), e2(0), o1(0), o3(0);
        Real factor = 1; // h^n / n!
        for (int n = 0; n < 40; n += 2) {
            e2 += factor * u;
            e0 += factor * v;
            const Real next = factor * h / static_cast<Real>(n + 1);
            o3 += next * u;
            o1 += next * v;
            factor = next * h / static_cast<Real>(n + 2);
            const Number before = u;
            u = p * u + v;
            v = q * before;
        }
        const Small<Number, 4> A2 = product(A, A);
        const Small<Number, 4> A3 = product(A2, A);
        Small<Number, 4> T;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                T(i, j) = (i == j ? e0 : Number(0)) + o1 * A(i, j) + e2 * A2(i, j) + o3 * A3(i, j);
        return T;
    }

    /// Longest part without a frequency of its own, both ends held, below the one looked at. It
    /// has fewer than a part pinned there, which has none when the form of the energies is definite
    /// for every wave number pi/h, 2 pi/h, ..., and for the pure rotation, S + b > 0; where that
    /// is not, by Poincare's inequality.
    [[nodiscard]] Real longest() const {
        constexpr Real pi = std::numbers::pi_v<Real>;
        const Real wave = 2 / largest();
        if (real_part(S + b) > 0)
            return wave;
        return std::min({wave, pi * std::sqrt(std::abs(B / (Real(2) * (S - b)))),
                         pi * std::sqrt(std::abs(S / (Real(4) * a)))});
    }
};

/// Motions of the left part with its left end free, one a column: deflections U and forces F at the
/// cut, in the order w, phi / Q, M (of forward, then of backward motion).
template <class Number, int planes> struct Subspace {
    static constexpr int size = 2 * planes;
    Small<Number, size> U, F;
    Number product = Number(1);
    long exponent = 0;

    Subspace() {
        for (int i = 0; i < size; ++i)
            U(i, i) = Number(1);
    }

    /// Orthonormal columns; the determinant of what is taken out is kept.
    void orthonormalise() {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < j; ++i) {
                Number r(0);
                for (int k = 0; k < size; ++k)
                    r += conjugate(U(k, i)) * U(k, j) + conjugate(F(k, i)) * F(k, j);
                for (int k = 0; k < size; ++k) {
                    U(k, j) -= r * U(k, i);
                    F(k, j) -= r * F(k, i);
                }
            }
            Real sum = 0;
            for (int k = 0; k < size; ++k)
                sum += std::norm(U(k, j)) + std::norm(F(k, j));
            const Real norm = std::sqrt(sum);
            for (int k = 0; k < size; ++k) {
                U(k, j) /= norm;
                F(k, j) /= norm;
            }
            product *= norm;
        }
        int shift = 0;
        (void)std::frexp(std::abs(product), &shift);
        product *= std::ldexp(Real(1), -shift);
        exponent += shift;
    }
};

} // namespace whirl::oracles

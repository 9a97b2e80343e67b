#pragma once

// The parts of the walk along the rotor, for real and for complex numbers; see continuum.h.

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

/// Dynamic stiffness of one support on x + i y (p) and x - i y (q).
struct Circular {
    Complex pp, pq, qp, qq;
};

inline Circular circular(const Block &k, const Block &c, Complex lambda) {
    const auto at = [&](std::size_t row, std::size_t column) {
        return Complex(k[row][column]) + lambda * Complex(c[row][column]);
    };
    const Complex i(0, 1);
    const Real half = 0.5L;
    return {half * (at(0, 0) + at(1, 1) + i * (at(1, 0) - at(0, 1))),
            half * (at(0, 0) - at(1, 1) + i * (at(1, 0) + at(0, 1))),
            half * (at(0, 0) - at(1, 1) - i * (at(1, 0) + at(0, 1))),
            half * (at(0, 0) + at(1, 1) - i * (at(1, 0) - at(0, 1)))};
}

/// Film and pedestal in series; `below` grows by the pedestal's frequencies, shaft held.
inline Circular on_pedestal(const Circular &film, const Support &s, Complex lambda, Motion motion,
                            int *below) {
    const Complex own = Complex(s.pedestal_k) +
                        lambda * (Complex(s.pedestal_c) + lambda * Complex(s.pedestal_mass));
    if (motion != Motion::both) {
        const Complex z = motion == Motion::forward ? film.pp : film.qq;
        if (below && (z + own).real() < 0)
            ++*below;
        const Complex series = z * own / (z + own);
        return {series, 0, 0, series};
    }
    Small<Complex, 2> total;
    total.entry = {{{film.pp + own, film.pq}, {film.qp, film.qq + own}}};
    if (below)
        *below += negative_eigenvalues(total);
    // own (film + own)^-1 film, which is film - film (film + own)^-1 film without the difference
    const Complex f = own / determinant(total);
    const auto &t = total.entry;
    return {
        f * (t[1][1] * film.pp - t[0][1] * film.qp), f * (t[1][1] * film.pq - t[0][1] * film.qq),
        f * (t[0][0] * film.qp - t[1][0] * film.pp), f * (t[0][0] * film.qq - t[1][0] * film.pq)};
}

/// +1 forward, -1 backward.
inline Real sense(Motion motion, int plane) {
    return motion == Motion::backward || plane == 1 ? -1 : 1;
}

/// Adds a support's force (row 0: deflections, row 1: slopes).
template <class Number, int planes>
void add_support(Subspace<Number, planes> &y, const Circular &z, Real unit, Motion motion,
                 int row) {
    const auto entry = [unit](const Complex &value) { return narrowed<Number>(unit * value); };
    for (int j = 0; j < y.size; ++j) {
        if constexpr (planes == 1) {
            y.F(row, j) += entry(motion == Motion::forward ? z.pp : z.qq) * y.U(row, j);
        } else {
            (void)motion;
            y.F(row, j) += entry(z.pp) * y.U(row, j) + entry(z.pq) * y.U(row + 2, j);
            y.F(row + 2, j) += entry(z.qp) * y.U(row, j) + entry(z.qq) * y.U(row + 2, j);
        }
    }
}

/// Over everything attached at a station.
template <class Number, int planes>
void pass(Subspace<Number, planes> &y, const Continuum::Point &point, const Dynamics<Number> &d,
          Motion motion, const Continuum::Units &units, int *below) {
    for (int plane = 0; plane < planes; ++plane) {
        const Number w = point.mass * d.lambda2;
        const Number phi = point.Id * d.lambda2 + sense(motion, plane) * point.Ip * d.gyroscopic;
        for (int j = 0; j < y.size; ++j) {
            y.F(2 * plane, j) += w * y.U(2 * plane, j);
            y.F(2 * plane + 1, j) += phi * y.U(2 * plane + 1, j);
        }
    }
    for (const Support &s : point.supports) {
        Circular deflection = circular(s.k, s.c, d.lambda);
        if (s.pedestal)
            deflection = on_pedestal(deflection, s, d.lambda, motion, below);
        add_support<Number, planes>(y, deflection, units.force, motion, 0);
        add_support<Number, planes>(y, circular(s.kt, s.ct, d.lambda), units.moment, motion, 1);
    }
}

/// Along a uniform length. `below` grows by the negative eigenvalues of the stiffness of the
/// station left behind with the next one held: V U' U^-1, V the inverse of the part of the transfer
/// from forces to deflections; U^H V U' has as many.
template <class Number, int planes>
void cross(Subspace<Number, planes> &y, const std::array<Small<Number, 4>, 2> &transfers,
           int *below) {
    const Small<Number, 2 *planes> before = y.U;
    Small<Number, 2 * planes> held;
    for (int plane = 0; plane < planes; ++plane) {
        const Small<Number, 4> &T = transfers[static_cast<std::size_t>(plane)];
        const int r = 2 * plane;
        for (int j = 0; j < y.size; ++j) {
            const std::array<Number, 4> in{y.U(r, j), y.U(r + 1, j), y.F(r, j), y.F(r + 1, j)};
            std::array<Number, 4> out{};
            for (int i = 0; i < 4; ++i)
                for (int k = 0; k < 4; ++k)
                    out[static_cast<std::size_t>(i)] += T(i, k) * in[static_cast<std::size_t>(k)];
            y.U(r, j) = out[0];
            y.U(r + 1, j) = out[1];
            y.F(r, j) = out[2];
            y.F(r + 1, j) = out[3];
        }
        const Number det = T(0, 2) * T(1, 3) - T(0, 3) * T(1, 2);
        held(r, r) = T(1, 3) / det;
        held(r, r + 1) = -T(0, 3) / det;
        held(r + 1, r) = -T(1, 2) / det;
        held(r + 1, r + 1) = T(0, 2) / det;
    }
    if (below)
        *below += negative_eigenvalues(product(before, product(held, y.U), true));
    y.orthonormalise();
}

} // namespace whirl::oracles

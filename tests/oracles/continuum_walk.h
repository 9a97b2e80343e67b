#pragma once

// The steps of the walk along the rotor; see continuum.h.

#include "oracles/continuum_supports.h"
#include "oracles/continuum_wave.h"

namespace whirl::oracles {

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

#pragma once

#include "oracles/continuum.h"
#include "oracles/small_matrix.h"

namespace whirl::oracles {

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

} // namespace whirl::oracles

#include "oracles/criterion.h"

#include <cmath>

namespace whirl::oracles {

namespace {

constexpr int grid = 1500; ///< steps of a range; narrower bands are not looked for

/// Between speeds of which only the first or only the second is inside.
Real end_between(const std::function<bool(Real)> &inside, Real a, Real b, bool inside_a) {
    for (int step = 0; step < 80; ++step) {
        const Real middle = (a + b) / 2;
        (inside(middle) == inside_a ? a : b) = middle;
    }
    return (a + b) / 2;
}

} // namespace

std::vector<Real> flat(const std::vector<Band> &bands) {
    std::vector<Real> out;
    for (const auto &[from, to] : bands) {
        out.push_back(from);
        out.push_back(to);
    }
    return out;
}

std::vector<Band> bands_where(const std::function<bool(Real)> &inside, Real from, Real to,
                              int steps) {
    std::vector<Band> out;
    Real last = from;
    bool was_inside = inside(from);
    if (was_inside)
        out.emplace_back(from, to);
    for (int step = 1; step <= steps; ++step) {
        const Real now = from + (to - from) * step / steps;
        const bool is_inside = inside(now);
        if (is_inside != was_inside) {
            const Real end = end_between(inside, last, now, was_inside);
            if (is_inside)
                out.emplace_back(end, to);
            else
                out.back().second = end;
        }
        last = now;
        was_inside = is_inside;
    }
    return out;
}

ComplexMatrix criterion_form(const SteppedRotor &rotor, Real speed,
                             const std::vector<double> &places) {
    const ComplexMatrix R = speed * speed * receptance(rotor, Complex(0, speed), speed, places);
    return (R + R.adjoint()) / Real(2);
}

std::vector<Real> signature(const ComplexMatrix &form) { return hermitian_eigenvalues(form); }

std::vector<Band> criterion_bands(const SteppedRotor &rotor, Real from, Real to,
                                  const std::vector<double> &places) {
    const auto inside = [&](Real speed) {
        return speed > 0 && signature(criterion_form(rotor, speed, places)).back() < 0;
    };
    return bands_where(inside, from, to, grid);
}

std::vector<Real> pinned_speeds(const SteppedRotor &rotor, Real from, Real to,
                                const std::vector<double> &places) {
    const auto determinant = [&](Real speed) {
        Real product = 1;
        for (const Real eigenvalue : signature(criterion_form(rotor, speed, places)))
            product *= eigenvalue;
        return product;
    };
    const auto negative = [&](Real speed) { return speed > 0 && determinant(speed) < 0; };
    std::vector<Real> out;
    for (const Band &band : bands_where(negative, from, to, grid))
        for (const Real end : {band.first, band.second})
            // The determinant changes sign through zero there, through infinity at critical speeds
            if (end > from && end < to &&
                std::abs(determinant(end * (1 + 1e-10L))) <
                    std::abs(determinant(end * (1 + 1e-6L))))
                out.push_back(end);
    return out;
}

} // namespace whirl::oracles

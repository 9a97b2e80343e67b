#pragma once

#include <cmath>
#include <complex>

namespace whirl::balancers {

/// The path of the balls of a race in the rotor, seen from the race's centre: rho exp(i a) at the
/// angle a, rho = R [1 + Re(conj(h) exp(2 i a))]. docs/theory.md, "Races out of round".
struct Track {
    double radius = 0;                 ///< R, m
    std::complex<double> out_of_round; ///< h = ellipticity exp(2 i direction); 0: a circle

    /// Radius and its derivatives over the angle, m.
    struct Radius {
        double value, slope, bend;
    };
    [[nodiscard]] Radius at(double angle) const {
        const std::complex<double> wave =
            radius * std::conj(out_of_round) * std::polar(1.0, 2 * angle);
        return {radius + wave.real(), -2 * wave.imag(), -4 * wave.real()};
    }
};

} // namespace whirl::balancers

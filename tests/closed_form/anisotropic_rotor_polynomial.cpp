#include "closed_form/anisotropic_rotor_polynomial.h"

#include <algorithm>
#include <cmath>

namespace whirl::closed_form {

namespace {

double squared(double value) { return value * value; }

} // namespace

std::array<double, 5> characteristic_polynomial(const AnisotropicRotor &rotor, double spin_speed) {
    const double C = rotor.polar_inertia;
    const double a2 = squared(rotor.anisotropy);
    const double p2 = squared(rotor.frequency);
    const double h = rotor.damping;
    const double x = squared(spin_speed);
    return {1.0 - a2, 2.0 * h, 2.0 * p2 + h * h + (squared(1.0 - C) + 1.0 - 2.0 * a2) * x,
            2.0 * h * (p2 + x), squared(p2 - (1.0 - C) * x) + h * h * x - a2 * x * x};
}

bool routh_hurwitz_stable(const std::array<double, 5> &coefficients) {
    const auto [a0, a1, a2, a3, a4] = coefficients;
    const bool all_positive = std::ranges::all_of(coefficients, [](double a) { return a > 0.0; });
    return all_positive && a1 * a2 * a3 - a0 * a3 * a3 - a1 * a1 * a4 > 0.0;
}

double hurwitz_determinant(const AnisotropicRotor &rotor, double spin_speed) {
    const double h2 = squared(rotor.damping);
    const double p2 = squared(rotor.frequency);
    return 4.0 * h2 * p2 *
           (p2 * squared(rotor.anisotropy) + h2 +
            squared((2.0 - rotor.polar_inertia) * spin_speed));
}

} // namespace whirl::closed_form

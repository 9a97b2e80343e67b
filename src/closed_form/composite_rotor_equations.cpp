#include "closed_form/composite_rotor_equations.h"

#include "closed_form/rigid_rotor_criterion.h"

#include <algorithm>
#include <cmath>

namespace whirl::closed_form {

namespace {

/// The two rotors whose planes of bending are the principal planes of the composite one.
std::vector<TwoSupportRotor> principal_rotors(const RotatingCoefficients &c) {
    std::vector<TwoSupportRotor> rotors;
    for (const double sign : {1.0, -1.0}) {
        rotors.push_back({c.mass, c.mean_inertia + sign * std::abs(c.anisotropy), c.polar_inertia,
                          c.supports.c_x, c.supports.c_y, c.supports.c_beta});
    }
    return rotors;
}

} // namespace

std::vector<double> critical_speeds(const RotatingCoefficients &coefficients) {
    std::vector<double> speeds;
    for (const TwoSupportRotor &rotor : principal_rotors(coefficients)) {
        const std::vector<double> found = resonances(rotor);
        speeds.insert(speeds.end(), found.begin(), found.end());
    }
    std::ranges::sort(speeds);
    return speeds;
}

std::vector<double> additional_speeds(const RotatingCoefficients &coefficients) {
    std::vector<double> speeds;
    for (const TwoSupportRotor &rotor : principal_rotors(coefficients)) {
        if (const auto speed = additional_speed(rotor, coefficients.balancer_position))
            speeds.push_back(*speed);
    }
    std::ranges::sort(speeds);
    return speeds;
}

AnisotropicRotor tilt_rotor(const RotatingCoefficients &c) {
    return {c.polar_inertia / c.mean_inertia, std::abs(c.anisotropy) / c.mean_inertia,
            std::sqrt(c.supports.c_beta / c.mean_inertia), c.supports.h_beta / c.mean_inertia};
}

} // namespace whirl::closed_form

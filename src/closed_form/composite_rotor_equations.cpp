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

RotatingCoefficients rotating_coefficients(const PhysicalParameters &physical) {
    const BallSet &balls = physical.balls;
    const double ball_mass = balls.count * balls.mass;
    const double A_m = ball_mass * balls.radius * balls.radius;
    const double A_m0 = physical.imbalance.inertia();
    RotatingCoefficients c;
    c.mass = physical.mass;
    c.mean_inertia = physical.base_inertia + 0.5 * (A_m + A_m0);
    c.polar_inertia = physical.polar_inertia + A_m + A_m0;
    c.anisotropy = 0.5 * (A_m0 + A_m * physical.second_harmonic);
    c.balancer_position = physical.balancer_position;
    c.supports = physical.supports;
    c.ball_mass = ball_mass;
    c.h_s = balls.damping / balls.mass;
    c.second_harmonic = physical.second_harmonic;
    c.spin_speed = physical.spin_speed;
    return c;
}

RotatingCoefficients rotating_coefficients(const DimensionlessParameters &d) {
    RotatingCoefficients c;
    c.mass = 1.0;
    c.mean_inertia = 1.0;
    c.polar_inertia = d.polar_inertia;
    c.anisotropy = d.anisotropy();
    c.balancer_position = d.balancer_position;
    c.supports = {1.0, d.p * d.p, d.c_y, d.h_x, d.h_beta, d.h_y};
    c.ball_mass = d.ball_mass;
    c.h_s = d.h_s;
    c.second_harmonic = d.second_harmonic;
    c.spin_speed = d.spin_speed;
    return c;
}

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

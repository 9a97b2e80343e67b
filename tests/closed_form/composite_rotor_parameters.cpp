#include "closed_form/composite_rotor_parameters.h"

#include <cmath>

namespace whirl::closed_form {

PhysicalParameters physical_parameters(const BareRotor &rotor, const BallSet &balls,
                                       const PlaneImbalance &imbalance,
                                       std::complex<double> second_harmonic,
                                       const ReducedSupports &supports, double spin_speed) {
    const CompositeRotor composite = composite_rotor(rotor, balls, imbalance, second_harmonic);
    PhysicalParameters physical;
    physical.spin_speed = spin_speed;
    physical.mass = composite.mass;
    physical.base_inertia = composite.base_inertia;
    physical.polar_inertia = rotor.polar_inertia;
    physical.balancer_position = composite.balancer_position;
    physical.supports = supports;
    physical.imbalance = imbalance;
    physical.balls = balls;
    physical.second_harmonic = second_harmonic;
    return physical;
}

std::complex<double> DimensionlessParameters::anisotropy() const {
    return 0.5 * (imbalance_inertia + ball_inertia * second_harmonic);
}

DimensionlessParameters to_dimensionless(const PhysicalParameters &physical) {
    const BallSet &balls = physical.balls;
    const ReducedSupports &supports = physical.supports;
    const double ball_mass = balls.count * balls.mass;
    const double A_m = ball_mass * balls.radius * balls.radius;
    const double A_m0 = physical.imbalance.inertia();
    const double A = physical.base_inertia + 0.5 * (A_m + A_m0);
    const double M = physical.mass;
    const double w0 = std::sqrt(supports.c_x / M);
    const double rho = std::sqrt(A / M);
    const double cross = std::sqrt(M * A);

    DimensionlessParameters d;
    d.polar_inertia = (physical.polar_inertia + A_m0 + A_m) / A;
    d.balancer_position = physical.balancer_position / rho;
    d.h_x = supports.h_x / (M * w0);
    d.h_beta = supports.h_beta / (A * w0);
    d.h_y = supports.h_y / (cross * w0);
    d.p = std::sqrt(supports.c_beta / A) / w0;
    d.c_y = supports.c_y / (cross * w0 * w0);
    d.ball_mass = ball_mass / M;
    d.h_s = balls.damping / (balls.mass * w0);
    d.second_harmonic = physical.second_harmonic;
    d.imbalance_inertia = A_m0 / A;
    d.ball_inertia = A_m / A;
    d.spin_speed = physical.spin_speed / w0;
    return d;
}

} // namespace whirl::closed_form

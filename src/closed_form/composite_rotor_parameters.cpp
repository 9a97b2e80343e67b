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

ScaledParameters to_dimensionless(const PhysicalParameters &physical) {
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

    ScaledParameters scaled;
    DimensionlessParameters &d = scaled.dimensionless;
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

    const PlaneImbalance &imbalance = physical.imbalance;
    const bool point = imbalance.mass > 0.0;
    scaled.scales = {M,
                     rho,
                     w0,
                     balls.count,
                     point ? imbalance.moment / imbalance.mass : 0.0,
                     point ? 0.0 : imbalance.moment};
    return scaled;
}

PhysicalParameters to_physical(const DimensionlessParameters &d, const ParameterScales &scales) {
    const double M = scales.mass;
    const double rho = scales.radius;
    const double w0 = scales.frequency;
    const double A = M * rho * rho;

    PhysicalParameters physical;
    physical.spin_speed = d.spin_speed * w0;
    physical.mass = M;
    physical.base_inertia = A * (1.0 - 0.5 * (d.ball_inertia + d.imbalance_inertia));
    physical.polar_inertia = A * (d.polar_inertia - d.ball_inertia - d.imbalance_inertia);
    physical.balancer_position = d.balancer_position * rho;
    physical.supports = {M * w0 * w0,    A * d.p * d.p * w0 * w0, M * rho * d.c_y * w0 * w0,
                         M * d.h_x * w0, A * d.h_beta * w0,       M * rho * d.h_y * w0};
    if (d.imbalance_inertia > 0.0) {
        const double moment = d.imbalance_inertia * A / scales.imbalance_radius;
        physical.imbalance = {moment, moment / scales.imbalance_radius};
    } else {
        physical.imbalance = {scales.own_moment, 0.0};
    }
    BallSet &balls = physical.balls;
    balls.count = scales.ball_count;
    balls.mass = d.ball_mass * M / scales.ball_count;
    balls.radius = std::sqrt(d.ball_inertia * A / (d.ball_mass * M));
    balls.damping = d.h_s * w0 * balls.mass;
    physical.second_harmonic = d.second_harmonic;
    return physical;
}

void set_equal_supports(DimensionlessParameters &parameters, double left_distance, double radius,
                        double h_x) {
    const double l = left_distance;
    const double tilt = (l * l + (1.0 - l) * (1.0 - l)) / (2.0 * radius * radius);
    const double cross = (1.0 - 2.0 * l) / (2.0 * radius);
    parameters.p = std::sqrt(tilt);
    parameters.c_y = cross;
    parameters.h_x = h_x;
    parameters.h_beta = h_x * tilt;
    parameters.h_y = h_x * cross;
}

} // namespace whirl::closed_form

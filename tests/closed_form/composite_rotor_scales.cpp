#include "closed_form/composite_rotor_scales.h"

#include <cmath>

namespace whirl::closed_form {

ParameterScales scales_of(const PhysicalParameters &physical) {
    const BallSet &balls = physical.balls;
    const PlaneImbalance &imbalance = physical.imbalance;
    const bool point = imbalance.mass > 0.0;
    const double A_m = balls.count * balls.mass * balls.radius * balls.radius;
    const double A = physical.base_inertia + 0.5 * (A_m + imbalance.inertia());
    return {physical.mass,
            std::sqrt(A / physical.mass),
            std::sqrt(physical.supports.c_x / physical.mass),
            balls.count,
            point ? imbalance.moment / imbalance.mass : 0.0,
            point ? 0.0 : imbalance.moment};
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

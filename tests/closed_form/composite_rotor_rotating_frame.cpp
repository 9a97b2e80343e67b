#include "closed_form/composite_rotor_matrices.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <utility>

namespace whirl::closed_form {

using namespace std::complex_literals;

namespace {

/// Adds multiplication of the planar unknown `column` (x + i y) by `factor` to the real equations
/// `row`.
void add(Eigen::MatrixXd &matrix, int row, int column, std::complex<double> factor) {
    Eigen::Matrix2d block;
    block << factor.real(), -factor.imag(), factor.imag(), factor.real();
    matrix.block<2, 2>(2 * row, 2 * column) += block;
}

/// Adds factor * conj(unknown).
void add_conjugate(Eigen::MatrixXd &matrix, int row, int column, std::complex<double> factor) {
    Eigen::Matrix2d block;
    block << factor.real(), factor.imag(), factor.imag(), -factor.real();
    matrix.block<2, 2>(2 * row, 2 * column) += block;
}

enum Block { translation, tilt, balls };

/// Adds coefficient * (d/dt + i Omega)^2 to block (row, column): the absolute acceleration.
void add_acceleration(MotionMatrices &m, Block row, Block column, double coefficient,
                      double spin_speed) {
    add(m.M, row, column, coefficient);
    add(m.C, row, column, 2i * coefficient * spin_speed);
    add(m.K, row, column, -coefficient * spin_speed * spin_speed);
}

/// Adds coefficient * (d/dt + i Omega): the absolute velocity.
void add_velocity(MotionMatrices &m, Block row, Block column, std::complex<double> coefficient,
                  double spin_speed) {
    add(m.C, row, column, coefficient);
    add(m.K, row, column, 1i * coefficient * spin_speed);
}

} // namespace

ReducedSupports reduced_supports(const Support &left, const Support &right) {
    ReducedSupports reduced;
    for (const Support &support : {left, right}) {
        const double z = support.position;
        reduced.c_x += support.stiffness;
        reduced.c_y += support.stiffness * z;
        reduced.c_beta += support.stiffness * z * z;
        reduced.h_x += support.damping;
        reduced.h_y += support.damping * z;
        reduced.h_beta += support.damping * z * z;
    }
    return reduced;
}

RotatingEquations rotating_coefficients(const PhysicalParameters &physical) {
    const BallSet &balls = physical.balls;
    const double ball_mass = balls.count * balls.mass;
    const double A_m = ball_mass * balls.radius * balls.radius;
    const double A_m0 = physical.imbalance.inertia();
    RotatingEquations c;
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

RotatingEquations rotating_coefficients(const DimensionlessParameters &d) {
    RotatingEquations c;
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

MotionMatrices rotating_frame_matrices(const RotatingEquations &c) {
    const double w = c.spin_speed;
    const double z = c.balancer_position;
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(6, 6);
    MotionMatrices m{zero, zero, zero};

    add_acceleration(m, translation, translation, c.mass, w);
    add_velocity(m, translation, translation, c.supports.h_x, w);
    add_velocity(m, translation, tilt, c.supports.h_y, w);
    add(m.K, translation, translation, c.supports.c_x);
    add(m.K, translation, tilt, c.supports.c_y);
    add_acceleration(m, translation, balls, 1.0, w);

    add_acceleration(m, tilt, tilt, c.mean_inertia, w);
    add_velocity(m, tilt, tilt, c.supports.h_beta - 1i * w * c.polar_inertia, w);
    add_velocity(m, tilt, translation, c.supports.h_y, w);
    add(m.K, tilt, tilt, c.supports.c_beta);
    add(m.K, tilt, translation, c.supports.c_y);
    add_conjugate(m.M, tilt, tilt, c.anisotropy);
    add_conjugate(m.K, tilt, tilt, c.anisotropy * w * w);
    add_acceleration(m, tilt, balls, z, w);

    add(m.M, balls, balls, 1.0);
    add(m.C, balls, balls, c.h_s);
    for (const auto &[column, arm] : {std::pair{translation, 1.0}, std::pair{tilt, z}}) {
        const double half = 0.5 * c.ball_mass * arm;
        add_acceleration(m, balls, column, half, w);
        add_conjugate(m.M, balls, column, -half * c.second_harmonic);
        add_conjugate(m.C, balls, column, 2i * w * half * c.second_harmonic);
        add_conjugate(m.K, balls, column, w * w * half * c.second_harmonic);
    }
    return m;
}

MotionMatrices frozen_balls(const MotionMatrices &matrices) {
    return {matrices.M.topLeftCorner(4, 4), matrices.C.topLeftCorner(4, 4),
            matrices.K.topLeftCorner(4, 4)};
}

Eigen::MatrixXd state_matrix(const MotionMatrices &matrices) {
    const Eigen::Index n = matrices.M.rows();
    const Eigen::PartialPivLU<Eigen::MatrixXd> mass(matrices.M);
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    state.topRightCorner(n, n).setIdentity();
    state.bottomLeftCorner(n, n) = -mass.solve(matrices.K);
    state.bottomRightCorner(n, n) = -mass.solve(matrices.C);
    return state;
}

std::vector<std::complex<double>> eigenvalues(const MotionMatrices &matrices) {
    const Eigen::VectorXcd values = state_matrix(matrices).eigenvalues();
    return {values.begin(), values.end()};
}

} // namespace whirl::closed_form

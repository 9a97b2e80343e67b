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

MotionMatrices rotating_frame_matrices(const RotatingCoefficients &c) {
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

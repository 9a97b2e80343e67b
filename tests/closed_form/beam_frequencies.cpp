#include "closed_form/beam_frequencies.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::closed_form {

namespace {

/// Modal mass, gyroscopic and stiffness coefficients per unit length of the mode sin(kz).
struct ModalCoefficients {
    double mass;
    double gyroscopic;
    double stiffness;
};

double wave_number(const UniformShaft &shaft, int mode) {
    return mode * std::numbers::pi / shaft.length;
}

ModalCoefficients modal_coefficients(const UniformShaft &shaft, int mode,
                                     RotaryInertia rotary_inertia) {
    const double k2 = std::pow(wave_number(shaft, mode), 2);
    const double rotary = shaft.density * shaft.second_moment * k2;
    const double kept = rotary_inertia == RotaryInertia::kept ? rotary : 0.0;
    return {shaft.density * shaft.area + kept, 2.0 * rotary,
            shaft.young_modulus * shaft.second_moment * k2 * k2};
}

} // namespace

UniformShaft circular_shaft(double length, double outer_radius, double inner_radius,
                            double young_modulus, double density) {
    const double pi = std::numbers::pi;
    UniformShaft shaft;
    shaft.length = length;
    shaft.area = pi * (std::pow(outer_radius, 2) - std::pow(inner_radius, 2));
    shaft.second_moment = 0.25 * pi * (std::pow(outer_radius, 4) - std::pow(inner_radius, 4));
    shaft.young_modulus = young_modulus;
    shaft.density = density;
    return shaft;
}

WhirlPair euler_whirl(const UniformShaft &shaft, int mode, double spin_speed,
                      RotaryInertia rotary_inertia) {
    const auto [m, g, K] = modal_coefficients(shaft, mode, rotary_inertia);
    const double split = g * spin_speed;
    const double root = std::sqrt(split * split + 4.0 * m * K);
    // The smaller root from the product of the two, K/m: no cancellation at high speed.
    const double larger = (std::abs(split) + root) / (2.0 * m);
    const double smaller = K / (m * larger);
    return split >= 0.0 ? WhirlPair{smaller, larger} : WhirlPair{larger, smaller};
}

double euler_forward_critical(const UniformShaft &shaft, int mode, RotaryInertia rotary_inertia) {
    const auto [m, g, K] = modal_coefficients(shaft, mode, rotary_inertia);
    return m > g ? std::sqrt(K / (m - g)) : 0.0;
}

std::array<double, 4> timoshenko_whirl(const UniformShaft &shaft, int mode, double spin_speed) {
    const double k = wave_number(shaft, mode);
    const double shear = shaft.shear_coefficient * shaft.shear_modulus * shaft.area;
    const double mass = shaft.density * shaft.area;
    const double rotary = shaft.density * shaft.second_moment;
    const double bending = shaft.young_modulus * shaft.second_moment * k * k;

    // Symmetric hyperbolic pencil -w^2 M + w G + K: with the energy norm it is the symmetric
    // problem [0 L^T; L G] (L L^T = K, scaled by the masses), whose eigenvalues are the
    // frequencies.
    Eigen::Matrix2d K;
    K << shear * k * k / mass, -shear * k / std::sqrt(mass * rotary),
        -shear * k / std::sqrt(mass * rotary), (bending + shear) / rotary;
    Eigen::Matrix2d L = Eigen::Matrix2d::Zero(); // K = L L^T
    L(0, 0) = std::sqrt(K(0, 0));
    L(1, 0) = K(1, 0) / L(0, 0);
    L(1, 1) = std::sqrt(K(1, 1) - L(1, 0) * L(1, 0));
    Eigen::MatrixXd symmetric = Eigen::MatrixXd::Zero(4, 4);
    symmetric.topRightCorner<2, 2>() = L.transpose();
    symmetric.bottomLeftCorner<2, 2>() = L;
    symmetric(3, 3) = 2.0 * spin_speed;

    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
    std::array<double, 4> frequencies{};
    std::copy_n(solver.eigenvalues().data(), 4, frequencies.begin());
    return frequencies;
}

} // namespace whirl::closed_form

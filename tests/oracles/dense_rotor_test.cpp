// Two-node elements against closed forms and the continuum; reading of cases.

#include "oracles/continuum_roots.h"
#include "oracles/continuum_spectrum.h"
#include "oracles/dense_rotor.h"
#include "oracles/receptance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl::oracles;

constexpr double pi = std::numbers::pi;
const Cylinder tube{0.3, 0.08, 0.05, 2.1e11, 8e10, 7850, 0};

std::string case_file(const std::string &name) {
    return std::string(WHIRL_ROOT "/cases/") + name + "/case.toml";
}

TEST(CaseReading, units_tables_and_settings) {
    const CaseRotor rotor =
        read_case(case_file("nelson_mcvaugh"),
                  {"bearing[1].k=1e3", "speeds.from=3000 rpm", "shaft.shear=cowper"});
    EXPECT_NEAR(rotor.length(), 0.3581, 1e-12);
    EXPECT_NEAR(rotor.discs.at(0).z, 0.0889, 1e-15);
    EXPECT_NEAR(rotor.shaft.at(6).left.inner, 0.0304, 1e-15);
    EXPECT_EQ(rotor.shaft.at(6).left.kappa, 0);
    EXPECT_EQ(rotor.supports.at(1).k[0][0], 1e3);
    EXPECT_NEAR(rotor.speed_from, 100 * pi, 1e-10);
    const CaseRotor tabled = read_case(case_file("speed_dependent_bearings"), {});
    const CaseRotor between = tabled.at_speed(5750 * pi / 30);
    EXPECT_NEAR(between.supports.at(0).k[0][0], 4.5e8, 1);
    EXPECT_NEAR(between.supports.at(0).k[1][0], -1.2e5, 1e-3);
    EXPECT_NEAR(tabled.at_speed(1e5).supports.at(1).c[1][1], 0.6e5, 1e-6);
}

TEST(DenseRotor, element_moves_as_a_rigid_body_and_bends_as_a_cantilever) {
    const BeamMatrices beam = beam_matrices(tube);
    const double area = pi * (0.04 * 0.04 - 0.025 * 0.025);
    const double I = area * (0.04 * 0.04 + 0.025 * 0.025) / 4;
    const Eigen::Vector4d shift(1, 0, 1, 0);
    const Eigen::Vector4d turn(-0.15, 1, 0.15, 1);
    EXPECT_LT((beam.stiffness * shift).norm() + (beam.stiffness * turn).norm(),
              1e-10 * beam.stiffness.norm());
    const double mass = 7850 * area * 0.3;
    EXPECT_NEAR(shift.dot(beam.mass * shift), mass, 1e-12 * mass);
    const double inertia = mass * 0.3 * 0.3 / 12 + 7850 * I * 0.3;
    EXPECT_NEAR(turn.dot(beam.mass * turn), inertia, 1e-12 * inertia);
    EXPECT_NEAR(turn.dot(beam.gyroscopic * turn), 2 * 7850 * I * 0.3, 1e-12 * inertia);
    // Left end clamped: L^3/(3 EI) + L/(kappa G A), Cowper's kappa of the tube
    const double nu = 2.1e11 / 1.6e11 - 1;
    const double m2 = 0.625 * 0.625;
    const double s = (1 + m2) * (1 + m2);
    const double kappa = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
    const double tip = 0.027 / (3 * 2.1e11 * I) + 0.3 / (kappa * 8e10 * area);
    const Eigen::Matrix2d held = beam.stiffness.bottomRightCorner<2, 2>();
    EXPECT_NEAR(held.inverse()(0, 0), tip, 1e-12 * tip);
}

CaseRotor pinned(double tension, int elements) {
    CaseRotor rotor;
    Segment segment;
    segment.left = {0.9, 0.05, 0, 2e11, 2e11 / 2.6, 7800, 1e9};
    segment.outer_end = 0.05;
    segment.elements = elements;
    rotor.shaft = {segment};
    rotor.axial_force = tension;
    for (const double z : {0.0, 0.9}) {
        Support pin;
        pin.z = z;
        pin.k = {{{1e13, 0}, {0, 1e13}}};
        rotor.supports.push_back(pin);
    }
    return rotor;
}

TEST(DenseRotor, pinned_shaft) {
    const CaseRotor rotor = pinned(0, 24);
    const auto exact = pinned_rayleigh_frequencies(rotor.shaft[0].left, 3000, 6);
    const auto found = whirl_eigenvalues(dense_rotor(rotor), 3000);
    for (std::size_t i = 0; i < 6; ++i) { // cubic functions: w^2 too large by (k h)^4/720
        const double kh = static_cast<double>(i / 2 + 1) * pi / 24;
        EXPECT_NEAR(found.at(i).imag() / static_cast<double>(exact[i]), 1,
                    1.2 * std::pow(kh, 4) / 1440 + 1e-8)
            << i;
    }
}

TEST(DenseRotor, pinned_shaft_under_tension) {
    const double N = 2e5;
    const Cylinder c = pinned(N, 1).shaft[0].left;
    const double area = pi * 0.025 * 0.025;
    const double I = area * 0.025 * 0.025 / 4;
    const double k = pi / 0.9;
    const double omega =
        std::sqrt((c.E * I * std::pow(k, 4) + N * k * k) / (c.rho * area + c.rho * I * k * k));
    const auto found = whirl_eigenvalues(dense_rotor(pinned(N, 24)), 0);
    EXPECT_NEAR(found.at(0).imag() / omega, 1, 1e-6);
}

TEST(DenseRotor, converges_to_the_continuum) {
    const CaseRotor rotor = read_case(case_file("friswell_5_9_5"), {});
    const auto exact = continuum_eigenvalues(rotor, 400, 6);
    const auto coarse = whirl_eigenvalues(dense_rotor(rotor, 8), 400);
    const auto fine = whirl_eigenvalues(dense_rotor(rotor, 16), 400);
    for (std::size_t i = 0; i < 6; ++i) {
        const auto lambda = static_cast<std::complex<double>>(exact[i]);
        const double error = std::abs(fine.at(i) - lambda);
        EXPECT_LT(error, 2e-5 * std::abs(lambda)) << i;
        EXPECT_GT(std::abs(coarse.at(i) - lambda), 3 * error) << i; // as h^2
    }
}

/// Disc on a light shaft, damped inside only: forward whirl grows above the critical speed
/// (Genta 2005), in both oracles that know internal damping.
TEST(DenseRotor, internal_damping_drives_forward_whirl_above_the_critical_speed) {
    CaseRotor rotor = pinned(0, 4);
    rotor.shaft[0].left.rho = 1e-3;
    rotor.internal_damping = 1e-5;
    rotor.discs = {{0.45, 20, 0.2, 0.1}};
    const double critical = crossings(dense_rotor(rotor)).at(0).speed;
    for (const double ratio : {0.98, 1.02}) {
        const double speed = ratio * critical;
        double growth = -1e9;
        for (const auto &lambda : whirl_eigenvalues(dense_rotor(rotor), speed))
            if (std::abs(lambda.imag() / critical - 1) < 1e-2)
                growth = std::max(growth, lambda.real());
        EXPECT_EQ(growth > 0, ratio > 1);
        const auto exact = eigenvalue_near(Continuum(stepped(rotor)),
                                           {Motion::forward, speed, false}, Complex(0, critical));
        ASSERT_TRUE(exact.has_value());
        EXPECT_EQ(exact->real() > 0, ratio > 1);
        // eta w (Omega - w)/2 of a Jeffcott rotor
        EXPECT_NEAR(static_cast<double>(exact->real()), 1e-5 * critical * (speed - critical) / 2,
                    1e-2 * 1e-5 * critical * 0.01 * critical);
        EXPECT_NEAR(growth, static_cast<double>(exact->real()), 1e-3 * std::abs(growth));
    }
}

TEST(DenseRotor, crossings_are_whirl_frequencies_at_their_speeds) {
    const DenseRotor rotor = dense_rotor(read_case(case_file("nelson_mcvaugh_b"), {}));
    for (const double multiple : {0.5, 1.0, 2.0})
        for (std::size_t i = 0; i < 4; ++i) {
            const double speed = crossings(rotor, multiple).at(i).speed;
            double nearest = 1e9;
            for (const auto &lambda : whirl_eigenvalues(rotor, speed))
                nearest = std::min(nearest, std::abs(lambda.imag() - multiple * speed));
            EXPECT_LT(nearest, 1e-6 * speed);
        }
}

TEST(DenseRotor, response_of_an_isotropic_rotor_is_its_receptance) {
    CaseRotor rotor = read_case(case_file("friswell_5_9_5"), {"shaft.elements=16"});
    rotor.imbalances = {{0.5, 1e-4, 0.3}};
    const double speed = 250;
    const Complex H = receptance(stepped(rotor), Complex(0, speed), speed, {0.5})(0, 0);
    const double expected = static_cast<double>(std::abs(H)) * 1e-4 * speed * speed;
    EXPECT_NEAR(semi_major(rotor, speed, 0.5) / expected, 1, 1e-4);
}

TEST(ContinuumSpectrum, slices_of_a_cone_converge) {
    CaseRotor rotor = pinned(0, 1);
    const auto uniform = continuum_eigenvalues(rotor, 100, 4);
    rotor.shaft[0].outer_end = 0.05 * (1 + 1e-9); // a cone that is none
    const auto cone = continuum_eigenvalues(rotor, 100, 4);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT(static_cast<double>(std::abs(cone[i] / uniform[i] - Real(1))), 2e-9);
}

} // namespace

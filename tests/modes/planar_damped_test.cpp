// The planar form of damped rotors that are the same from every direction: closed forms, and the
// real form of twice the size.

#include "modes/formulation.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace whirl::modes {

namespace {

using results::Form;
using results::Whirl;
using Complex = std::complex<double>;

/// Every mode of one form has one in the other, of the same sense.
void expect_same(const model::Rotor &rotor, int order, double speed, int wanted) {
    const Spectrum planar = SpectrumSolver(rotor, Form::planar_damped, order).at(speed, wanted);
    const Spectrum real = SpectrumSolver(rotor, Form::general, order).at(speed, wanted + 4);
    ASSERT_EQ(static_cast<int>(planar.modes.size()), wanted);
    std::vector<bool> taken(real.modes.size(), false);
    for (const WhirlMode &mode : planar.modes) {
        double nearest = 1;
        std::size_t partner = 0;
        for (std::size_t i = 0; i < real.modes.size(); ++i) {
            const double distance =
                std::abs(real.modes[i].eigenvalue - mode.eigenvalue) / std::abs(mode.eigenvalue);
            if (!taken[i] && real.modes[i].whirl == mode.whirl && distance < nearest) {
                nearest = distance;
                partner = i;
            }
        }
        EXPECT_LT(nearest, 1e-9 + 10 * (mode.rounding + mode.residual)) << mode.eigenvalue;
        EXPECT_LT(mode.residual, 1e-9);
        taken[partner] = true;
    }
}

model::Rotor sample_rotor(std::mt19937 &random) {
    const auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto chance = [&] { return between(0, 1) < 0.5; };
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(between(0.6, 1.5), between(0.04, 0.1), tests::steel());
    rotor.shaft.segments[0].elements = 3;
    const double length = rotor.shaft.length();
    rotor.shaft.internal_damping = chance() ? between(1e-6, 2e-5) : 0;
    rotor.discs = {tests::disc_at(between(0.2, 0.8) * length, between(5, 40), 0.1, 0.18)};
    for (const double z : {0.0, length}) {
        model::Bearing bearing =
            tests::isotropic_bearing(z, std::pow(10, between(6, 8)), between(10, 3000));
        model::BearingCoefficients &row = bearing.rows[0];
        if (chance()) {
            const double across = between(-0.05, 0.05) * row.k(0, 0);
            row.k(0, 1) = across;
            row.k(1, 0) = -across;
        }
        if (chance()) {
            row.kt = between(1e3, 1e5) * Eigen::Matrix2d::Identity();
            row.ct = between(0.1, 10) * Eigen::Matrix2d::Identity();
        }
        if (chance())
            bearing.pedestal = model::Pedestal{between(1, 10), 1e8, between(0, 500)};
        if (chance()) {
            bearing.speeds = {0, 500};
            bearing.rows.push_back(bearing.rows[0]);
            bearing.rows[1].k *= 1.5;
            bearing.rows[1].c *= 0.6;
        }
        rotor.bearings.push_back(bearing);
    }
    return rotor;
}

} // namespace

TEST(PlanarDamped, IsTheRealFormOnRandomRotors) {
    std::mt19937 random(20240607);
    for (int draw = 0; draw < 24; ++draw) {
        SCOPED_TRACE(draw);
        const model::Rotor rotor = sample_rotor(random);
        for (const double speed : {0.0, 180.0, 900.0, -400.0})
            expect_same(rotor, 4, speed, 8);
    }
}

TEST(PlanarDamped, OfHeavyDampersToo) {
    // From overdamped bearings to bearings that are locked by their dampers.
    for (const double c : {1e4, 1e5, 1e6, 1e7}) {
        SCOPED_TRACE(c);
        model::Rotor rotor;
        rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
        rotor.discs = {tests::disc_at(0.4, 20, 0.1, 0.18)};
        rotor.bearings = {tests::isotropic_bearing(0, 1e6, c),
                          tests::isotropic_bearing(1, 2e6, c / 3)};
        for (const double speed : {50.0, 800.0})
            expect_same(rotor, 6, speed, 6);
    }
}

TEST(PlanarDamped, ARigidRotorIsItsFormulas) {
    // Bounce m l^2 + 2 c l + 2 k; tilt Id l^2 + (2 c a^2 - i W Ip) l + 2 k a^2.
    const double m = 40;
    const double Id = 2;
    const double Ip = 1.2;
    const double a = 0.5;
    const double k = 1e5;
    for (const double c : {10.0, 400.0})
        for (const double W : {30.0, 250.0, -250.0}) {
            model::Rotor rotor;
            rotor.shaft = tests::uniform_shaft(2 * a, 0.02, tests::weightless_steel());
            rotor.shaft.rigid = true;
            rotor.discs = {tests::disc_at(a, m, Id, Ip)};
            rotor.bearings = {tests::isotropic_bearing(0, k, c),
                              tests::isotropic_bearing(2 * a, k, c)};
            std::vector<Complex> expected;
            const auto roots = [&expected](double A, Complex B, double C) {
                const Complex root = std::sqrt(B * B - 4 * A * C);
                expected.push_back((-B + root) / (2 * A));
                expected.push_back((-B - root) / (2 * A));
            };
            roots(m, 2 * c, 2 * k);
            roots(Id, {2 * c * a * a, -W * Ip}, 2 * k * a * a);
            const Spectrum found = SpectrumSolver(rotor, Form::planar_damped, 1).at(W, 4);
            ASSERT_EQ(found.modes.size(), 4U);
            for (const Complex &value : expected) {
                const bool forward = (value.imag() > 0) == (W > 0);
                EXPECT_TRUE(std::any_of(found.modes.begin(), found.modes.end(),
                                        [&](auto &mode) {
                                            return std::abs(mode.rotating_value - value) <
                                                       1e-11 * std::abs(value) &&
                                                   mode.whirl ==
                                                       (forward ? Whirl::forward : Whirl::backward);
                                        }))
                    << value << " " << W;
            }
        }
}

TEST(PlanarDamped, IsChosenWhereItHolds) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e6), tests::isotropic_bearing(1, 1e6)};
    EXPECT_EQ(choose_formulation(scene).form, Form::planar);
    scene.rotor.bearings[0].rows[0].c = 10 * Eigen::Matrix2d::Identity();
    EXPECT_EQ(choose_formulation(scene).form, Form::planar_damped);
    EXPECT_EQ(without_planar_damped(choose_formulation(scene), scene.rotor).form, Form::general);
    EXPECT_EQ(results::unknowns_name(Form::planar_damped), "planar");
    EXPECT_EQ(results::frame_name(Form::planar_damped), "fixed");
    scene.formulation = model::FormChoice::general;
    EXPECT_EQ(choose_formulation(scene).form, Form::general);
    scene.formulation = model::FormChoice::automatic;
    scene.rotor.bearings[0].rows[0].c.setZero();
    scene.rotor.bearings[0].rows[0].k(0, 1) = 1e4;
    EXPECT_EQ(choose_formulation(scene).form, Form::general);
    scene.rotor.bearings[0].rows[0].k(1, 0) = -1e4;
    EXPECT_EQ(choose_formulation(scene).form, Form::planar_damped);
}

} // namespace whirl::modes

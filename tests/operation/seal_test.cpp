// Seals: bearings that carry nothing, with the mass of a fluid.

#include "analyses/critical.h"
#include "analyses/response.h"
#include "modes/spectrum.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <complex>

namespace {

using namespace whirl;
using Complex = std::complex<double>;

model::Bearing seal(double z, double mass, const model::BearingCoefficients &at = {}) {
    model::Bearing out;
    out.seal = true;
    out.z = z;
    out.rows = {at};
    out.rows[0].m = mass * Eigen::Matrix2d::Identity();
    return out;
}

/// A body of mass m held by a seal alone moves by (m + md) l^2 + (c - i cc) l + k - i kc = 0
/// (Childs 1993, force -(K u + C u' + M u'') with K = [k kc; -kc k] and so on).
TEST(Seal, HoldsARigidRotorAsItsFiveCoefficientsSay) {
    model::BearingCoefficients at;
    at.k << 1e6, 3e5, -3e5, 1e6;
    at.c << 900, 150, -150, 900;
    tests::RigidJeffcott rotor;
    rotor.kx = rotor.ky = rotor.c = 0;
    model::Case scene = rotor.scene();
    const double md = 2.5;
    scene.rotor.bearings = {seal(0.5, md, at)};
    scene.rotor.bearings[0].rows[0].kt = 1e5 * Eigen::Matrix2d::Identity(); // holds the tilt
    const Complex c(900, -150);
    const Complex k(1e6, -3e5);
    const Complex root = std::sqrt(c * c - 4 * (rotor.mass + md) * k);
    std::vector<Complex> expected;
    for (const double sign : {-1.0, 1.0}) {
        const Complex l = (-c + sign * root) / (2 * (rotor.mass + md));
        expected.emplace_back(l.real(), std::abs(l.imag()));
    }
    for (const results::Form form : {results::Form::planar_damped, results::Form::general}) {
        const modes::SpectrumSolver solver(scene.rotor, form, 1);
        const modes::Spectrum spectrum = solver.at(0, 4);
        for (const Complex &l : expected) {
            double nearest = 1e9;
            for (const modes::WhirlMode &mode : spectrum.modes)
                nearest = std::min(nearest, std::abs(mode.eigenvalue - l));
            EXPECT_LT(nearest, 1e-9 * std::abs(l)); // rounding of four unknowns
        }
    }
}

/// Fluid that moves along is a point mass: it neither turns nor tilts.
TEST(Seal, WithMassAloneIsAPointMass) {
    model::Case with_disc;
    with_disc.rotor = tests::two_disc_rotor(1e7, 2e7, 0, 500);
    with_disc.rotor.imbalances = {{"", 0.5, 1e-4, 0}};
    with_disc.speeds = model::SpeedRange{20, 400, 20};
    model::Case with_seal = with_disc;
    with_disc.rotor.discs.push_back(tests::disc(0.75, 8, 0, 0));
    with_seal.rotor.bearings.push_back(seal(0.75, 8));
    const auto a = analyses::critical_speeds(with_disc).critical_speeds;
    const auto b = analyses::critical_speeds(with_seal).critical_speeds;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        // Both are sums of the same entries: rounding.
        EXPECT_NEAR(b[i].speed / a[i].speed, 1, 1e-10);
        EXPECT_NEAR(b[i].real / a[i].real, 1, 1e-8);
    }
    const auto one = analyses::unbalance_response(with_disc);
    const auto other = analyses::unbalance_response(with_seal);
    ASSERT_EQ(one.nodes.size(), other.nodes.size());
    for (std::size_t i = 0; i < one.nodes.size(); ++i)
        for (std::size_t k = 0; k < one.speeds.size(); ++k) {
            EXPECT_NEAR(other.nodes[i].major[k] / one.nodes[i].major[k], 1, 1e-9);
            // The finer model has the same mass; rounding of both.
            EXPECT_LT(other.nodes[i].error[k], 1.001 * one.nodes[i].error[k] + 1e-10);
        }
    ASSERT_EQ(one.peaks.size(), other.peaks.size());
    for (std::size_t i = 0; i < one.peaks.size(); ++i)
        EXPECT_NEAR(other.peaks[i].speed / one.peaks[i].speed, 1, 1e-8);
}

/// Forms and routes that take the mass of supports in their own ways agree.
TEST(Seal, IsTheSameInEveryForm) {
    model::BearingCoefficients at;
    at.k << 4e5, 2e5, -2e5, 4e5;
    at.c << 300, 50, -50, 300;
    model::Rotor rotor = tests::two_disc_rotor(1e7, 1e7, 0, 500);
    rotor.bearings.push_back(seal(0.75, 8, at));
    const auto spectrum = [&rotor](results::Form form) {
        return modes::SpectrumSolver(rotor, form, 4).at(250, 6).modes;
    };
    const std::vector<modes::WhirlMode> general = spectrum(results::Form::general);
    for (const results::Form form : {results::Form::planar_damped, results::Form::rotating}) {
        const std::vector<modes::WhirlMode> other = spectrum(form);
        ASSERT_EQ(other.size(), general.size());
        for (std::size_t i = 0; i < general.size(); ++i)
            // Rounding of some fifty unknowns.
            EXPECT_LT(std::abs(other[i].eigenvalue - general[i].eigenvalue),
                      1e-8 * std::abs(general[i].eigenvalue));
    }
}

TEST(Seal, HasItsMassOnFewShapesToo) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 2e7, 0, 500);
    scene.rotor.imbalances = {{"", 0.5, 1e-4, 0}};
    scene.rotor.bearings.push_back(seal(0.75, 8));
    scene.speeds = model::SpeedRange{20, 400, 5};
    const auto few = analyses::response_peaks(scene, false).peaks;
    scene.reduction = false;
    const auto all = analyses::response_peaks(scene, false).peaks;
    ASSERT_EQ(few.size(), all.size());
    ASSERT_FALSE(all.empty());
    for (std::size_t i = 0; i < all.size(); ++i) {
        // What peaks on few shapes are confirmed to.
        EXPECT_NEAR(few[i].speed / all[i].speed, 1, 1e-8);
        EXPECT_NEAR(few[i].value / all[i].value, 1, 1e-7);
    }
}

TEST(Seal, IsNoBearingInTheLists) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 2e7, 0, 500);
    scene.rotor.imbalances = {{"", 0.5, 1e-4, 0}};
    scene.speeds = model::SpeedRange{20, 200, 3};
    scene.rotor.bearings.push_back(seal(0.75, 1));
    EXPECT_EQ(scene.rotor.supports().size(), 2U);
    EXPECT_EQ(scene.rotor.seals().size(), 1U);
    EXPECT_EQ(scene.rotor.seals().front().z, 0.75);
    const auto result = analyses::unbalance_response(scene);
    EXPECT_EQ(result.bearings.size(), 2U);
    for (const auto &peak : result.peaks)
        if (peak.of == "bearing") {
            EXPECT_NE(peak.z, 0.75);
        }
}

} // namespace

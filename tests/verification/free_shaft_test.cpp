// Shafts without supports: exact zeros, gyroscopic rigid modes and true bending frequencies.

#include "results/formulation.h"
#include "results/whirl.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using modes::Spectrum;
using results::Form;

constexpr std::array forms{Form::planar, Form::hyperbolic, Form::general};

/// Modes of exactly zero frequency; all others must be well away from zero.
std::size_t zeros(const Spectrum &spectrum, double smallest) {
    std::size_t count = 0;
    for (const auto &mode : spectrum.modes)
        if (mode.eigenvalue == std::complex<double>(0, 0))
            ++count;
        else
            EXPECT_GT(mode.eigenvalue.imag(), smallest);
    return count;
}

double euler_frequency(double length, double diameter) {
    // cos(b) cosh(b) = 1, first root; rho A = 4 rho I / (d/2)^2.
    const double b = 4.730040744862704;
    return b * b / (length * length) * std::sqrt(211e9 / 7810) * diameter / 4;
}

TEST(FreeShaft, AtRestHasExactZerosAndTheFrequencyOfTheEulerBeam) {
    // At slenderness 1e4 shear and rotary inertia lower the frequency by some 1e-7.
    const model::Rotor rotor = tests::uniform_shaft(1, 1e-4);
    const double euler = euler_frequency(1, 1e-4);
    for (const Form form : forms) {
        const Spectrum found = tests::spectrum_of(rotor, form, 10, 0, 6);
        // Translation and tilt in two planes: four motions of double zero eigenvalues.
        ASSERT_EQ(zeros(found, 0.9 * euler), 4U) << results::form_name(form);
        ASSERT_GE(found.modes.size(), 6U);
        EXPECT_NEAR(found.modes[4].eigenvalue.imag() / euler, 1, 1e-6);
        EXPECT_NEAR(found.modes[5].eigenvalue.imag() / euler, 1, 1e-6);
    }
}

TEST(FreeShaft, TurningHasTheConicalFrequencyOfTheRigidBody) {
    // Rigid body: translation stays at zero, the cone whirls forward at speed Ip/Id. Bending
    // softens it by about (speed / bending frequency)^2 = 1e-6.
    const double L = 1;
    const double d = 0.2;
    const model::Rotor rotor = tests::uniform_shaft(L, d);
    const double Ip_over_Id = (d * d / 8) / (d * d / 16 + L * L / 12);
    const double speed = 1e-3 * euler_frequency(L, d);
    for (const Form form : forms) {
        const Spectrum found = tests::spectrum_of(rotor, form, 8, speed, 6);
        const auto conical =
            std::find_if(found.modes.begin(), found.modes.end(),
                         [](const auto &mode) { return mode.eigenvalue.imag() > 0; });
        ASSERT_NE(conical, found.modes.end());
        EXPECT_NEAR(conical->eigenvalue.imag() / (speed * Ip_over_Id), 1, 2e-6)
            << results::form_name(form);
        EXPECT_EQ(conical->whirl, results::Whirl::forward);
        EXPECT_NEAR(conical->eigenvalue.real(), 0, 1e-9 * speed);
        // Two translations of double zeros, and the tilt at rest in each plane.
        EXPECT_EQ(zeros(found, 0.5 * speed * Ip_over_Id), 3U) << results::form_name(form);
    }
}

TEST(FreeShaft, DoesNotGetWorseWithRefinementNorUnstable) {
    const model::Rotor rotor = tests::two_disc_rotor(0, 0);
    const double speed = 4000 * tests::rpm;
    for (const Form form : forms) {
        const std::vector<double> reference =
            tests::frequencies(tests::spectrum_of(rotor, form, 10, speed, 8));
        for (const int refinement : {2, 8, 32}) {
            const Spectrum found = tests::spectrum_of(rotor, form, 6, speed, 8, refinement);
            ASSERT_EQ(zeros(found, 1), 3U) << results::form_name(form) << " " << refinement;
            for (std::size_t i = 3; i < 8; ++i) {
                const std::complex<double> l = found.modes[i].eigenvalue;
                // Rounding grows with the unknowns, and each mode says how far.
                const double said = found.modes[i].residual + found.modes[i].rounding;
                const double error = std::abs(l.imag() / reference[i] - 1);
                EXPECT_LT(error, 3 * said + 1e-10) << refinement << " " << i;
                EXPECT_LT(error, 1e-7) << refinement << " " << i;
                EXPECT_LT(std::abs(l.real()), 1e-7 * l.imag()) << refinement << " " << i;
            }
        }
    }
}

} // namespace

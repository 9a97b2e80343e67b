// Motions of an asymmetric rotor have two frequencies in the fixed frame: those of a Jeffcott rotor
// whose massless shaft has two stiffnesses, in closed form.

#include "modes/spectrum.h"
#include "results/formulation.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace two_frequencies {

using namespace whirl;

constexpr double length = 0.8;
constexpr double diameter = 0.025;
constexpr double mass = 9;
constexpr double asymmetry = 0.3;

model::Rotor jeffcott() {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(length, diameter, tests::weightless_steel());
    rotor.shaft.shear = model::ShearFormula::given;
    rotor.shaft.shear_coefficient = 1e9; // rigid in shear
    rotor.shaft.segments[0].asymmetry = asymmetry;
    rotor.shaft.segments[0].elements = 2;
    rotor.discs.push_back(tests::disc_at(length / 2, mass, 1e-3, 2e-3));
    for (const double z : {0.0, length})
        rotor.bearings.push_back(tests::isotropic_bearing(z, 1e13));
    return rotor;
}

/// Along and across the stiffer axis in axes that turn at W: x'' - 2W y' + (w1^2 - W^2) x = 0,
/// y'' + 2W x' + (w2^2 - W^2) y = 0. With x = cos(v t), y = s sin(v t), s = (w1^2 - W^2 -
/// v^2)/(2Wv): x + iy = (1 + s)/2 exp(ivt) + (1 - s)/2 exp(-ivt), in the fixed frame at W + v and W
/// - v.
struct ClosedForm {
    double w1_squared, w2_squared, W;

    [[nodiscard]] double squared(int sign) const {
        const double half = (w1_squared + w2_squared) / 2 + W * W;
        const double product = (w1_squared - W * W) * (w2_squared - W * W);
        return half + sign * std::sqrt(half * half - product);
    }
    [[nodiscard]] double share(double v) const { // of W - v over W + v
        const double s = (w1_squared - W * W - v * v) / (2 * W * v);
        return std::abs((1 - s) / (1 + s));
    }
};

TEST(TwoFrequencies, AreThoseOfTheClosedForm) {
    const double EI = 2e11 * std::numbers::pi * std::pow(diameter, 4) / 64;
    const double k = 48 * EI / std::pow(length, 3);
    const modes::SpectrumSolver solver(jeffcott(), results::Form::rotating, 3);
    int with_two = 0;
    int with_one = 0;
    for (const double of_mean : {0.1, 0.5, 0.8, 1.2, 1.5, 2.5, 6.0}) {
        const double W = of_mean * std::sqrt(k / mass);
        const ClosedForm exact{k / mass * (1 + asymmetry), k / mass * (1 - asymmetry), W};
        const modes::Spectrum spectrum = solver.at(W, 4);
        for (const int sign : {1, -1}) {
            const double v = std::sqrt(exact.squared(sign));
            const double share = exact.share(v);
            const double larger = std::abs(share < 1 ? W + v : W - v);
            const double smaller = std::abs(share < 1 ? W - v : W + v);
            const auto mode = std::find_if(
                spectrum.modes.begin(), spectrum.modes.end(), [&](const modes::WhirlMode &at) {
                    return std::abs(at.eigenvalue.imag() - larger) < 1e-6 * larger &&
                           std::abs(at.frequency_rotating - v) < 1e-6 * v;
                });
            ASSERT_NE(mode, spectrum.modes.end()) << of_mean << " " << larger;
            const bool two = std::min(share, 1 / share) >= 0.1;
            ASSERT_EQ(mode->other_frequency.has_value(), two) << of_mean << " " << share;
            if (two)
                EXPECT_NEAR(*mode->other_frequency, smaller, 1e-6 * (W + v));
            ++(two ? with_two : with_one);
        }
    }
    EXPECT_GT(with_two, 2);
    EXPECT_GT(with_one, 2);
}

} // namespace two_frequencies

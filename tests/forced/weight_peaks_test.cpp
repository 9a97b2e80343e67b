// Peaks of the motion under the weight: closed form of a disc on an asymmetric shaft, the whole
// rotor looked at speed by speed, finer elements.

#include "analyses/response.h"
#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/response_peaks.h"
#include "results/response.h"
#include "support/random.h"
#include "support/weighed_rotors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using Complex = std::complex<double>;
using results::Form;
using tests::g;
using tests::Keyway;
using tests::peaks_at;
using tests::Random;
using tests::station;
using tests::weighed_rotor;

constexpr Complex i_unit(0, 1);

TEST(WeightPeaks, PeakOfTheDampedKeywayShaftWhateverTheGrid) {
    Keyway keyway;
    keyway.c = 2000;
    // d |circle|^2 / dW = 0: |D|^2 least, D = 1 - 4 m W^2 (s + 1/(2 (k + 2 i W c))).
    const auto slope = [&](double W) {
        const Complex z = keyway.k + 2.0 * i_unit * W * keyway.c;
        const Complex s = keyway.mean() + 0.5 / z;
        const Complex D = 1.0 - 4 * keyway.mass * W * W * s;
        const Complex dD = -8 * keyway.mass * W * s +
                           4 * keyway.mass * W * W * (0.5 * 2.0 * i_unit * keyway.c / (z * z));
        return (std::conj(D) * dD).real();
    };
    double low = 60;
    double high = 130;
    while (high - low > 1e-13 * high)
        (slope((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    for (const int count : {2, 11, 1001}) {
        const auto peaks = peaks_at(analyses::unbalance_response(keyway.scene(1, 400, count)), 0.4);
        ASSERT_EQ(peaks.size(), 1U);
        EXPECT_NEAR(peaks[0].speed / low, 1, 1e-9);
        EXPECT_NEAR(peaks[0].value / std::abs(keyway.circle(low)), 1, 1e-9);
        EXPECT_NEAR(
            std::remainder(peaks[0].phase - std::arg(keyway.circle(low)), 2 * std::numbers::pi), 0,
            1e-6);
        ASSERT_TRUE(peaks[0].lower && peaks[0].upper);
        for (const double half : {*peaks[0].lower, *peaks[0].upper})
            EXPECT_NEAR(std::abs(keyway.circle(half)) * std::numbers::sqrt2 / peaks[0].value, 1,
                        1e-8);
    }
}

/// Half the critical speed of the mean shaft (F. M. Dimentberg, Flexural Vibrations of Rotating
/// Shafts, 1961; J. P. Den Hartog, Mechanical Vibrations); with the mean of the compliances
/// exactly.
TEST(WeightPeaks, CriticalAtHalfTheSpeedWithoutDamping) {
    for (const double asymmetry : {0.01, 0.06, 0.3}) {
        Keyway keyway;
        keyway.asymmetry = asymmetry;
        const double half = 0.5 / std::sqrt(keyway.mass * (keyway.mean() + 0.5 / keyway.k));
        auto scene = keyway.scene(1, 400, 11);
        const auto peaks = peaks_at(analyses::unbalance_response(scene), 0.4);
        ASSERT_EQ(peaks.size(), 1U);
        EXPECT_NEAR(peaks[0].speed / half, 1, 1e-9);
        EXPECT_TRUE(std::isinf(peaks[0].value));
        Keyway round = keyway;
        round.asymmetry = 0;
        const double critical = 1 / std::sqrt(round.mass * (round.mean() + 0.5 / round.k));
        EXPECT_NEAR(peaks[0].speed / (critical / 2), 1, asymmetry * asymmetry);
        scene.speeds = model::SpeedRange{peaks[0].speed, peaks[0].speed, 1};
        const auto there = analyses::unbalance_response(scene);
        EXPECT_TRUE(std::isinf(station(there, 0.4).twice[0]));
        EXPECT_TRUE(std::isinf(station(there, 0.4).sag[0]));
        ASSERT_EQ(there.model.notes.size(), 1U);
        EXPECT_NE(there.model.notes[0].find("no steady motion under the weight"),
                  std::string::npos);
    }
}

TEST(WeightPeaks, NoPeakIsMissingAndNoneFalseInRandomRotors) {
    Random random(34);
    int found = 0;
    for (int rotor = 0; rotor < 8; ++rotor) {
        const model::Case scene = weighed_rotor(random);
        const auto result = analyses::unbalance_response(scene);
        const assembly::Discretization d(scene.rotor, 2);
        forced::ForcedMotion motion(d, Form::rotating, {g});
        for (const model::Disc &disc : scene.rotor.discs) {
            const auto peaks = peaks_at(result, disc.z);
            const assembly::Combination w = d.deflection_at(disc.z);
            const auto circle = [&](double speed) {
                motion.solve(speed);
                return std::abs(motion.motion(w).x);
            };
            const auto expected = tests::looked_for(circle, 0.3, scene.speeds->to, 4000);
            ASSERT_EQ(peaks.size(), expected.size()) << "rotor " << rotor;
            for (std::size_t i = 0; i < peaks.size(); ++i, ++found) {
                // A search by values finds the place of a shallow one to the root of rounding.
                EXPECT_NEAR(peaks[i].speed / expected[i].first, 1, 1e-4) << "rotor " << rotor;
                EXPECT_NEAR(peaks[i].value / expected[i].second, 1, 1e-8) << "rotor " << rotor;
            }
        }
    }
    EXPECT_GT(found, 20);
}

TEST(WeightPeaks, TheGridOfItsPeaksDoesNotMatter) {
    Random random(35);
    for (int rotor = 0; rotor < 2; ++rotor) {
        model::Case scene = weighed_rotor(random);
        const auto coarse = analyses::unbalance_response(scene).gravity->peaks;
        scene.speeds->count = 1001;
        const auto fine = analyses::unbalance_response(scene).gravity->peaks;
        tests::expect_same_peaks(coarse, fine);
    }
}

TEST(WeightPeaks, ErrorsOfItsPeaksHold) {
    Random random(36);
    int compared = 0;
    for (int rotor = 0; rotor < 3; ++rotor) {
        model::Case scene = weighed_rotor(random);
        scene.rotor.shaft.order = 1 + rotor % 3;
        const auto coarse = analyses::unbalance_response(scene).gravity->peaks;
        scene.rotor.shaft.order = 10;
        const auto fine = analyses::unbalance_response(scene).gravity->peaks;
        SCOPED_TRACE(testing::Message() << "rotor " << rotor);
        compared += tests::expect_within_errors(coarse, fine);
    }
    EXPECT_GT(compared, 10);
}

/// In rotating axes rounding makes no peaks of nothing.
TEST(WeightPeaks, RoundingHasNoPeaks) {
    Random random(39);
    for (int rotor = 0; rotor < 6; ++rotor) {
        model::Case scene = weighed_rotor(random, false);
        if (rotor % 2 == 0) {
            scene.rotor.shaft.internal_damping = 0;
            for (model::Bearing &bearing : scene.rotor.bearings) {
                for (model::BearingCoefficients &row : bearing.rows)
                    row.c.setZero();
                bearing.pedestal.reset();
            }
        }
        const assembly::Discretization d(scene.rotor, 2);
        std::vector<forced::Quantity> quantities;
        for (const model::Disc &disc : scene.rotor.discs)
            quantities.push_back({.stretch = d.deflection_at(disc.z), .z = disc.z});
        const auto found =
            forced::response_peaks(d, Form::rotating, quantities, 0, scene.speeds->to, {{g}});
        EXPECT_TRUE(found.peaks.empty()) << rotor;
    }
}

} // namespace

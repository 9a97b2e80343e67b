// Peaks of the response: closed forms, the whole rotor looked at speed by speed, finer elements.

#include "analyses/critical.h"
#include "analyses/response.h"
#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/response_peaks.h"
#include "input/case_file.h"
#include "modes/orbits.h"
#include "results/critical.h"
#include "results/response.h"
#include "support/peaks.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using results::Form;
using results::ResponsePeak;
using tests::Random;

/// A disc on a rigid weightless shaft between two equal bearings: it moves without tilting.
model::Case jeffcott(double mass, double k, double c, double mr) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, mass, 0.1, 0.2)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, k / 2, c / 2),
                            tests::isotropic_bearing(1, k / 2, c / 2)};
    scene.rotor.imbalances = {tests::imbalance_at(0.5, mr)};
    return scene;
}

std::vector<ResponsePeak> at_place(const results::ResponseResult &result, const std::string &of,
                                   double z) {
    std::vector<ResponsePeak> out;
    for (const ResponsePeak &peak : result.peaks)
        if (peak.of == of && peak.z == z)
            out.push_back(peak);
    return out;
}

TEST(ResponsePeaks, JeffcottRotor) {
    const double mass = 20;
    const double k = 2e6;
    const double omega = std::sqrt(k / mass);
    for (const double zeta : {1e-5, 0.01, 0.1, 0.3, 0.6}) {
        model::Case scene = jeffcott(mass, k, 2 * zeta * mass * omega, 1e-3);
        for (const int count : {2, 11, 1001}) {
            scene.speeds = model::SpeedRange{10, 900, count};
            const auto result = analyses::unbalance_response(scene);
            const auto peaks = at_place(result, "station", 0.5);
            ASSERT_EQ(peaks.size(), 1U) << zeta;
            // r^2 / sqrt((1 - r^2)^2 + (2 zeta r)^2) is largest at r = 1/sqrt(1 - 2 zeta^2).
            const double e = 1e-3 / mass;
            EXPECT_NEAR(peaks[0].speed * std::sqrt(1 - 2 * zeta * zeta) / omega, 1, 1e-10);
            EXPECT_NEAR(peaks[0].value * 2 * zeta * std::sqrt(1 - zeta * zeta) / e, 1, 1e-9);
            // tan = -2 zeta r / (1 - r^2), against the imbalance above the resonance.
            const double r = peaks[0].speed / omega;
            EXPECT_NEAR(peaks[0].phase, std::atan2(-2 * zeta * r, 1 - r * r), 1e-6 / zeta * 1e-3);
            // Half the square: with x = 1/r^2, x^2 + (4 zeta^2 - 2) x + 1 = 8 zeta^2 (1 - zeta^2).
            const double b = 2 * zeta * zeta - 1;
            const double d = std::sqrt(b * b - 1 + 8 * zeta * zeta * (1 - zeta * zeta));
            ASSERT_TRUE(peaks[0].lower);
            EXPECT_NEAR(*peaks[0].lower / (omega / std::sqrt(-b + d)), 1, 1e-9);
            const double upper = -b - d > 0 ? omega / std::sqrt(-b - d) : INFINITY;
            if (upper < 1.3 * 900) {
                ASSERT_TRUE(peaks[0].upper) << zeta;
                EXPECT_NEAR(*peaks[0].upper / upper, 1, 1e-9);
                EXPECT_NEAR(*peaks[0].amplification * (*peaks[0].upper - *peaks[0].lower),
                            peaks[0].speed, 1e-12 * peaks[0].speed);
            } else {
                EXPECT_FALSE(peaks[0].upper);
                EXPECT_FALSE(peaks[0].amplification);
            }
        }
    }
}

TEST(ResponsePeaks, HardlyAnyDampingLimitsThem) {
    const double mass = 20;
    const double k = 2e6;
    const double omega = std::sqrt(k / mass);
    for (const double zeta : {1e-6, 3e-7, 1e-7}) {
        model::Case scene = jeffcott(mass, k, 2 * zeta * mass * omega, 1e-3);
        scene.speeds = model::SpeedRange{10, 900, 11};
        const auto peaks = at_place(analyses::unbalance_response(scene), "station", 0.5);
        ASSERT_EQ(peaks.size(), 1U) << zeta;
        EXPECT_NEAR(peaks[0].speed / omega, 1, 1e-10);
        // What is left of k - m Omega^2 there has the rounding of k.
        EXPECT_NEAR(peaks[0].value * 2 * zeta / (1e-3 / mass), 1, 1e-15 / zeta);
        ASSERT_TRUE(peaks[0].amplification);
        // Half-power points are found to 1e-12 of the speed.
        EXPECT_NEAR(*peaks[0].amplification * 2 * zeta, 1, 1e-12 / zeta);
    }
}

TEST(ResponsePeaks, OfEitherSignOfTheSpeedAndFarBelowTheTop) {
    model::Case scene = jeffcott(20, 2e6, 2 * 0.01 * std::sqrt(2e6 * 20), 1e-3);
    const double top = std::sqrt(2e6 / 20 / (1 - 2 * 0.01 * 0.01));
    for (const auto &[from, to] : {std::pair(-900.0, 900.0), {-900.0, -10.0}, {-900.0, 0.0}}) {
        scene.speeds = model::SpeedRange{from, to, 11};
        const auto peaks = at_place(analyses::unbalance_response(scene), "station", 0.5);
        ASSERT_EQ(peaks.size(), to > 0 ? 2U : 1U);
        EXPECT_NEAR(peaks.front().speed / -top, 1, 1e-10);
        EXPECT_NEAR(peaks.back().speed / (to > 0 ? top : -top), 1, 1e-10);
    }
    scene.speeds = model::SpeedRange{0, 1e6, 3};
    const auto peaks = at_place(analyses::unbalance_response(scene), "station", 0.5);
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_NEAR(peaks[0].speed / top, 1, 1e-10);
}

TEST(ResponsePeaks, TooMuchDampingLeavesNone) {
    model::Case scene = jeffcott(20, 2e6, 0.75 * 2 * 20 * std::sqrt(2e6 / 20), 1e-3);
    scene.speeds = model::SpeedRange{10, 900, 11};
    EXPECT_TRUE(at_place(analyses::unbalance_response(scene), "station", 0.5).empty());
}

TEST(ResponsePeaks, WithoutDampingTheyAreTheCriticalSpeeds) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.06, tests::steel());
    scene.rotor.shaft.segments[0].elements = 4;
    scene.rotor.discs = {tests::disc_at(0.4, 15, 0.1, 0.18), tests::disc_at(0.9, 25, 0.2, 0.35)};
    for (const bool equal : {true, false}) {
        scene.rotor.bearings = {tests::isotropic_bearing(0, 2e7),
                                tests::isotropic_bearing(1.2, 3e7)};
        if (!equal)
            scene.rotor.bearings[0].rows[0].k(1, 1) *= 1.5;
        scene.rotor.imbalances = {tests::imbalance_at(0.4, 1e-4),
                                  tests::imbalance_at(0.9, 3e-4, 2)};
        scene.speeds = model::SpeedRange{0, 1500, 11};
        const auto peaks = at_place(analyses::unbalance_response(scene), "station", 0.4);
        std::vector<double> expected;
        for (const auto &critical : analyses::critical_speeds(scene).critical_speeds)
            if (critical.speed < 1500 && (!equal || critical.whirl == results::Whirl::forward))
                expected.push_back(critical.speed); // circles drive forward whirl alone
        ASSERT_EQ(peaks.size(), expected.size());
        ASSERT_GE(peaks.size(), 2U);
        for (std::size_t i = 0; i < peaks.size(); ++i) {
            EXPECT_NEAR(peaks[i].speed / expected[i], 1, 1e-8);
            EXPECT_TRUE(std::isinf(peaks[i].value));
        }
    }
}

/// Some flexible rotor with damping.
model::Case random_rotor(Random &random) {
    model::Case scene;
    model::Rotor &rotor = scene.rotor;
    rotor.shaft = tests::uniform_shaft(1.0, random(0.03, 0.08), tests::steel());
    rotor.shaft.segments[0].elements = 5;
    rotor.shaft.internal_damping = random.coin() ? 0 : random(1e-6, 1e-5);
    for (int i = 0; i < 2; ++i)
        rotor.discs.push_back(
            tests::disc_at(random(0.1, 0.95), random(5, 30), random(0.05, 0.2), random(0.05, 0.3)));
    const bool equal = random.coin();
    for (const double z : {random(0, 0.2), random(0.8, 1)}) {
        model::Bearing bearing = tests::isotropic_bearing(z, std::pow(10, random(6, 7.5)),
                                                          std::pow(10, random(1.5, 3.5)));
        model::BearingCoefficients &row = bearing.rows[0];
        if (!equal) {
            row.k(1, 1) *= random(0.4, 2.5);
            row.k(0, 1) = random(-0.1, 0.1) * row.k(0, 0);
            row.c(1, 1) *= random(0.4, 2.5);
        }
        tests::attach_at_random(bearing, random, 0.2, 2);
        rotor.bearings.push_back(bearing);
    }
    rotor.imbalances = {tests::imbalance_at(rotor.discs[0].z, 1e-4),
                        tests::imbalance_at(rotor.discs[1].z, random(1e-5, 3e-4), random(0, 6))};
    scene.speeds = model::SpeedRange{0, random(800, 2000), 11};
    return scene;
}

/// Semi-major axis of the whole rotor at a place.
class Orbit {
  public:
    Orbit(const assembly::Discretization &d, Form form, double z)
        : _motion(d, form), _w(d.deflection_at(z)) {}

    double operator()(double speed) {
        _motion.solve(speed);
        const forced::Phasor u = _motion.motion(_w);
        return modes::ellipse_of(u.x, u.y).major;
    }

  private:
    forced::ForcedMotion _motion;
    assembly::Combination _w;
};

TEST(ResponsePeaks, NoneMissingNoneFalseInRandomRotors) {
    Random random(11);
    int found = 0;
    for (int rotor = 0; rotor < 8; ++rotor) {
        model::Case scene = random_rotor(random);
        scene.rotor.shaft.order = 2;
        const auto result = analyses::unbalance_response(scene);
        const assembly::Discretization d(scene.rotor, result.model.order);
        for (const model::Disc &disc : scene.rotor.discs) {
            const auto peaks = at_place(result, "station", disc.z);
            Orbit orbit(d, result.model.formulation.form, disc.z);
            const auto expected = tests::looked_for(orbit, 0.3, scene.speeds->to, 6000);
            ASSERT_EQ(peaks.size(), expected.size()) << "rotor " << rotor;
            for (std::size_t i = 0; i < peaks.size(); ++i) {
                // A search by values finds the place to the root of rounding.
                EXPECT_NEAR(peaks[i].speed / expected[i].first, 1, 1e-6) << "rotor " << rotor;
                EXPECT_NEAR(peaks[i].value / expected[i].second, 1, 1e-8) << "rotor " << rotor;
                ++found;
            }
        }
    }
    EXPECT_GT(found, 30);
}

/// On bearings alike in all directions a probe reads the radius of the orbit, whichever way it
/// looks; on others its peaks are those of |x| and of |y|, which decouple in the Jeffcott rotor.
TEST(ResponsePeaks, OfProbes) {
    const double mass = 20;
    const double zeta = 0.02;
    model::Case scene = jeffcott(mass, 2e6, 2 * zeta * std::sqrt(2e6 * mass), 1e-3);
    scene.speeds = model::SpeedRange{10, 900, 11};
    scene.rotor.probes = {{"x", 0.5, 0}, {"y", 0.5, std::numbers::pi / 2}};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].k(1, 1) *= 2;
    const auto peaks = at_place(analyses::unbalance_response(scene), "probe", 0.5);
    ASSERT_EQ(peaks.size(), 2U);
    for (const int i : {0, 1}) {
        const double k = i == 0 ? 2e6 : 4e6;
        const double ratio = zeta * std::sqrt(2e6 / k); // the same damper on a stiffer spring
        const auto &peak = peaks[static_cast<std::size_t>(i)];
        EXPECT_NEAR(peak.speed / std::sqrt(k / mass / (1 - 2 * ratio * ratio)), 1, 1e-10);
        EXPECT_NEAR(peak.value / (1e-3 / mass / (2 * ratio * std::sqrt(1 - ratio * ratio))), 1,
                    1e-9);
        EXPECT_EQ(peak.angle, scene.rotor.probes[static_cast<std::size_t>(i)].angle);
    }
}

TEST(ResponsePeaks, TheGridDoesNotMatter) {
    Random random(12);
    for (int rotor = 0; rotor < 4; ++rotor) {
        model::Case scene = random_rotor(random);
        const auto coarse = analyses::unbalance_response(scene).peaks;
        scene.speeds->count = 1001;
        const auto fine = analyses::unbalance_response(scene).peaks;
        tests::expect_same_peaks(coarse, fine);
    }
}

// The shipped rotor of three discs at its own 121 speeds: every local maximum of its curves at
// 60,001 speeds is listed once, within a step of where it is seen there and no lower than it, and
// nothing else is.
TEST(ResponsePeaks, OfThreeDiscsAreTheMaximaOfAFineGrid) {
    model::Case scene = input::load_case(std::string(WHIRL_ROOT) + "/cases/lalanne_three_discs");
    const auto result = analyses::unbalance_response(scene);
    ASSERT_EQ(result.speeds.size(), 121U);
    scene.speeds->count = 60001;
    const std::vector<double> speeds = scene.speeds->values();
    const assembly::Discretization d(scene.rotor, result.model.order);
    forced::ForcedMotion motion(d, forced::response_formulation(scene).form);
    std::vector<std::vector<double>> amplitudes(result.nodes.size());
    for (const double speed : speeds) {
        motion.solve(speed);
        for (std::size_t i = 0; i < amplitudes.size(); ++i) {
            const forced::Phasor u = motion.at(result.nodes[i].z);
            amplitudes[i].push_back(modes::ellipse_of(u.x, u.y).major);
        }
    }
    const double step = speeds[1] - speeds[0];
    for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        const std::vector<double> &curve = amplitudes[i];
        const auto listed = at_place(result, "station", result.nodes[i].z);
        std::size_t seen = 0;
        for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
            if (curve[k] <= curve[k - 1] || curve[k] < curve[k + 1])
                continue;
            ASSERT_LT(seen, listed.size()) << speeds[k];
            EXPECT_NEAR(listed[seen].speed, speeds[k], step);
            EXPECT_GE(listed[seen].value, curve[k] * (1 - 1e-10)); // rounding of both
            // The curve is a parabola there: within half a step it falls by less than this.
            const double fall = 2 * curve[k] - curve[k - 1] - curve[k + 1];
            EXPECT_LE(listed[seen].value, curve[k] + fall) << speeds[k];
            ++seen;
        }
        EXPECT_EQ(seen, listed.size()) << result.nodes[i].z;
        EXPECT_GT(seen, 3U) << result.nodes[i].z;
    }
}

/// Of three resonances a number of quantities have their peaks a little apart each: one comparison
/// does for those of one resonance, and not for two resonances however near.
TEST(ResponsePeaks, AreComparedWithTheWholeRotorEachAtItsResonance) {
    Random random(15);
    for (const double apart : {0.3, 2.0, 50.0}) { // widths
        std::vector<forced::Peak> peaks;
        constexpr double width = 0.7;
        for (std::size_t quantity = 0; quantity < 5; ++quantity)
            for (const int resonance : {0, 1, 2}) {
                forced::Peak peak;
                peak.quantity = quantity;
                peak.width = width;
                peak.value = 1;
                peak.speed = 100 + (resonance * apart + random(-0.04, 0.04)) * width;
                peaks.push_back(peak);
            }
        const std::vector<double> speeds = forced::CurvePeaks::compared_speeds(peaks);
        EXPECT_EQ(speeds.size(), 3U) << apart;
        for (const forced::Peak &peak : peaks)
            EXPECT_TRUE(std::ranges::any_of(speeds, [&](double speed) {
                return std::abs(speed - peak.speed) <= 0.1 * width;
            })) << apart;
        for (forced::Peak &peak : peaks) // nothing to compare at a resonance without damping
            peak.value = INFINITY;
        EXPECT_TRUE(forced::CurvePeaks::compared_speeds(peaks).empty());
    }
}

/// Broad peaks of heavily damped rotors stand at no resonance, each quantity has its own, and
/// several lie within the width of one another: all are values of the whole rotor.
TEST(ResponsePeaks, OfHeavilyDampedRotorsAreValuesOfTheWholeRotor) {
    Random random(14);
    int compared = 0;
    for (int rotor = 0; rotor < 8; ++rotor) {
        model::Case scene = random_rotor(random);
        for (model::Bearing &bearing : scene.rotor.bearings)
            bearing.rows[0].c *= std::pow(10, random(0.5, 2.5));
        const assembly::Discretization d(scene.rotor, 3);
        const Form form = forced::response_formulation(scene).form;
        std::vector<forced::Quantity> quantities;
        for (const model::Disc &disc : scene.rotor.discs)
            quantities.push_back({d.deflection_at(disc.z)});
        for (const int b : {0, 1})
            quantities.push_back({forced::stretch_of_bearing(d, b), b});
        forced::PeakOptions options;
        options.with_errors = false;
        const auto found = forced::response_peaks(d, form, quantities, 1, 5000, options);
        forced::ForcedMotion whole(d, form);
        for (const forced::Peak &peak : found.peaks) {
            whole.solve(peak.speed);
            const forced::Quantity &of = quantities[peak.quantity];
            const forced::Phasor u = of.bearing == forced::Quantity::deflection
                                         ? whole.motion(of.stretch)
                                         : whole.bearing_force(of.bearing);
            const double value = modes::ellipse_of(u.x, u.y).major;
            // Documented: 1e-9; and rounding of what is compared with.
            EXPECT_NEAR(peak.value / value, 1, 1e-9 + peak.rounding + whole.rounding())
                << "rotor " << rotor << " at " << peak.speed;
            ++compared;
        }
    }
    EXPECT_GT(compared, 60);
}

TEST(ResponsePeaks, ErrorsHold) {
    Random random(13);
    int compared = 0;
    for (int rotor = 0; rotor < 12; ++rotor) {
        model::Case scene = random_rotor(random);
        scene.rotor.shaft.order = 1 + rotor % 3;
        const auto coarse = analyses::unbalance_response(scene).peaks;
        scene.rotor.shaft.order = 10;
        const auto fine = analyses::unbalance_response(scene).peaks;
        SCOPED_TRACE(testing::Message() << "rotor " << rotor);
        compared += tests::expect_within_errors(coarse, fine);
    }
    EXPECT_GT(compared, 60);
}

} // namespace

// Bearing tables with many rows: along straight lines they are the tables with few, along curves
// the readings, poles and peaks are those of the whole rotor.

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "forced/response_peaks.h"
#include "forced/swept_motion.h"
#include "modes/orbits.h"
#include "results/critical.h"
#include "results/response.h"
#include "support/peaks.h"
#include "support/scenes.h"
#include "synchronous/critical_speeds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace many_rows {

using namespace whirl;
using results::Form;

/// Two discs on a shaft of order 4; bearings as given at each speed.
template <class At> model::Rotor rotor(const std::vector<double> &speeds, At at) {
    model::Rotor out;
    out.shaft = tests::uniform_shaft(1.2, 0.05, tests::steel());
    out.shaft.segments[0].elements = 4;
    out.discs = {tests::disc_at(0.4, 15, 0.1, 0.18), tests::disc_at(0.9, 25, 0.2, 0.35)};
    for (const double z : {0.0, 1.2}) {
        model::Bearing bearing;
        bearing.z = z;
        bearing.speeds = speeds;
        for (const double speed : speeds)
            bearing.rows.push_back(at(speed));
        out.bearings.push_back(bearing);
    }
    out.imbalances = {tests::imbalance_at(0.4, 1e-4), tests::imbalance_at(0.9, 2e-4, 1)};
    return out;
}

/// Coefficients along curves; not the same in x and y unless `isotropic`.
model::BearingCoefficients curve(double speed, bool isotropic, bool damped) {
    model::BearingCoefficients out;
    const double k = 4e6 * (1 + std::pow(speed / 600, 2)) / (1 + speed / 900);
    out.k = k * Eigen::Matrix2d::Identity();
    out.c = (damped ? 900 * std::exp(-speed / 700) : 0) * Eigen::Matrix2d::Identity();
    if (!isotropic) {
        out.k(1, 1) *= 1.6 + speed / 3000;
        if (damped) {
            out.k(0, 1) = 2e5 * std::sin(speed / 200);
            out.k(1, 0) = -3e5;
            out.c(1, 1) *= 0.5;
        }
    }
    return out;
}

std::vector<double> even(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(from + (to - from) * i / (count - 1));
    return out;
}

constexpr int rows = 181;

TEST(ManyRows, OfACurveBendNowhereButAtTheEnds) {
    const model::Rotor smooth =
        rotor(even(0, 900, 901), [](double s) { return curve(s, false, true); });
    EXPECT_EQ(smooth.table_bends(), (std::vector<double>{0, 900}));
    const model::Rotor coarse =
        rotor({0, 300, 900}, [](double s) { return curve(s, false, true); });
    EXPECT_EQ(coarse.table_bends(), (std::vector<double>{0, 300, 900}));
}

TEST(ManyRows, MotionsAreThoseOfTheEquations) {
    for (const bool isotropic : {true, false}) {
        const model::Rotor whole =
            rotor(even(20, 900, rows), [=](double s) { return curve(s, isotropic, true); });
        const Form form = isotropic ? Form::planar : Form::general;
        const assembly::Discretization d(whole, 4);
        std::vector<forced::Quantity> quantities{{d.deflection_at(0.4)}, {d.deflection_at(1.2)}};
        quantities.push_back({forced::stretch_of_bearing(d, 1), 1});
        forced::SweptMotion motion(d, form, quantities, {}, 10, 900);
        ASSERT_EQ(motion.cuts().size(), rows + 1U); // the ends, and the rows but for the last
        forced::ForcedMotion full(d, form);
        for (double speed = 11.3; speed < 900; speed += 7.7) {
            full.solve(speed);
            const auto values = motion.at(speed);
            ASSERT_TRUE(values);
            for (Eigen::Index q = 0; q < 3; ++q) {
                const forced::Quantity &of = quantities[static_cast<std::size_t>(q)];
                const forced::Phasor expected =
                    q < 2 ? full.motion(of.stretch) : full.bearing_force(of.bearing);
                const double size = std::hypot(std::abs(expected.x), std::abs(expected.y));
                // The motions that they are made of are fitted to 1e-11.
                EXPECT_LE(std::abs(values->numbers(q, 0) - expected.x), 1e-10 * size) << speed;
                EXPECT_LE(std::abs(values->numbers(q, 1) - expected.y), 1e-10 * size) << speed;
            }
        }
    }
}

/// Journals that hardly float at low speed.
TEST(ManyRows, OfWhichOneIsStifferByPowersOfTen) {
    const model::Rotor whole = rotor({0, 200, 400, 600, 900}, [](double s) {
        model::BearingCoefficients out;
        const double k = s == 0 ? 1e14 : s == 200 ? 1e9 : 6e6 - 2e3 * s;
        out.k = Eigen::Vector2d(k, 0.7 * k).asDiagonal();
        out.c = 300 * Eigen::Matrix2d::Identity();
        return out;
    });
    const assembly::Discretization d(whole, 4);
    forced::SweptMotion motion(d, Form::general, {{d.deflection_at(0.4)}}, {}, 10, 900);
    forced::ForcedMotion full(d, Form::general);
    for (double speed = 11.3; speed < 900; speed += 7.7) {
        full.solve(speed);
        const forced::Phasor expected = full.at(0.4);
        const auto values = motion.at(speed);
        ASSERT_TRUE(values);
        // 1e-11 of a motion in bearings that are stiffer than the rotor by a thousand.
        const double size = std::hypot(std::abs(expected.x), std::abs(expected.y));
        EXPECT_LE(std::abs(values->numbers(0, 0) - expected.x), 1e-8 * size) << speed;
        EXPECT_LE(std::abs(values->numbers(0, 1) - expected.y), 1e-8 * size) << speed;
    }
}

/// Without damping the amplitude has no limit at the synchronous critical speeds, found from row
/// to row by another method.
TEST(ManyRows, PeaksWithoutDampingAreAtTheCriticalSpeeds) {
    for (const bool isotropic : {true, false}) {
        const model::Rotor whole =
            rotor(even(20, 900, rows), [=](double s) { return curve(s, isotropic, false); });
        const Form form = isotropic ? Form::planar : Form::general;
        const assembly::Discretization d(whole, 4);
        std::vector<double> found;
        forced::PeakOptions options;
        options.with_errors = false;
        for (const forced::Peak &peak :
             forced::response_peaks(d, form, {{d.deflection_at(0.4)}}, 20, 900, options).peaks)
            if (std::isinf(peak.value))
                found.push_back(peak.speed);
        std::vector<double> expected;
        for (const modes::WhirlMode &mode :
             synchronous::all_synchronous_modes(d, form, 1, 1000).modes)
            if (mode.eigenvalue.imag() > 20 && mode.eigenvalue.imag() < 900 &&
                (!isotropic || mode.whirl == results::Whirl::forward))
                expected.push_back(mode.eigenvalue.imag());
        ASSERT_EQ(found.size(), expected.size());
        ASSERT_GE(found.size(), 2U);
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]);
    }
}

/// Peaks by looking at the whole rotor at very many speeds.
TEST(ManyRows, PeaksAreThoseOfTheWholeRotor) {
    model::Case scene;
    scene.rotor = rotor(even(20, 900, rows), [](double s) { return curve(s, false, true); });
    scene.rotor.shaft.order = 4;
    scene.speeds = model::SpeedRange{30, 850, 5};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    const assembly::Discretization d(scene.rotor, 4);
    forced::ForcedMotion full(d, Form::general);
    const auto place = d.deflection_at(0.4);
    const auto expected = tests::looked_for(
        [&](double speed) {
            full.solve(speed);
            const forced::Phasor motion = full.motion(place);
            return modes::ellipse_of(motion.x, motion.y).major;
        },
        30, 850, 2000);
    std::vector<results::ResponsePeak> found;
    for (const results::ResponsePeak &peak : result.peaks)
        if (peak.of == "station" && peak.z == 0.4)
            found.push_back(peak);
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GE(found.size(), 2U);
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].speed, expected[i].first, 2e-7 * expected[i].first);
        EXPECT_NEAR(found[i].value, expected[i].second, 1e-9 * expected[i].second);
    }
}

/// Rows on the lines between others change nothing.
TEST(ManyRows, OnStraightLinesAreThoseOfTheLines) {
    const std::vector<double> few{40, 300, 500, 900};
    model::Case scene;
    scene.rotor = rotor(few, [](double s) { return curve(s, false, true); });
    scene.rotor.shaft.internal_damping = 1e-4;
    scene.speeds = model::SpeedRange{30, 850, 7};
    model::Case many = scene;
    for (model::Bearing &bearing : many.rotor.bearings) {
        const model::Bearing lines = bearing;
        for (const double speed : even(40, 900, 173)) // 5 rad/s: the rows are among them
            if (std::find(few.begin(), few.end(), speed) == few.end()) {
                const auto place =
                    std::upper_bound(bearing.speeds.begin(), bearing.speeds.end(), speed);
                bearing.rows.insert(bearing.rows.begin() + (place - bearing.speeds.begin()),
                                    lines.at(speed));
                bearing.speeds.insert(place, speed);
            }
    }
    ASSERT_EQ(many.rotor.bearings[0].speeds.size(), 173U);
    ASSERT_EQ(many.rotor.table_bends(), few);
    const auto critical = analyses::critical_speeds(scene).critical_speeds;
    const auto critical_many = analyses::critical_speeds(many).critical_speeds;
    ASSERT_EQ(critical.size(), critical_many.size());
    for (std::size_t i = 0; i < critical.size(); ++i)
        EXPECT_NEAR(critical[i].speed, critical_many[i].speed, 1e-10 * critical[i].speed);
    const auto ends = analyses::stability(scene, {}).ends;
    const auto ends_many = analyses::stability(many, {}).ends;
    ASSERT_EQ(ends.size(), ends_many.size());
    ASSERT_GE(ends.size(), 1U);
    for (std::size_t i = 0; i < ends.size(); ++i) {
        EXPECT_NEAR(ends[i].speed, ends_many[i].speed, 1e-9 * ends[i].speed);
        EXPECT_EQ(ends[i].growing_above, ends_many[i].growing_above);
    }
    const auto peaks = analyses::unbalance_response(scene).peaks;
    const auto peaks_many = analyses::unbalance_response(many).peaks;
    ASSERT_EQ(peaks.size(), peaks_many.size());
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        EXPECT_NEAR(peaks[i].speed, peaks_many[i].speed, 1e-9 * peaks[i].speed);
        EXPECT_NEAR(peaks[i].value, peaks_many[i].value, 1e-9 * peaks[i].value);
    }
}

} // namespace many_rows

#include "analyses/campbell.h"
#include "input/case_file.h"
#include "modes/spectrum.h"
#include "results/campbell.h"
#include "support/scenes.h"
#include "support/test_rotors.h"
#include "tracking/crossing_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace whirl;
using Function = std::function<double(double)>;

/// All speeds at which `next_probe` finds a root of f by looking again and again.
void look(const Function &f, const Function &slope, double a, double b, int depth,
          std::vector<double> &roots) {
    const auto end = [&](double x) { return tracking::StepEnd{x, f(x), slope(x), 1e-12}; };
    const auto c = tracking::next_probe(end(a), end(b), depth);
    if (!c || depth > 60)
        return;
    ASSERT_GT(*c, a);
    ASSERT_LT(*c, b);
    if (std::abs(f(*c)) <= 1e-12)
        roots.push_back(*c);
    look(f, slope, a, *c, depth + 1, roots);
    look(f, slope, *c, b, depth + 1, roots);
}

std::vector<double> roots_of(const Function &f, const Function &slope) {
    std::vector<double> roots;
    look(f, slope, 0, 1, 0, roots);
    std::sort(roots.begin(), roots.end());
    return roots;
}

void expect_roots(const std::vector<double> &found, const std::vector<double> &expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-6) << i; // f = 1e-12 near a slope of some 1e-2
}

TEST(CrossingStep, FindsOneTwoAndThreeRootsInAStep) {
    expect_roots(roots_of([](double x) { return x - 0.3; }, [](double) { return 1; }), {0.3});
    expect_roots(roots_of([](double x) { return (x - 0.3) * (x - 0.32); },
                          [](double x) { return 2 * x - 0.62; }),
                 {0.3, 0.32});
    expect_roots(roots_of([](double x) { return (x - 0.2) * (x - 0.5) * (x - 0.9); },
                          [](double x) { return 3 * x * x - 3.2 * x + 0.73; }),
                 {0.2, 0.5, 0.9});
    // Steep on one side, as a line that a bearing table lifts.
    expect_roots(roots_of([](double x) { return 1 - 1.5 * x + std::exp(20 * (x - 0.9)); },
                          [](double x) { return -1.5 + 20 * std::exp(20 * (x - 0.9)); }),
                 {0.67391346, 0.82953153}); // by bisection, to eight digits
}

TEST(CrossingStep, FindsNoRootWhereALineTurnsBack) {
    for (const double height : {1e-3, 1e-6})
        EXPECT_TRUE(roots_of([=](double x) { return (x - 0.4) * (x - 0.4) + height; },
                             [](double x) { return 2 * (x - 0.4); })
                        .empty());
    EXPECT_TRUE(roots_of([](double x) { return 2 + x; }, [](double) { return 1; }).empty());
}

/// A motion that turns at nu + rate (speed - first) in the rotor, as one of its frequencies in the
/// fixed frame: sign * that + turns * speed, turns odd.
struct Alias {
    double nu, rate, first, sign, turns;
    [[nodiscard]] double distance(double speed, double multiple) const {
        return sign * (nu + rate * (speed - first)) + (turns - multiple) * speed;
    }
    [[nodiscard]] tracking::StepEnd end(double speed, double multiple, bool with_slope) const {
        const double slope =
            with_slope ? sign * rate + turns - multiple : std::numeric_limits<double>::quiet_NaN();
        return {speed, distance(speed, multiple), slope, 1e-12 * speed};
    }
};

TEST(CrossingStep, AJumpHidesNoCrossing) {
    std::mt19937 random(5);
    const auto between = [&random](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    const auto odd = [&random] {
        return 2 * std::uniform_int_distribution<int>(-1, 3)(random) + 1;
    };
    const double from = 100;
    int past = 0;
    int crossings = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const double to = from + between(0.1, 3);
        // Standing in the rotor is on odd multiples, turning at the speed on even ones.
        const double nu = trial % 4 == 0   ? between(0, 6)
                          : trial % 4 == 1 ? from - between(0, 6)
                                           : between(0, from);
        const double rate = between(-2, 2);
        const Alias a{nu, rate, from, trial % 2 == 0 ? 1.0 : -1.0, static_cast<double>(odd())};
        const Alias b{nu, rate, from, trial % 3 == 0 ? 1.0 : -1.0, static_cast<double>(odd())};
        const double multiple = 1 + trial % 3;
        const bool crosses = a.distance(from, multiple) * a.distance(to, multiple) <= 0 ||
                             b.distance(from, multiple) * b.distance(to, multiple) <= 0;
        for (const bool with_slope : {true, false}) {
            const auto first = a.end(from, multiple, with_slope);
            const auto second = b.end(to, multiple, with_slope);
            const bool jump = tracking::jumps_past(first, second, multiple);
            EXPECT_FALSE(jump && crosses) << nu << ' ' << rate << ' ' << to - from;
            past += jump ? 1 : 0;
        }
        crossings += crosses ? 1 : 0;
    }
    EXPECT_GT(past, 20000); // with slopes or without, of 40000
    EXPECT_GT(crossings, 100);
}

TEST(CrossingStep, ARootAtAnEndHidesNoneInside) {
    expect_roots(
        roots_of([](double x) { return x * (x - 0.6); }, [](double x) { return 2 * x - 0.6; }),
        {0.6});
    EXPECT_TRUE(roots_of([](double x) { return x; }, [](double) { return 1; }).empty());
}

TEST(CrossingStep, UnknownSlopesLeaveTheSignsOfTheEnds) {
    const auto unknown = [](double) { return std::numeric_limits<double>::quiet_NaN(); };
    expect_roots(roots_of([](double x) { return x * x - 0.25; }, unknown), {0.5});
}

/// Every crossing is a root: at its speed some whirl mode has the multiple as its frequency.
void expect_verified(const model::Case &scene, const results::CampbellResult &result) {
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    for (const results::Crossing &crossing : result.crossings) {
        const modes::Spectrum at = solver.at(crossing.speed, 14);
        double nearest = std::numeric_limits<double>::infinity();
        for (const modes::WhirlMode &mode : at.modes)
            nearest = std::min(nearest, std::abs(mode.eigenvalue.imag() - crossing.frequency));
        EXPECT_LT(nearest, 1e-9 * crossing.frequency) << crossing.speed;
    }
}

std::vector<double> speeds_of(const results::CampbellResult &result) {
    std::vector<double> out;
    for (const results::Crossing &crossing : result.crossings)
        out.push_back(crossing.speed);
    return out;
}

/// Two discs on bearings whose planes differ seven- to fourteenfold.
model::Case split_planes(int count) {
    model::Case scene;
    scene.rotor = tests::uniform_shaft(1, 0.035793280623538516, 2);
    scene.rotor.shaft.segments[0].material = {"steel", 210e9, 210e9 / 2.6, 7850};
    scene.rotor.shaft.order = 6;
    scene.rotor.discs = {
        tests::disc(0.6, 27.76703802935437, 0.26290258356764457, 0.4704762063185328),
        tests::disc(0.46, 4.683438637046641, 0.3750796903462311, 0.32658177269081257)};
    scene.rotor.bearings = {tests::bearing(0, 11893058.726013776, 813469.1119331258),
                            tests::bearing(1, 87013236.67178066, 6070655.4618534995)};
    scene.speeds = model::SpeedRange{0, 3000, count};
    return scene;
}

TEST(Crossings, AreRootsNotJumpsOfALine) {
    // The crossing at 674.752 by spectral Timoshenko elements; six digits.
    std::vector<double> coarse;
    for (const int count : {9, 13, 60}) {
        const model::Case scene = split_planes(count);
        const results::CampbellResult result = analyses::campbell(scene);
        expect_verified(scene, result);
        const std::vector<double> found = speeds_of(result);
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](double speed) {
            return std::abs(speed - 674.752) < 5e-4;
        })) << count;
        if (coarse.empty())
            coarse = found;
        ASSERT_EQ(found.size(), coarse.size()) << count;
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], coarse[i], 1e-8 * coarse[i]) << count;
    }
}

/// A disc at midspan on bearings that stiffen twentyfold between 300 and 400 rad/s.
model::Case stiffening(int count) {
    model::Case scene;
    scene.rotor = tests::uniform_shaft(0.8, 0.1);
    scene.rotor.shaft.segments[0].material = {"steel", 210e9, 210e9 / 2.6, 7850};
    scene.rotor.shaft.order = 4;
    scene.rotor.discs = {tests::disc(0.4, 30, 0.3, 0.55)};
    for (const double z : {0.0, 0.8}) {
        model::Bearing bearing = tests::bearing(z, 1e6, 1e6);
        bearing.speeds = {0, 300, 400, 2000};
        bearing.rows.resize(4, bearing.rows[0]);
        bearing.rows[2].k *= 20;
        bearing.rows[3].k *= 20;
        scene.rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, 900, count};
    scene.campbell.modes = 4;
    return scene;
}

TEST(Crossings, ThroughBearingTablesAreTheSameOnEveryGrid) {
    // By an independent program: spectral elements, counted between the rows of the table.
    const std::vector<double> expected{157.8, 157.8, 298.8, 300.0, 316.8, 316.8, 632.4, 632.7};
    std::vector<double> finest;
    for (const int count : {91, 11, 4, 2}) {
        const model::Case scene = stiffening(count);
        const results::CampbellResult result = analyses::campbell(scene);
        expect_verified(scene, result);
        const std::vector<double> found = speeds_of(result);
        ASSERT_EQ(found.size(), expected.size()) << count;
        if (finest.empty())
            finest = found;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], expected[i], 0.05) << count; // as many digits as were printed
            EXPECT_NEAR(found[i], finest[i], 1e-8 * finest[i]) << count;
        }
    }
}

/// Eight stages on tables: a heavily damped line crosses 1x up and down within a step of three
/// speeds.
TEST(Crossings, OfFewSpeedsAreThoseOfMany) {
    std::vector<double> many;
    std::vector<std::string> names;
    for (const int count : {11, 3}) {
        const model::Case scene = input::load_case(WHIRL_ROOT "/cases/compressor_margins",
                                                   {"speeds.count=" + std::to_string(count)});
        const results::CampbellResult result = analyses::campbell(scene);
        const std::vector<double> found = speeds_of(result);
        std::vector<std::string> labels;
        for (const results::Crossing &crossing : result.crossings)
            labels.push_back(result.modes.at(static_cast<std::size_t>(crossing.mode)).label);
        if (many.empty()) {
            many = found;
            names = labels;
        }
        ASSERT_EQ(found.size(), many.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], many[i], 1e-8 * many[i]);
        EXPECT_EQ(labels, names);
    }
    EXPECT_GT(many.size(), 4U);
}

TEST(Crossings, AtASpeedOfTheGridAreFoundOnce) {
    const model::Case scene = stiffening(2);
    const double root = analyses::campbell(scene).crossings.back().speed;
    for (const double to : {2 * root, 4 * root}) {
        model::Case through = scene;
        through.speeds = model::SpeedRange{0, to, 5};
        const std::vector<double> found = speeds_of(analyses::campbell(through));
        EXPECT_EQ(std::count_if(found.begin(), found.end(),
                                [&](double speed) { return std::abs(speed - root) < 1e-6; }),
                  1)
            << to;
    }
}

/// Motions that stand still in the rotor at a speed.
std::ptrdiff_t standing(const modes::SpectrumSolver &solver, double speed) {
    const std::vector<modes::WhirlMode> modes = solver.at(speed, 10).modes;
    return std::count_if(modes.begin(), modes.end(),
                         [](const modes::WhirlMode &mode) { return mode.frequency_rotating == 0; });
}

TEST(Crossings, OfMotionsThatTurnWithTheRotorAreTheEndsOfTheirBands) {
    // Balls make damped motions stand still over most of the range: at every grid speed one does.
    std::vector<double> coarse;
    for (const int count : {3, 8, 36}) {
        model::Case scene = input::load_case(WHIRL_ROOT "/cases/extractor_two_plane");
        scene.speeds = model::SpeedRange{50, 400, count};
        scene.campbell.modes = 4;
        const results::CampbellResult result = analyses::campbell(scene);
        const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                           result.model.order);
        std::size_t ends = 0;
        for (const results::Crossing &crossing : result.crossings) {
            const double s = crossing.speed;
            if (standing(solver, s * (1 - 1e-7)) != standing(solver, s * (1 + 1e-7))) {
                ++ends;
                continue;
            }
            // Else a whirl against the spin: turns at twice the speed as seen from the rotor.
            const std::vector<modes::WhirlMode> modes = solver.at(s, 10).modes;
            EXPECT_TRUE(std::any_of(modes.begin(), modes.end(), [s](const auto &mode) {
                return std::abs(mode.frequency_rotating - 2 * s) < 1e-8 * s;
            })) << s;
        }
        EXPECT_GE(ends, 6U) << "the number changes from 2 to 3 and back three times";
        const std::vector<double> found = speeds_of(result);
        if (coarse.empty())
            coarse = found;
        ASSERT_EQ(found.size(), coarse.size()) << count;
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], coarse[i], 1e-8 * coarse[i]) << count;
    }
}

TEST(Crossings, OfAnAsymmetricRotorAreItsTwoCriticalSpeeds) {
    // Tilt of a rigid rotor about its centre: p / sqrt(1 - C +- a), p^2 = 2 k l^2 / Id, C = Ip/Id,
    // a = dI/Id (Gorbenko); bounce and backward tilt cross below
    // the range, at sqrt(2 k / m) = 71 and some 157 rad/s.
    model::Case scene;
    scene.rotor = tests::uniform_shaft(1, 0.02);
    scene.rotor.shaft.segments[0].material = {"weightless", 2e11, 7.7e10, 1e-12};
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc(0.5, 40, 0.8, 0.5)};
    scene.rotor.bearings = {tests::bearing(0.1, 1e5, 1e5), tests::bearing(0.9, 1e5, 1e5)};
    scene.campbell.modes = 4;
    const double p = std::sqrt(2 * 1e5 * 0.16 / 0.8);
    const double a = 0.1;
    scene.rotor.anisotropies = {{"", 0.5, a * 0.8, 0.3}};
    for (const int count : {2, 11, 41}) {
        scene.speeds = model::SpeedRange{200, 600, count};
        const std::vector<double> found = speeds_of(analyses::campbell(scene));
        ASSERT_EQ(found.size(), 2U) << count;
        EXPECT_NEAR(found[0], p / std::sqrt(1 - 0.5 / 0.8 + a), 1e-9 * p);
        EXPECT_NEAR(found[1], p / std::sqrt(1 - 0.5 / 0.8 - a), 1e-9 * p);
    }
}

// Supports 1e12 times softer than the shaft: rounding of its stiffness moves the slow frequencies
// by some 1e-4 of their square, so that between two speeds close to a crossing the distance from 1x
// is rounding. Each crossing is listed once: those of the rigid rotor.
TEST(Crossings, OnSupportsFarSofterThanTheShaftOnceEach) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    scene.rotor.shaft.order = 6;
    scene.rotor.shaft.segments[0].elements = 2;
    scene.rotor.discs = {tests::disc_at(0.5, 20, 0.15, 0.28)};
    constexpr double k = 1e-3;
    scene.rotor.bearings = {tests::isotropic_bearing(0, k, 1e-8),
                            tests::isotropic_bearing(1, k, 1e-8)};
    scene.speeds = model::SpeedRange{0, 1500, 11};
    const double mass = 7800 * std::numbers::pi / 4 * 0.05 * 0.05;
    const double Id = 0.15 + mass * (1 / 12.0 + 0.05 * 0.05 / 16);
    const double Ip = 0.28 + mass * 0.05 * 0.05 / 8;
    const double across = std::sqrt(2 * k / (20 + mass));
    const std::vector<double> expected{across, across, std::sqrt(k / 2 / (Id + Ip)),
                                       std::sqrt(k / 2 / (Id - Ip))};
    std::vector<double> found;
    for (const results::Crossing &crossing : analyses::campbell(scene).crossings)
        if (crossing.speed < 1)
            found.push_back(crossing.speed);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(found[i] / expected[i], 1, 1e-4);
}

} // namespace

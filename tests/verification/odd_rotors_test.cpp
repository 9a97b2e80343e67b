// Rotors that few people build, against transfer matrices of the continuum (38 digits, complex
// frequencies), solved apart from this project's code.

#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "input/case_file.h"
#include "results/campbell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace whirl;

const model::Material steel{"steel", 2.1e11, 2.1e11 / 2.6, 7850};

model::Segment tube(double length, double outer, double inner) {
    return {length, outer, outer, inner, inner, steel, 1};
}

model::Disc disc(double z, double mass, double Id, double Ip) { return {"", z, mass, Id, Ip}; }

model::Bearing bearing(double z, double kx, double ky, double c) {
    model::BearingCoefficients at;
    at.k << kx, 0, 0, ky;
    at.c << c, 0, 0, c;
    model::Bearing of;
    of.z = z;
    of.rows = {at};
    return of;
}

model::Case scene_of(const model::Rotor &rotor, double from, double to, int count) {
    model::Case scene;
    scene.rotor = rotor;
    scene.rotor.shaft.order = 5;
    scene.speeds = model::SpeedRange{from, to, count};
    scene.campbell.modes = 8;
    return scene;
}

/// Within the error bar and half a unit of the last digit given.
void expect_within_bar(double found, double error, double truth, double digit) {
    EXPECT_LE(std::abs(found - truth), error + digit) << truth;
    EXPECT_LT(error, 1e-5 * truth); // a bar that says something
}

/// Held by one damped bearing that lets it tilt: the damper stands in the node of the free motion.
TEST(OddRotors, OneDampedBearingLeavesTheTiltFree) {
    model::Rotor rotor;
    rotor.shaft.segments = {tube(0.5368, 0.1366, 0.05101), tube(0.2515, 0.0207, 0.01684),
                            tube(0.3523, 0.0562, 0), tube(0.5945, 0.092, 0.07455)};
    rotor.discs = {disc(0.89080034, 1.491, 0.008011, 0.00028599),
                   disc(0.10514706, 52.54, 2.0995, 4.194801)};
    rotor.bearings = {bearing(1.7351, 2.09e8, 2.09e8, 12372.8)};
    const auto found = analyses::critical_speeds(scene_of(rotor, 5, 1500, 31)).critical_speeds;
    const std::vector<std::pair<double, double>> truth{{29.9616274, 5e-8}, {86.9506788, 5e-8},
                                                       {370.814927, 5e-7}, {1412.13730, 5e-6},
                                                       {2015.05329, 5e-6}, {2073.88348, 5e-6}};
    ASSERT_GE(found.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        expect_within_bar(found[i].speed, found[i].error * found[i].speed, truth[i].first,
                          truth[i].second);
}

/// A bearing that pushes away in one direction, more than the shaft can hold: undamped, but no
/// symmetric definite problem.
TEST(OddRotors, ABearingThatPushesAwayDiverges) {
    model::Rotor rotor;
    rotor.shaft.segments = {tube(0.4, 0.05, 0), tube(0.3, 0.08, 0.03), tube(0.5, 0.045, 0)};
    rotor.discs = {disc(0.6, 30, 0.3, 0.5)};
    rotor.bearings = {bearing(0, 2e6, 2e6, 0), bearing(0.8, -6e6, 1e5, 0),
                      bearing(1.2, 3e6, 3e6, 0)};
    const results::CampbellResult result = analyses::campbell(scene_of(rotor, 10, 20, 2));
    ASSERT_TRUE(result.divergence.at(0));
    EXPECT_NEAR(*result.divergence[0], 377.96832, 5e-6);
    std::vector<double> frequencies;
    for (const results::CampbellMode &mode : result.modes)
        if (mode.frequency[0])
            frequencies.push_back(*mode.frequency[0]);
    std::sort(frequencies.begin(), frequencies.end());
    const std::vector<double> truth{195.50365, 628.80159, 724.89548};
    for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_NEAR(frequencies.at(i), truth[i], 1e-5); // the digits given and the elements
}

/// A stiff shaft on soft bearings: the end of the band is known to 1e-10 of its speed only, by
/// rounding of the stiffness, and the error says so.
TEST(OddRotors, BalanceEndsCarryTheirRounding) {
    model::Rotor rotor;
    rotor.shaft.segments = {tube(0.2882, 0.0865, 0.02268), tube(0.372, 0.1242, 0),
                            tube(0.4945, 0.1373, 0)};
    rotor.discs = {disc(0.79027668, 73.82, 1.2437, 2.2836), disc(0, 59.84, 2.6314, 2.6314),
                   disc(0.66256686, 2.953, 0.024132, 0.024132)};
    rotor.bearings = {bearing(0, 737800, 737800, 21410.956),
                      bearing(0.56972898, 481900, 481900, 0)};
    rotor.planes = {{"", 0.99858456}};
    const results::BalanceResult result = analyses::balance(scene_of(rotor, 5, 500, 31));
    const results::BalanceBands &bands = result.planes.at(0).bands;
    ASSERT_EQ(bands.bands.size(), 1U);
    ASSERT_TRUE(bands.errors.at(0).first);
    const double error = *bands.errors[0].first;
    EXPECT_LE(std::abs(bands.bands[0].from - 38.395400195803), error);
    EXPECT_LT(error, 1e-8 * bands.bands[0].from);
}

/// Modes on cross-coupled bearings are not orthogonal and look like each other at rest; their
/// errors are those of the elements all the same.
TEST(OddRotors, CoupledBearingsBlurNoErrorBar) {
    model::Case scene =
        input::load_case(std::string(WHIRL_ROOT) + "/cases/overhung_cross_coupled", {});
    scene.speeds = model::SpeedRange{0, 0, 1};
    for (const results::CampbellMode &mode : analyses::campbell(scene).modes) {
        ASSERT_TRUE(mode.error[0]);
        EXPECT_LT(*mode.error[0], 1e-8) << mode.label;
    }
}

} // namespace

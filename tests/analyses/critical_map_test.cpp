// The critical speed map against the critical speeds of rotors on such supports, against closed
// forms of the beam at both ends, and its crossings against the rotor on its own bearings.

#include "analyses/critical_map/critical_map.h"

#include "analyses/critical.h"
#include "closed_form/beam_frequencies.h"
#include "model/errors.h"
#include "oracles/continuum_roots.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace whirl;
using results::CriticalMap;
using results::CriticalMapCrossing;
using results::Whirl;
using tests::scene_of;

constexpr double agreed = 1e-9; ///< of the contract; rounding is some 1e-12

CriticalMap map_of(const model::Case &scene) {
    results::ModelSummary summary;
    return analyses::critical_map(scene, summary);
}

std::vector<double> critical_of_sense(const model::Case &scene, Whirl whirl) {
    std::vector<double> speeds;
    for (const auto &critical : analyses::critical_speeds(scene).critical_speeds)
        if (critical.whirl == whirl)
            speeds.push_back(critical.speed);
    return speeds;
}

void set_stiffness(model::Bearing &bearing, double k) {
    model::BearingCoefficients row;
    row.k = k * Eigen::Matrix2d::Identity();
    bearing.rows = {row};
    bearing.speeds.clear();
}

/// Two discs on bearings that differ, with damping and cross coupling, and a seal.
model::Case two_discs() {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 2e6, 1e5, 100), 0, 500, 3);
    scene.rotor.bearings[1] = tests::bearing(1.5, 3e6, 3e6, 0, 50);
    model::Bearing seal = tests::round_bearing(0.75, 2e5, 30);
    seal.seal = true;
    scene.rotor.bearings.push_back(seal);
    scene.campbell.modes = 6;
    scene.critical_map = model::CriticalMapSettings{1e5, 1e9, 5, {}};
    return scene;
}

/// The curves of a map against critical speeds of the rotor that `with` makes of a stiffness.
void expect_is_critical(const CriticalMap &map, const std::function<model::Case(double k)> &with) {
    ASSERT_FALSE(map.curves.empty());
    for (std::size_t i = 0; i < map.stiffness.size(); ++i) {
        const model::Case scene = with(map.stiffness[i]);
        for (const auto &curve : map.curves) {
            const auto speeds = critical_of_sense(scene, curve.whirl);
            ASSERT_GE(speeds.size(), static_cast<std::size_t>(curve.number));
            const double expected = speeds[static_cast<std::size_t>(curve.number - 1)];
            EXPECT_NEAR(curve.speed[i], expected, agreed * expected)
                << map.stiffness[i] << " " << results::whirl_name(curve.whirl) << curve.number;
        }
    }
}

TEST(CriticalMap, IsTheCriticalSpeedsOfTheRotorOnSuchSupports) {
    const model::Case scene = two_discs();
    const CriticalMap map = map_of(scene);
    ASSERT_EQ(map.curves.size(), 6U);
    expect_is_critical(map, [&](double k) {
        model::Case at = scene;
        at.campbell.modes = 12;
        set_stiffness(at.rotor.bearings[0], k);
        set_stiffness(at.rotor.bearings[1], k);
        set_stiffness(at.rotor.bearings[2], 2e5); // the seal without its damping
        return at;
    });
}

TEST(CriticalMap, OfOneBearingKeepsTheOtherWithTheMeanOfItsDirections) {
    model::Case scene = two_discs();
    scene.critical_map->bearing = 1;
    expect_is_critical(map_of(scene), [&](double k) {
        model::Case at = scene;
        at.campbell.modes = 12;
        set_stiffness(at.rotor.bearings[0], 1.5e6);
        set_stiffness(at.rotor.bearings[1], k);
        set_stiffness(at.rotor.bearings[2], 2e5);
        return at;
    });
}

TEST(CriticalMap, OfAnAsymmetricRotorHasACurveForEachDirection) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6), 0, 500, 3);
    scene.rotor.anisotropies.push_back({"", 1.0, 0.05, 0});
    scene.campbell.modes = 4;
    scene.critical_map = model::CriticalMapSettings{1e5, 1e9, 4, {}};
    const CriticalMap map = map_of(scene);
    for (const auto &curve : map.curves)
        EXPECT_EQ(curve.whirl, Whirl::forward);
    expect_is_critical(map, [&](double k) {
        model::Case at = scene;
        at.campbell.modes = 12;
        set_stiffness(at.rotor.bearings[0], k);
        set_stiffness(at.rotor.bearings[1], k);
        return at;
    });
}

// A uniform steel shaft on a bearing at each end, and the closed forms of the same.
constexpr double length = 1.2;
constexpr double diameter = 0.06;

model::Case uniform_scene(double from, double to) {
    model::Case scene = scene_of(tests::uniform_shaft(length, diameter, 4), 0, 500, 3);
    scene.rotor.bearings = {tests::round_bearing(0, 1e6), tests::round_bearing(length, 1e6)};
    scene.rotor.shaft.order = 10;
    scene.campbell.modes = 8;
    scene.critical_map = model::CriticalMapSettings{from, to, 2, {}};
    return scene;
}

closed_form::UniformShaft uniform_closed_form() {
    const model::Material steel = tests::friswell_steel();
    closed_form::UniformShaft shaft =
        closed_form::circular_shaft(length, diameter / 2, 0, steel.E, steel.rho);
    const double nu = steel.E / (2 * steel.G) - 1;
    shaft.shear_modulus = steel.G;
    shaft.shear_coefficient = 6 * (1 + nu) / (7 + 6 * nu); // Cowper 1966, solid circle
    return shaft;
}

/// Where the pinned shaft whirls at its own spin speed (sign: +1 forward, -1 backward).
double pinned_critical(const closed_form::UniformShaft &shaft, int mode, int sign) {
    double low = 0;
    double high = 1e6;
    while (high - low > 1e-14 * high) {
        const double middle = (low + high) / 2;
        const auto whirl = closed_form::timoshenko_whirl(shaft, mode, middle);
        (sign * whirl[sign > 0 ? 2 : 1] > middle ? low : high) = middle;
    }
    return low;
}

/// A shape of unit amplitude with end deflections of size w and mean square s over a beam of mass m
/// gives way to springs K at both ends by 2 K w^2 / (2 W^2 m s) of its speed W to first order;
/// pinned ends that give way under forces F lower it by 2 F^2 / K / (2 W^2 m s). That is for a beam
/// without shear and inertia of its sections, r their radius: E/(kappa G) = 2.9 times (n pi r/L)^2
/// of the former, once that and twice the gyroscopic moment for the latter, and as much again of
/// F^2: 10 times it in all.
double of_the_shift(int n) {
    const double n_pi_r = n * std::numbers::pi * diameter / 4 / length;
    return 10 * n_pi_r * n_pi_r;
}

TEST(CriticalMap, StiffEndIsThePinnedTimoshenkoShaft) {
    const closed_form::UniformShaft shaft = uniform_closed_form();
    const double k = 1e13;
    const CriticalMap map = map_of(uniform_scene(1e9, k));
    for (const auto &curve : map.curves) {
        if (curve.number > 3)
            continue;
        const double n_pi = curve.number * std::numbers::pi;
        const double exact =
            pinned_critical(shaft, curve.number, curve.whirl == Whirl::forward ? 1 : -1);
        // F = EI (n pi/L)^3, W^2 m s = EI (n pi/L)^4 L/2.
        const double shift = 2 * shaft.young_modulus * shaft.second_moment * n_pi * n_pi /
                             (k * length * length * length);
        EXPECT_NEAR((exact - curve.speed.back()) / exact, shift,
                    of_the_shift(curve.number) * shift + 1e-9)
            << results::whirl_name(curve.whirl) << curve.number;
        EXPECT_LT(shift, 1e-4);
    }
}

TEST(CriticalMap, SoftEndIsTheFreeTimoshenkoShaftAndTheRigidBody) {
    const closed_form::UniformShaft shaft = uniform_closed_form();
    const double k = 100;
    const CriticalMap map = map_of(uniform_scene(k, 1e9));
    const double mass = shaft.density * shaft.area * length;
    const double r2 = diameter * diameter / 16; // of a section about a diameter, squared
    // A shaft that bends softens the supports by about their share of its stiffness.
    const double bends = k * std::pow(length, 3) / (48 * shaft.young_modulus * shaft.second_moment);
    for (const auto &curve : map.curves) {
        const int sign = curve.whirl == Whirl::forward ? 1 : -1;
        const double speed = curve.speed.front();
        if (curve.number == 1) { // the body moves along itself: 2 k = m W^2
            EXPECT_NEAR(speed, std::sqrt(2 * k / mass), bends * speed);
        } else if (curve.number == 2) { // it tilts: 2 k (L/2)^2 = (Id -+ Ip) W^2, Ip = 2 m r^2
            const double Id = mass * (length * length / 12 + r2);
            EXPECT_NEAR(speed, std::sqrt(k * length * length / 2 / (Id - sign * 2 * mass * r2)),
                        bends * speed);
        } else {
            oracles::SteppedRotor free;
            free.shaft = {{length, diameter, 0, shaft.young_modulus, shaft.shear_modulus,
                           shaft.density, shaft.shear_coefficient}};
            free.supports.resize(2); // of minute stiffness, so that it can be counted
            free.supports[1].z = length;
            for (auto &support : free.supports)
                support.k = {{{1e-6, 0}, {0, 1e-6}}};
            const auto exact = oracles::frequencies(
                oracles::Continuum(free),
                {sign > 0 ? oracles::Motion::forward : oracles::Motion::backward, 0, true},
                curve.number, 1e5L);
            ASSERT_EQ(exact.size(), static_cast<std::size_t>(curve.number));
            const auto W = static_cast<double>(exact.back());
            const double shift =
                4 * k / (W * W * mass); // a free end moves twice the root mean square
            EXPECT_NEAR((speed - W) / W, shift, of_the_shift(curve.number) * shift + 1e-9)
                << results::whirl_name(curve.whirl) << curve.number;
            EXPECT_LT(shift, 1e-4);
        }
    }
}

/// Bearings whose stiffness rises, falls and rises again, alike in x and y.
model::Bearing wavy_bearing(double z) {
    model::Bearing bearing;
    bearing.z = z;
    for (const auto &[speed, k] : std::vector<std::pair<double, double>>{
             {0, 2e5}, {60, 3e6}, {110, 4e5}, {400, 2e7}, {900, 5e7}}) {
        bearing.speeds.push_back(speed);
        bearing.rows.push_back(tests::round_bearing(z, k, 100).rows.front());
    }
    return bearing;
}

/// The crossings of isotropic bearings against the critical speeds of the rotor without damping, up
/// to a speed below the highest curves of the map.
void expect_crossings_are_critical(const CriticalMap &map, const model::Case &undamped) {
    constexpr double top = 1500;
    std::vector<double> crossings;
    for (const CriticalMapCrossing &at : map.crossings) {
        EXPECT_EQ(at.of, "k");
        if (at.speed < top)
            crossings.push_back(at.speed);
    }
    std::sort(crossings.begin(), crossings.end());
    std::vector<double> critical;
    for (const auto &at : analyses::critical_speeds(undamped).critical_speeds)
        if (at.speed < top)
            critical.push_back(at.speed);
    ASSERT_GE(crossings.size(), 5U);
    ASSERT_EQ(crossings.size(), critical.size());
    for (std::size_t i = 0; i < critical.size(); ++i)
        EXPECT_NEAR(crossings[i], critical[i], agreed * critical[i]);
}

TEST(CriticalMap, CrossingsOfEqualBearingsAreTheCriticalSpeedsOfTheRotor) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6), 0, 900, 3);
    scene.rotor.bearings = {wavy_bearing(0), wavy_bearing(1.5)};
    scene.campbell.modes = 12;
    scene.critical_map = model::CriticalMapSettings{1e3, 1e11, 9, {}};
    const CriticalMap map = map_of(scene);
    EXPECT_EQ(map.bearings.size(), 1U);
    model::Case undamped = scene;
    for (auto &bearing : undamped.rotor.bearings)
        for (auto &row : bearing.rows)
            row.c.setZero();
    expect_crossings_are_critical(map, undamped);
    for (const CriticalMapCrossing &at : map.crossings) {
        EXPECT_NEAR(at.stiffness, scene.rotor.bearings[0].at(at.speed).k(0, 0),
                    1e-12 * at.stiffness);
        // By the other way: the rotor on that stiffness at every speed.
        model::Case there = undamped;
        there.campbell.modes = 24;
        set_stiffness(there.rotor.bearings[0], at.stiffness);
        set_stiffness(there.rotor.bearings[1], at.stiffness);
        const auto speeds = critical_of_sense(there, at.whirl);
        ASSERT_GE(speeds.size(), static_cast<std::size_t>(at.number));
        EXPECT_NEAR(speeds[static_cast<std::size_t>(at.number - 1)], at.speed, agreed * at.speed);
    }
}

TEST(CriticalMap, CrossingsOfOneBearingAreTheCriticalSpeedsOfTheRotor) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 1e6), 0, 900, 3);
    scene.rotor.bearings[1] = wavy_bearing(1.5);
    for (auto &row : scene.rotor.bearings[1].rows)
        row.c.setZero();
    scene.campbell.modes = 12;
    scene.critical_map = model::CriticalMapSettings{1e3, 1e11, 9, 1};
    const CriticalMap map = map_of(scene);
    ASSERT_EQ(map.bearings.size(), 1U);
    EXPECT_EQ(map.bearings[0].bearings, std::vector<std::size_t>{1});
    expect_crossings_are_critical(map, scene);
}

TEST(CriticalMap, BearingsThatDifferInTheirDirectionsCrossTwice) {
    model::Case scene = scene_of(tests::two_disc_rotor(1e6, 4e6), 0, 900, 3);
    scene.campbell.modes = 4;
    const CriticalMap map = map_of(scene);
    ASSERT_EQ(map.bearings.size(), 1U);
    EXPECT_FALSE(map.bearings[0].isotropic);
    for (const char *of : {"kxx", "kyy"}) {
        const double k = of[1] == 'x' ? 1e6 : 4e6;
        for (const Whirl whirl : {Whirl::forward, Whirl::backward}) {
            const auto first = std::find_if(
                map.crossings.begin(), map.crossings.end(), [&](const CriticalMapCrossing &at) {
                    return at.of == of && at.whirl == whirl && at.number == 1;
                });
            ASSERT_NE(first, map.crossings.end());
            EXPECT_EQ(first->stiffness, k);
        }
    }
}

/// Pedestals softer in one direction than in the other are on the map with the mean of both: said.
TEST(CriticalMap, OfPedestalsWithTwoStiffnessesSaysThatTheyAreAveraged) {
    model::Case scene = two_discs();
    scene.rotor.bearings.pop_back(); // no seal: nothing else is averaged
    scene.rotor.bearings[0] = tests::round_bearing(0, 1e6, 0);
    scene.rotor.bearings[1] = tests::round_bearing(1.5, 1e6, 0);
    const auto notes_with = [&](double kx, double ky) {
        for (model::Bearing &bearing : scene.rotor.bearings) {
            model::Pedestal &pedestal = bearing.pedestal.emplace();
            pedestal.mass = {5, 5};
            pedestal.k = {kx, ky};
            pedestal.c = {0, 0};
        }
        results::ModelSummary summary;
        (void)analyses::critical_map(scene, summary);
        std::string all;
        for (const results::Sentence &note : summary.notes)
            all += note.text() + "\n";
        return all;
    };
    const std::string words = "pedestals, and supports that do not vary, have the mean of their x "
                              "and y coefficients";
    EXPECT_NE(notes_with(1e7, 4e7).find(words), std::string::npos);
    EXPECT_EQ(notes_with(2e7, 2e7).find("the mean of"), std::string::npos);
}

TEST(CriticalMap, WantsABearing) {
    model::Case scene = scene_of(tests::uniform_shaft(1, 0.05), 0, 500, 3);
    EXPECT_THROW((void)map_of(scene), model::BadInput);
}

} // namespace

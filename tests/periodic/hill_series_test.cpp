// The monodromy matrix against Hill's series, which shares nothing with it but the matrices of the
// rotor: all motions of random rotors, and the answers of `stability` by both routes.

#include "analyses/stability.h"
#include "balancers/arrangement.h"
#include "ends/band_ends.h"
#include "model/errors.h"
#include "stability/hill/hill_solver.h"
#include "stability/hill/periodic_motions.h"
#include "stability/unstable_bands.h"
#include "support/balancer_scenes.h"
#include "support/looked_at.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace whirl;

/// Discs with anisotropies on a damped shaft, bearings that differ between their directions; some
/// with two balls.
model::Rotor random_rotor(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, uniform(0.03, 0.06), tests::steel());
    rotor.shaft.rigid = seed % 3 == 0;
    rotor.shaft.order = seed % 3 == 1 ? 4 : 6;
    const int discs = 1 + static_cast<int>(seed % 2);
    for (int i = 0; i < discs; ++i) {
        const double Id = uniform(0.1, 0.4);
        const double z = (i + uniform(0.2, 0.8)) / discs;
        const double Ip = uniform(0.5, 1.6) * Id;
        rotor.discs.push_back(tests::disc_at(z, uniform(5, 30), Id, Ip));
        rotor.anisotropies.push_back(
            {"", z, uniform(0.05, 0.4) * std::min(Id, Ip / 2), uniform(0, 3.1)});
    }
    for (const double z : {0.0, 1.0}) {
        const double k = std::exp(uniform(13, 15));
        rotor.bearings.push_back(
            tests::bearing(z, k, k * uniform(0.4, 1.6), 0.05 * k * uniform(-1, 1), 1e-4 * k));
        rotor.bearings.back().rows[0].c(1, 1) *= uniform(0.5, 2);
    }
    if (seed % 4 == 1) {
        const double mass = 0.05;
        const double radius = 0.1;
        rotor.balancers.push_back(
            tests::ball_balancer(rotor.discs[0].z, 2, mass, radius, 2 * mass, 1.2 * mass * radius));
    }
    return rotor;
}

balancers::Arrangement balls(const model::Rotor &rotor) {
    return balancers::arrangement_at_balance(rotor);
}

/// Distance to the nearest of the motions, copies 2 i speed apart being one.
double off(const stability::Motion &motion, const std::vector<stability::Motion> &others,
           double speed) {
    double nearest = 1e300;
    for (const stability::Motion &other : others) {
        const auto difference = motion.value - other.value;
        nearest = std::min(
            nearest, std::hypot(difference.real(), std::remainder(difference.imag(), 2 * speed)));
    }
    return nearest;
}

class RandomRotor : public testing::TestWithParam<unsigned> {};

// Hill's series settles to 1e-8 of the speed.
TEST_P(RandomRotor, MotionsAreThoseOfHillsSeries) {
    const model::Rotor rotor = random_rotor(GetParam());
    const stability::HillSolver hill(
        tests::looked_at(rotor, results::Form::hill, rotor.shaft.order, 1), balls(rotor));
    const stability::HillSolver monodromy(
        tests::looked_at(rotor, results::Form::hill, rotor.shaft.order, 0, 700), balls(rotor));
    const std::vector<double> speeds{190, 333, 640};
    (void)monodromy.by_monodromy()->good_shapes(speeds); // as a search for bands begins
    int compared = 0;
    for (const double speed : speeds) {
        std::vector<stability::Motion> series;
        try {
            series = hill.at(speed);
        } catch (const model::AnalysisFailure &) { // it does not settle: nothing to compare with
            continue;
        }
        const auto found = monodromy.at(speed);
        // Which of those that die out are listed is not the same in both.
        const double growth = stability::growth_of(series);
        if (growth > 0 || stability::growth_of(found) > 0) {
            EXPECT_NEAR(stability::growth_of(found), growth, 1e-8 * speed) << speed;
        }
        for (const stability::Motion &motion : found)
            // The reduced rotor's motions but those that grow most: 1e-7 of the speed. Both routes
            // list the motions up to four times the speed, and some more.
            if (motion.may_meet) {
                EXPECT_LT(off(motion, series, speed), 2e-7 * speed + motion.noise) << speed;
            }
        ++compared;
    }
    EXPECT_GE(compared, 2);
}

INSTANTIATE_TEST_SUITE_P(Rotors, RandomRotor, testing::Range(0U, 9U));

/// A disc with unequal inertias on an elastic shaft.
model::Rotor flexible_rotor(double c) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    rotor.shaft.order = 6;
    rotor.discs = {tests::disc_at(0.4, 20, 0.3, 0.2)};
    rotor.anisotropies = {{"", 0.4, 0.05, 0}};
    rotor.bearings = {tests::bearing(0, 4e6, 6e6, 0, c), tests::bearing(1, 4e6, 6e6, 0, c)};
    return rotor;
}

// Each end is one of Hill's series with all unknowns: growth on one side alone. The series settles
// to 1e-8 of the speed, the growth rises by about as much as the speed.
TEST(HillSeries, EndsOfBandsAreItsOwn) {
    const model::Rotor rotor = flexible_rotor(60);
    const auto bands =
        analyses::unstable_bands_of(tests::scene_of(rotor, 680, 720, 11), {}, false).bands;
    ASSERT_EQ(bands.size(), 1U);
    const stability::HillSolver series(
        tests::looked_at(rotor, results::Form::hill, rotor.shaft.order, 1), {});
    const auto grows = [&series](double speed) {
        return stability::growth_of(series.at(speed)) > 0;
    };
    const double beside = 1e-7 * bands[0].from;
    EXPECT_FALSE(grows(bands[0].from - beside));
    EXPECT_TRUE(grows(bands[0].from + beside));
    EXPECT_TRUE(grows(bands[0].to - beside));
    EXPECT_FALSE(grows(bands[0].to + beside));
}

// Without damping: 0.27 rad/s wide.
TEST(HillSeries, NarrowBandOfAnElasticRotorIsTheSameOnEveryGrid) {
    std::vector<results::Interval> found;
    for (const int count : {11, 501}) {
        const model::Case scene = tests::scene_of(flexible_rotor(0), 692, 700, count);
        const auto bands = analyses::unstable_bands_of(scene, {}, false).bands;
        ASSERT_EQ(bands.size(), 1U);
        found.push_back(bands[0]);
    }
    EXPECT_NEAR(found[0].from, found[1].from, 1e-8 * found[0].from);
    EXPECT_NEAR(found[0].to, found[1].to, 1e-8 * found[0].to);
}

// Seven bands, one of them 0.23 rad/s wide, from grids of 251 and of 97 speeds. On either side of
// each end Hill's series with all unknowns says the same: it settles to 1e-8 of the speed, while
// the growth rises by a hundredth of the way from the end or more.
TEST(HillSeries, NarrowBandsOfADampedElasticRotorAreTheSameOnEveryGridAndItsOwn) {
    model::Rotor rotor = flexible_rotor(34.45);
    for (model::Segment &segment : rotor.shaft.segments)
        segment.material = {"steel", 2.11e11, 2.11e11 / 2.6, 7810};
    const auto bands_of = [&rotor](int count) {
        return analyses::unstable_bands_of(tests::scene_of(rotor, 50, 1300, count), {}, false)
            .bands;
    };
    const auto bands = bands_of(251);
    const auto again = bands_of(97);
    ASSERT_EQ(bands.size(), 7U);
    ASSERT_EQ(again.size(), bands.size());
    EXPECT_NEAR(bands[2].to - bands[2].from, 0.233, 0.001);
    const stability::HillSolver series(
        tests::looked_at(rotor, results::Form::hill, rotor.shaft.order, 1), {});
    const auto grows = [&series](double speed) {
        return stability::growth_of(series.at(speed)) > 0;
    };
    for (std::size_t i = 0; i < bands.size(); ++i)
        for (const bool first : {true, false}) {
            const double end = first ? bands[i].from : bands[i].to;
            EXPECT_NEAR(first ? again[i].from : again[i].to, end, 1e-8 * end);
            const double inward = (first ? 1e-5 : -1e-5) * end;
            EXPECT_TRUE(grows(end + inward)) << end;
            EXPECT_FALSE(grows(end - inward)) << end;
        }
}

// The band begins with the range: its end is the same as seen from both sides.
/// Beside each end of the seven bands the numbers of growing motions differ, wherever the ends of
/// the reduced rotor lie.
TEST(HillSeries, EveryBandOfADampedElasticRotorBeginsAndEndsWithItsCount) {
    model::Rotor rotor = flexible_rotor(34.45);
    for (model::Segment &segment : rotor.shaft.segments)
        segment.material = {"steel", 2.11e11, 2.11e11 / 2.6, 7810};
    const auto found = analyses::stability(tests::scene_of(rotor, 50, 1300, 251), {});
    EXPECT_EQ(found.unstable.size(), 7U);
    ASSERT_EQ(found.ends.size(), 2 * found.unstable.size());
    for (std::size_t i = 0; i < found.unstable.size(); ++i) {
        EXPECT_EQ(found.ends[2 * i].speed, found.unstable[i].from);
        EXPECT_EQ(found.ends[2 * i].growing_below, 0);
        EXPECT_EQ(found.ends[2 * i + 1].speed, found.unstable[i].to);
        EXPECT_EQ(found.ends[2 * i + 1].growing_above, 0);
    }
}

TEST(HillSeries, NarrowBandAtTheBorderOfTheRange) {
    const auto bands_from = [](double from) {
        return analyses::unstable_bands_of(tests::scene_of(flexible_rotor(0), from, 700, 11), {},
                                           false)
            .bands;
    };
    const auto whole = bands_from(692);
    ASSERT_EQ(whole.size(), 1U);
    const double middle = (whole[0].from + whole[0].to) / 2;
    const auto rest = bands_from(middle);
    ASSERT_EQ(rest.size(), 1U);
    EXPECT_EQ(rest[0].from, middle);
    EXPECT_NEAR(rest[0].to, whole[0].to, 1e-8 * middle);
}

// Without damping two motions collide on the unit circle, with damping one passes it.
TEST(HillSeries, KindsOfEnds) {
    for (const double c : {0.0, 60.0}) {
        const model::Rotor rotor = flexible_rotor(c);
        const stability::HillSolver solver(
            tests::looked_at(rotor, results::Form::hill, rotor.shaft.order, 0, 700), {});
        const auto at = [&solver](double speed) { return solver.at(speed); };
        const auto bands = stability::unstable_bands(at, {690, 695, 700});
        ASSERT_GE(bands.size(), 1U) << c;
        const auto [from, to] = bands.back();
        ASSERT_LT(to, 700) << c;
        const auto found = ends::multiplier_ends(at, {(from + to) / 2, to + 0.01}, {});
        ASSERT_EQ(found.ends.size(), 1U) << c;
        EXPECT_EQ(found.ends[0].kind,
                  c == 0 ? results::EndKind::collision : results::EndKind::multiplier);
        EXPECT_EQ(found.ends[0].growing_below, 2);
        EXPECT_EQ(found.ends[0].growing_above, 0);
    }
}

} // namespace

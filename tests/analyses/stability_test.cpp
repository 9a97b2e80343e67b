// Bands, signed ranges of speed and maps of `stability`, apart from the physics behind them.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/show.h"
#include "analyses/stability.h"
#include "analyses/stability_ends.h"
#include "model/errors.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "support/balancer_parts.h"
#include "support/balancer_scenes.h"
#include "support/rigid_rotors.h"
#include "support/scenes.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace whirl::analyses {
namespace {

/// A motion that stands for itself alone among three.
stability::Motion motion(double growth, double frequency, int place, double noise = 1e-12) {
    return {{growth, frequency}, Eigen::VectorXcd::Unit(3, place), noise, true};
}

// However many ranges there are, one note says where motions were lost.
TEST(LostMotions, AreOneNote) {
    std::vector<results::Sentence> notes;
    note_lost_motions({}, "the motions", notes);
    EXPECT_TRUE(notes.empty());
    note_lost_motions({{1, 2}, {5, 6}}, "the motions", notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_TRUE(notes[0].starts_with("from 1 to 2 rad/s, 5 to 6 rad/s the motions could not be"))
        << notes[0];
    std::vector<results::Interval> many;
    for (int i = 0; i < 20; ++i)
        many.push_back({10.0 * (20 - i), 10.0 * (20 - i) + 1});
    note_lost_motions(many, "the motions", notes);
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_TRUE(notes[1].starts_with("in 20 short ranges of speed from 10 to 201 rad/s the"))
        << notes[1];
}

// One motion grows below 1, another above 1.02: the window between them is far narrower than the
// grid.
TEST(UnstableBands, StableWindowBetweenTwoInstabilitiesIsFound) {
    const stability::MotionsAt at = [](double speed) {
        return std::vector<stability::Motion>{motion(1 - speed, 1, 0), motion(speed - 1.02, 2, 1),
                                              motion(-1, 3, 2)};
    };
    const auto bands = stability::unstable_bands(at, {0.0, 0.7, 1.4, 2.1});
    ASSERT_EQ(bands.size(), 2U);
    EXPECT_EQ(bands[0].from, 0);
    EXPECT_NEAR(bands[0].to, 1, 1e-10);
    EXPECT_NEAR(bands[1].from, 1.02, 1e-10);
    EXPECT_EQ(bands[1].to, 2.1);
}

// Two motions that grow and overlap leave no window.
TEST(UnstableBands, OverlappingInstabilitiesAreOneBand) {
    const stability::MotionsAt at = [](double speed) {
        return std::vector<stability::Motion>{motion(1.03 - speed, 1, 0), motion(speed - 1, 2, 1)};
    };
    const auto bands = stability::unstable_bands(at, {0.0, 0.7, 1.4, 2.1});
    ASSERT_EQ(bands.size(), 1U);
    EXPECT_EQ(bands[0], (results::Interval{0, 2.1}));
}

// Outside of all bands growth of 1e-9 of the highest speed is rounding; inside, or larger, it is
// not.
TEST(Growth, OfRoundingOutsideOfTheBandsIsNone) {
    using results::Verdict;
    for (const bool damped : {false, true}) {
        results::StabilityResult result;
        result.speeds = {0, 100, 200, 300, 400};
        result.growth = {2e-7, 3e-7, -2e-7, 1e-3, -1e-3};
        result.verdict = {Verdict::unstable, Verdict::diverges, Verdict::stable, Verdict::unstable,
                          Verdict::stable};
        result.unstable = {{90, 110}};
        settle_rounding({result.growth, result.verdict}, result.speeds, result.unstable, damped);
        EXPECT_EQ(result.growth, (std::vector<double>{0, 3e-7, damped ? -2e-7 : 0, 1e-3, -1e-3}));
        EXPECT_EQ(result.verdict, (std::vector<Verdict>{Verdict::neutral, Verdict::diverges,
                                                        damped ? Verdict::stable : Verdict::neutral,
                                                        Verdict::unstable, Verdict::stable}));
    }
}

// A zero root blurred by rounding is no growth, and hides none.
TEST(Growth, BlurredZeroDoesNotHideAMotionThatGrows) {
    EXPECT_EQ(
        stability::growth_of({motion(1e-3, 0, 0, 1e-2), motion(1e-4, 2, 1), motion(-1, 1, 2)}),
        1e-4);
    EXPECT_EQ(stability::growth_of({motion(1e-3, 0, 0, 1e-2), motion(-1, 1, 2)}), 0);
    EXPECT_EQ(stability::growth_of({motion(-0.5, 0, 0), motion(-1, 1, 2)}), -0.5);
}

// With damping a root is zero elsewhere than at the critical speeds, which have none by definition.
TEST(StandingSpeeds, CriticalOnesAreThoseOfCriticalAndZeroRootsEndTheBand) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    scene.speeds = model::SpeedRange{1, 6, 101};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c = 0.05 * Eigen::Matrix2d::Identity();
    const results::StabilityResult result = stability(scene, {});
    std::vector<double> critical;
    for (const results::CriticalSpeed &c : critical_speeds(scene).critical_speeds)
        if (c.speed > 1 && c.speed < 6)
            critical.push_back(c.speed);
    ASSERT_EQ(result.critical_speeds.size(), critical.size());
    for (std::size_t i = 0; i < critical.size(); ++i)
        EXPECT_NEAR(result.critical_speeds[i], critical[i], 1e-8 * critical[i]);
    ASSERT_FALSE(result.zero_root_speeds.empty());
    ASSERT_FALSE(result.unstable.empty());
    EXPECT_EQ(result.zero_root_speeds.front(), result.unstable.front().from);
    EXPECT_GT(std::abs(result.zero_root_speeds.front() - critical.front()), 1e-6);
}

// The rotor that spins the other way is the mirror image. Numbers: closed form of S1's rotor.
TEST(SignedSpeeds, NegativeRangeIsTheMirrorImage) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    scene.speeds = model::SpeedRange{-6, -1, 101};
    const auto result = stability(scene, {});
    ASSERT_EQ(result.unstable.size(), 1U);
    EXPECT_NEAR(result.unstable[0].from, -3.788366, 1e-6);
    EXPECT_NEAR(result.unstable[0].to, -2.381264, 1e-6);
    // A root is zero at both ends; the mass has its critical speed sqrt(0.15625) below the range.
    ASSERT_EQ(result.zero_root_speeds.size(), 2U);
    EXPECT_NEAR(result.zero_root_speeds[0], -3.788366, 1e-6);
    EXPECT_NEAR(result.zero_root_speeds[1], -2.381264, 1e-6);
    ASSERT_EQ(result.permissible.size(), 1U);
    EXPECT_NEAR(*result.permissible[0].dI, 0.055266, 1e-6);
    EXPECT_NEAR(*result.permissible[0].closed_form, 0.055266, 1e-6);
}

// Only what lies in the range is listed.
TEST(SignedSpeeds, CriticalSpeedsOutsideTheRangeAreNotListed) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    scene.speeds = model::SpeedRange{3, 6, 61};
    const auto result = stability(scene, {});
    ASSERT_EQ(result.zero_root_speeds.size(), 1U);
    EXPECT_NEAR(result.zero_root_speeds[0], 3.788366, 1e-6);
}

/// A uniform shaft of 1.5 m on two damped bearings, one of them with a negative stiffness in x.
model::Case negative_stiffness(double kxx) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.5, 0.05, {"steel", 2.11e11, 8.12e10, 7810});
    scene.rotor.shaft.order = 8;
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e6, 10),
                            tests::isotropic_bearing(1.5, 1e6, 10)};
    scene.rotor.bearings[0].rows[0].k(0, 0) = kxx;
    scene.speeds = model::SpeedRange{10, 10, 1};
    return scene;
}

// One speed: stable or not, and which way. 120.3727: dense state matrix of Legendre elements.
TEST(OneSpeed, SaysWhetherItIsStable) {
    const auto diverging = stability(negative_stiffness(-1e5), {});
    ASSERT_EQ(diverging.verdict.size(), 1U);
    EXPECT_EQ(diverging.verdict[0], results::Verdict::diverges);
    EXPECT_NEAR(diverging.growth[0], 120.3727, 1e-4);
    EXPECT_EQ(stability(negative_stiffness(1e5), {}).verdict[0], results::Verdict::stable);
    model::Case undamped = negative_stiffness(1e5);
    for (model::Bearing &bearing : undamped.rotor.bearings)
        bearing.rows[0].c.setZero();
    EXPECT_EQ(stability(undamped, {}).verdict[0], results::Verdict::neutral);
    model::Case driven = negative_stiffness(1e6);
    for (model::Bearing &bearing : driven.rotor.bearings) {
        bearing.rows[0].k(0, 1) = 1e5;
        bearing.rows[0].k(1, 0) = -1e5;
    }
    EXPECT_EQ(stability(driven, {}).verdict[0], results::Verdict::unstable);
}

// A disc amid a rigid shaft on two bearings with damping proportional to their stiffness: along x
// and y it swings by itself at every speed, w^2 = 2k/m, with the damping ratio beta w/2. Tilting is
// faster, and so damped more.
TEST(LogDec, OfADiscOnTwoBearingsIsTheClosedForm) {
    constexpr double mass = 10;
    constexpr double beta = 1e-4;
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, mass, 0.1, 0.05)};
    for (const double z : {0.0, 1.0}) {
        model::Bearing bearing = tests::isotropic_bearing(z, 1e5);
        bearing.rows[0].k(1, 1) = 2e5;
        bearing.rows[0].c = beta * bearing.rows[0].k;
        scene.rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, 300, 4};
    const results::StabilityResult result = stability(scene, {});
    const double ratio = beta * std::sqrt(2e5 / mass) / 2;
    ASSERT_EQ(result.log_dec.size(), 4U);
    for (const double log_dec : result.log_dec)
        // 1e-9: the small bearing damping makes the real part a hundredth of the eigenvalue.
        EXPECT_NEAR(log_dec / (2 * std::numbers::pi * ratio / std::sqrt(1 - ratio * ratio)), 1,
                    1e-9);
}

// At rest balls without weight lie still wherever they are, however much their drag damps them.
TEST(OneSpeed, BallsAtRestAreNeutral) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.08, tests::steel());
    scene.rotor.shaft.order = 4;
    scene.rotor.bearings = {tests::isotropic_bearing(0, 4e6, 2e3),
                            tests::isotropic_bearing(1.2, 5e6, 2e3)};
    scene.rotor.balancers = {tests::ball_balancer(0.3, 2, 0.1, 0.17, 0.6, 0.012)};
    scene.speeds = model::SpeedRange{0, 0, 1};
    const auto alone = stability(scene, {});
    EXPECT_EQ(alone.verdict[0], results::Verdict::neutral);
    EXPECT_EQ(alone.growth[0], 0);
    scene.speeds = model::SpeedRange{0, 100, 2};
    EXPECT_EQ(stability(scene, {}).verdict[0], results::Verdict::neutral);
}

// A coarse mesh has the ends of its bands wrong by what it says, against a mesh that is converged.
TEST(BandErrors, AreThoseOfTheMesh) {
    for (const int order : {1, 3}) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(0.9, 0.03, tests::steel());
        scene.rotor.shaft.order = order;
        scene.rotor.discs = {tests::disc_at(0.35, 12, 0.12, 0.2)};
        scene.rotor.anisotropies = {{"", 0.35, 0.05, 0.3}};
        scene.rotor.bearings = {tests::isotropic_bearing(0, 5e6, 150),
                                tests::isotropic_bearing(0.9, 5e6, 150)};
        scene.speeds = model::SpeedRange{150, 1300, 101};
        const auto coarse = stability(scene, {});
        scene.rotor.shaft.order = 12;
        const auto exact = stability(scene, {});
        ASSERT_FALSE(exact.unstable.empty());
        ASSERT_EQ(coarse.unstable.size(), exact.unstable.size()) << order;
        ASSERT_EQ(coarse.unstable_error.size(), exact.unstable.size());
        for (std::size_t i = 0; i < exact.unstable.size(); ++i) {
            const auto check = [&](double found, double truth, double error) {
                const double off = std::abs(found - truth);
                if (found == scene.speeds->from || found == scene.speeds->to)
                    return;
                // 1e-9: where both are exact but for rounding of the matrices.
                EXPECT_LE(off, 1.05 * error + 1e-9 * truth) << order << " " << truth;
                EXPECT_GE(off + 1e-9 * truth, 0.5 * error) << order << " " << truth;
            };
            check(coarse.unstable[i].from, exact.unstable[i].from, coarse.unstable_error[i].first);
            check(coarse.unstable[i].to, exact.unstable[i].to, coarse.unstable_error[i].second);
        }
    }
}

// No body has more than half its polar inertia; a rotor that is stable with that has no limit.
TEST(Permissible, IsNotMoreThanABodyCanHave) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs[0].Ip = 0.188;
    scene.rotor.bearings[0].rows[0].c *= 10;
    scene.rotor.bearings[1].rows[0].c *= 10;
    scene.rotor.anisotropies[0].dI = 0.01;
    const auto result = stability(scene, {});
    ASSERT_EQ(result.permissible.size(), 1U);
    EXPECT_NEAR(result.permissible[0].most, 0.094, 1e-12);
    EXPECT_TRUE(result.permissible[0].of_disc);
    EXPECT_FALSE(result.permissible[0].dI);
}

// What is permissible has no band, a little more has one.
TEST(Permissible, IsWhereTheBandSearchFindsTheFirstBand) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    const auto result = stability(scene, {});
    ASSERT_TRUE(result.permissible.at(0).dI);
    for (const auto &[factor, bands] : {std::pair(1 - 1e-8, 0U), std::pair(1 + 1e-5, 1U)}) {
        scene.rotor.anisotropies[0].dI = factor * *result.permissible[0].dI;
        EXPECT_EQ(unstable_bands_of(scene, {}, false).bands.size(), bands);
    }
}

// A motion that decays at every speed of the grid but for a hump in between, far from any other.
TEST(UnstableBands, HumpBetweenGridSpeedsIsFound) {
    const stability::MotionsAt at = [](double speed) {
        const double x = speed - 1.13;
        return std::vector<stability::Motion>{motion(0.01 - x * x, 5, 0), motion(-1, 9, 1)};
    };
    const auto bands = stability::unstable_bands(at, {0.0, 0.4, 0.8, 1.25, 1.6, 2.0});
    ASSERT_EQ(bands.size(), 1U);
    EXPECT_NEAR(bands[0].from, 1.03, 1e-9);
    EXPECT_NEAR(bands[0].to, 1.23, 1e-9);
}

// Two motions that grow everywhere with different states: one of them has a window, the other not.
TEST(UnstableBands, WindowUnderADipOfTheGrowthIsFound) {
    const stability::MotionsAt at = [](double speed) {
        const double x = speed - 1.01;
        return std::vector<stability::Motion>{motion(x * x - 1e-4, 5, 0), motion(-1, 9, 1)};
    };
    const auto bands = stability::unstable_bands(at, {0.0, 0.3, 0.6, 0.9, 1.2, 1.5});
    ASSERT_EQ(bands.size(), 2U);
    EXPECT_NEAR(bands[0].to, 1.0, 1e-9);
    EXPECT_NEAR(bands[1].from, 1.02, 1e-9);
}

// Masses, springs and dampers of everything times one factor: no motion changes its rate. Of balls
// with the imbalance of their own balancer, and with that of an [[imbalance]].
TEST(StabilityMap, EntriesThatScaleTogetherLeaveMotionsAsTheyAre) {
    const std::string rotor = "[shaft]\nrigid = true\n"
                              "segments = [{length = 1, outer = 0.01, material = \"light\"}]\n"
                              "[material.light]\nE = 2e11\nnu = 0.3\nrho = 1e-8\n"
                              "[[disc]]\nz = 0.45\nmass = 10\nId = 0.3\nIp = 0.2\n"
                              "[[bearing]]\nz = 0\nk = 5e5\nc = 300\n"
                              "[[bearing]]\nz = 1\nk = 6e5\nc = 300\n";
    const std::string map =
        "[speeds]\nfrom = 400\nto = 900\ncount = 3\n[map]\n"
        "x = {path = \"speed\", from = 400, to = 900, count = 3}\n"
        "y = {path = [\"disc[0].mass\", \"disc[0].Id\", \"disc[0].Ip\", \"bearing[*].k\", "
        "\"bearing[*].c\", \"balancer[0].mass\", \"balancer[0].damping\", ";
    const std::string ball = "[[balancer]]\nz = 0.5\nn = 2\nmass = 0.05\nradius = 0.1\n"
                             "damping = 0.5\n";
    struct Imbalance {
        const char *where, *entry;
    };
    for (const auto &[where, entry] :
         {Imbalance{"imbalance = 0.004\n", "balancer[0].imbalance"},
          Imbalance{"[[imbalance]]\nz = 0.5\nmr = 0.004\n", "imbalance[0].mr"}}) {
        const model::Case scene =
            tests::written_case(rotor + ball + where + map + "\"" + entry +
                                "\"], change = \"factor\", from = 0.5, to = 2, count = 4}\n");
        const auto result = stability(scene, [&](const std::vector<std::string> &entries) {
            return input::load_case(scene.file, entries);
        });
        ASSERT_TRUE(result.map);
        EXPECT_EQ(result.map->y.values, (std::vector<double>{0.5, 1, 1.5, 2}));
        const auto &growth = result.map->growth;
        ASSERT_EQ(growth.size(), 4U);
        for (const std::vector<double> &row : growth)
            for (std::size_t i = 0; i < row.size(); ++i) {
                EXPECT_NE(row[i], 0);
                EXPECT_NEAR(row[i], growth[1][i], 1e-9 * 900) << entry; // of the fastest motions
            }
        // The second row is the case as it is.
        EXPECT_NEAR(growth[1][0], result.growth[0], 1e-7);
        EXPECT_NEAR(growth[1][2], result.growth[2], 1e-7);
    }
}

// Where a map asks for what cannot be, that point alone is empty.
TEST(StabilityMap, ImpossibleRotorsAreEmptyPoints) {
    model::Case scene = tests::anisotropic_case();
    scene.rotor.shaft.rigid = true;
    scene.speeds = model::SpeedRange{2, 4, 3};
    scene.map = model::MapSettings{
        {"speed", {}, model::SweepChange::value, model::Quantity::speed, {2, 3, 4}},
        {"anisotropy[0].dI",
         {{"anisotropy[0].dI", 0}},
         model::SweepChange::value,
         model::Quantity::inertia,
         {0, 0.5, 1}}};
    const CaseWith with = [&](const std::vector<std::string> &entries) {
        model::Case varied = scene;
        varied.rotor.anisotropies[0].dI = std::stod(entries.at(0).substr(17));
        if (varied.rotor.anisotropies[0].dI > 0.9) // Id = 1 is the limit: Ip/2 = 0.4 in the input
            throw model::BadInput("no such rotor");
        return varied;
    };
    const auto result = stability(scene, with);
    ASSERT_TRUE(result.map);
    EXPECT_LE(result.map->growth[0][1], 0); // without anisotropy
    EXPECT_GT(result.map->growth[1][1], 0); // 0.5 at speed 3
    for (const double growth : result.map->growth[2])
        EXPECT_TRUE(std::isnan(growth));
    // Of which there is none at all no answer is one.
    scene.map->y.values = {1, 2};
    EXPECT_THROW((void)stability(scene, with), model::AnalysisFailure);
    std::swap(scene.map->x, scene.map->y);
    EXPECT_THROW((void)stability(scene, with), model::AnalysisFailure);
}

// The anisotropy that `show` gives with two balancers whose imbalances point differently: sum of
// dI exp(2 i angle) over ball and point masses, from their angles one by one.
TEST(ImbalancePhase, ShowSumsTheMassesWhereTheyAre) {
    model::Case scene = tests::balancer_case();
    scene.rotor.balancers[0].imbalance_phase = 0.9;
    scene.rotor.balancers.push_back(scene.rotor.balancers[0]);
    scene.rotor.balancers[1].z = 0.3;
    scene.rotor.balancers[1].imbalance_phase = -0.4;
    scene.rotor.anisotropies = {{"", 0.4, 0.05, 0.3}};
    std::complex<double> sum = std::polar(0.05, 0.6);
    for (const model::Balancer &b : scene.rotor.balancers) {
        const double opening =
            std::acos(-b.imbalance / (tests::row(b).n * tests::row(b).mass * tests::row(b).radius));
        for (const double angle : {b.imbalance_phase + opening, b.imbalance_phase - opening})
            sum += std::polar(tests::row(b).mass * tests::row(b).radius * tests::row(b).radius / 2,
                              2 * angle);
        sum += std::polar(b.imbalance * *b.imbalance_radius / 2, 2 * b.imbalance_phase);
    }
    const auto result = show(scene);
    ASSERT_TRUE(result.dI);
    EXPECT_NEAR(*result.dI, std::abs(sum), 1e-12);
    EXPECT_NEAR(std::remainder(*result.dI_angle - std::arg(sum) / 2, std::acos(-1.0)), 0, 1e-12);
}

// A rotor with a balancer on supports far softer than its shaft: the slow motion on them is found
// beside the elastic ones. 1 %: the balls, a thousandth of the mass, roll in their race.
TEST(SoftSupports, WhirlModesOfARotorWithABalancer) {
    for (const double k : {1e4, 1e2, 1.0}) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(1.2, 0.08, tests::steel());
        scene.rotor.shaft.order = 5;
        scene.rotor.discs = {tests::disc_at(0.3, 30, 0.3, 0.2), tests::disc_at(0.9, 30, 0.3, 0.2)};
        scene.rotor.bearings = {tests::isotropic_bearing(0, k, 1e-4 * k),
                                tests::isotropic_bearing(1.2, k, 1e-4 * k)};
        scene.rotor.balancers = {tests::ball_balancer(0.3, 2, 0.05, 0.12, 0.5, 0.006)};
        scene.speeds = model::SpeedRange{12.5, 12.5, 1};
        const results::CampbellResult result = campbell(scene);
        const double mass = 60.1 + 1.2 * tests::steel().rho * std::acos(-1.0) / 4 * 0.08 * 0.08;
        double nearest = HUGE_VAL;
        for (const results::CampbellMode &mode : result.modes)
            nearest = std::min(
                nearest, std::abs(mode.frequency[0].value_or(0) / std::sqrt(2 * k / mass) - 1));
        EXPECT_LT(nearest, 0.01) << k;
    }
}

} // namespace
} // namespace whirl::analyses

// Rotor and bearings both unsymmetric: Hill's series in rotating axes against Floquet multipliers
// of the fixed frame, and against published windows of stability.

#include "analyses/stability.h"
#include "analyses/stability_map.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "stability/hill/hill_solver.h"
#include "stability/rotor_at_speeds.h"
#include "stability/unstable_bands.h"
#include "support/balancer_parts.h"
#include "support/looked_at.h"
#include "support/periodic_system.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rotating_hill_test {

using namespace whirl;
using Values = std::vector<std::complex<double>>;

model::Bearing damped_bearing(double z, double kxx, double kyy, double share) {
    model::Bearing out = tests::bearing(z, kxx, kyy);
    out.rows[0].c = share * out.rows[0].k;
    return out;
}

/// Rigid rotor with unequal diametral inertias, bearings that differ in x and y and are not placed
/// alike; the tilt has two resonances far apart.
model::Rotor rigid_rotor() {
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(1);
    rotor.discs = {tests::disc(0.5, 30, 1.2, 0.5)};
    rotor.anisotropies = {{"", 0.5, 0.15, 0.4}};
    rotor.bearings = {damped_bearing(0.05, 1e6, 3e5, 2e-5), damped_bearing(1, 8e5, 4e5, 2e-5)};
    return rotor;
}

/// The same with cross coupling and damping that is not proportional.
model::Rotor coupled_rotor() {
    model::Rotor rotor = rigid_rotor();
    rotor.bearings[0].rows[0].k(0, 1) = 1e5;
    rotor.bearings[0].rows[0].k(1, 0) = 5e4;
    rotor.bearings[1].rows[0].c(0, 1) = 15;
    rotor.bearings[1].rows[0].kt(0, 0) = 3e3;
    return rotor;
}

bool within(const std::vector<results::Interval> &bands, double speed, double margin) {
    return std::any_of(bands.begin(), bands.end(), [&](const auto &band) {
        return speed > band.from - margin && speed < band.to + margin;
    });
}

constexpr int steps = 120;

struct Scene {
    std::string name;
    model::Rotor rotor;
};

void PrintTo(const Scene &scene, std::ostream *out) { *out << scene.name; }

class Hill : public testing::TestWithParam<Scene> {
  protected:
    model::Rotor rotor = GetParam().rotor;
    model::Case scene = tests::scene_of(rotor, 100, 450, 71);
    assembly::Discretization d{rotor, rotor.shaft.order};
    stability::StabilityModel model = modelled(false);

    /// @param reduction  false: by Hill's series
    [[nodiscard]] stability::StabilityModel modelled(bool reduction) {
        scene.reduction = reduction;
        return stability::stability_model(scene, scene.speeds->values());
    }
    [[nodiscard]] tests::PeriodicSystem periodic(double speed) const { return {d, speed, {}}; }
};

TEST_P(Hill, MultipliersAreTheExponentialsOfTheEigenvalues) {
    ASSERT_EQ(model.form, results::Form::hill);
    EXPECT_GE(model.harmonics, 1);
    const stability::HillSolver solver(model, {});
    for (const double speed : {140.0, 260.0, 420.0}) {
        Values low;
        for (const stability::Motion &motion : solver.at(speed))
            if (std::abs(motion.value) <= speed)
                low.push_back(motion.value);
        ASSERT_GE(low.size(), 2U);
        const tests::PeriodicSystem system = periodic(speed);
        // The series settles to 1e-8 of the speed, so exp(2 pi l / speed) to 2 pi 1e-8.
        EXPECT_LT(tests::largest_distance(tests::exponentials(low, system.period()),
                                          system.multipliers(steps)),
                  1e-7)
            << speed;
    }
}

TEST_P(Hill, GrowthIsThatOfTheMultipliers) {
    const stability::HillSolver series(model, {});
    const stability::HillSolver monodromy(tests::looked_at(rotor, model.form, model.order), {});
    scene.reduction = true; // bands by the monodromy matrix
    const auto bands = analyses::unstable_bands_of(scene, {}, false).bands;
    EXPECT_GE(bands.size(), 1U);
    for (double speed = 101.3; speed < 450; speed += 5) {
        const double growth = periodic(speed).growth(steps);
        EXPECT_NEAR(stability::growth_of(series.at(speed)), growth, 1e-7 * speed) << speed;
        EXPECT_NEAR(stability::growth_of(monodromy.at(speed)), growth, 1e-7 * speed) << speed;
        if (!within(bands, speed, 1e-3)) {
            EXPECT_LT(growth, 1e-6) << speed;
        }
    }
    for (const auto &[from, to] : bands) {
        EXPECT_GT(periodic(0.5 * (from + to)).growth(steps), 0);
        for (const double end : {from, to})
            if (end > 100 && end < 450) {
                EXPECT_NEAR(periodic(end).growth(steps), 0, 1e-5 * end);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Rotors, Hill,
                         testing::Values(Scene{"orthotropic", rigid_rotor()},
                                         Scene{"coupled", coupled_rotor()}),
                         [](const auto &instance) { return instance.param.name; });

TEST(HillForm, EqualsTheRotatingFormOnEqualBearings) {
    model::Rotor rotor = rigid_rotor();
    rotor.bearings = {damped_bearing(0.05, 6e5, 6e5, 2e-5), damped_bearing(1, 8e5, 8e5, 2e-5)};
    model::Case scene = tests::scene_of(rotor, 100, 450, 71);
    const auto rotating = analyses::unstable_bands_of(scene, {}, false).bands;
    scene.formulation = model::FormChoice::hill;
    const auto hill = analyses::unstable_bands_of(scene, {}, false).bands;
    ASSERT_EQ(rotating.size(), 1U);
    ASSERT_EQ(hill.size(), 1U);
    EXPECT_NEAR(hill[0].from, rotating[0].from, 1e-9 * rotating[0].from);
    EXPECT_NEAR(hill[0].to, rotating[0].to, 1e-9 * rotating[0].to);
}

TEST(HillForm, SaysSoWhereTheSeriesDoesNotSettle) {
    model::Rotor rotor = rigid_rotor();
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows[0].k(1, 1) /= 100;
    model::Case scene = tests::scene_of(rotor, 0.1, 1, 12);
    scene.reduction = false;
    try {
        (void)analyses::stability(scene, [&](const auto &) { return scene; });
        ADD_FAILURE() << "no exception";
    } catch (const model::AnalysisFailure &failure) {
        EXPECT_NE(std::string(failure.what()).find("does not settle"), std::string::npos);
    }
}

// From rest on, slow speeds are given up; at the first that is not the growth is that of the
// multipliers.
TEST(HillForm, LeavesOutSpeedsThatAreTooSlow) {
    const model::Rotor rotor = rigid_rotor();
    const assembly::Discretization d(rotor, rotor.shaft.order);
    model::Case whole = tests::scene_of(rotor, 0, 450, 181);
    whole.reduction = false;
    const auto series = stability::stability_model(whole, whole.speeds->values());
    EXPECT_GT(series.from, 0);
    EXPECT_LT(series.from, 200);
    const stability::HillSolver solver(series, {});
    for (const double speed : {series.from, 450.0}) {
        const tests::PeriodicSystem system(d, speed, {});
        EXPECT_NEAR(stability::growth_of(solver.at(speed)), system.growth(240), 1e-6 * speed)
            << speed;
    }
    model::Case scene = tests::scene_of(rotor, 1, 450, 3);
    scene.reduction = false;
    scene.map = model::MapSettings{
        {"speed", {}, model::SweepChange::value, model::Quantity::speed, {1, 225.5, 450}},
        {"anisotropy[0].dI",
         {{"anisotropy[0].dI", 0}},
         model::SweepChange::value,
         model::Quantity::inertia,
         {0.1, 0.2}}};
    const auto map =
        analyses::stability_map(*scene.map, [&](const auto &) { return scene; }).growth;
    EXPECT_TRUE(std::isnan(map[0][0]));
    EXPECT_TRUE(std::isfinite(map[0][2]));
}

// Cross-coupled bearings feed motions five times as fast as the rotor; the growth at 60 rad/s is
// that of Floquet multipliers by a Magnus integrator on spectral elements.
TEST(HillForm, FastMotionsThatBearingsDriveAreSeen) {
    model::Rotor rotor;
    rotor.shaft.segments = {{1.0, 0.05, 0.05, 0, 0, {"steel", 2.1e11, 2.1e11 / 2.6, 7850}, 1}};
    rotor.shaft.order = 4;
    rotor.discs = {tests::disc(0.5, 20, 0.2, 0.3)};
    rotor.anisotropies = {{"", 0.5, 1e-4, 0}};
    rotor.bearings = {tests::bearing(0, 2e6, 2.4e6, 0, 100), tests::bearing(1, 2e6, 2.4e6, 0, 100)};
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.rows[0].k(0, 1) = 2e5;
        bearing.rows[0].k(1, 0) = -2e5;
    }
    for (const int harmonics : {1, 0}) { // 0: the monodromy matrix
        const stability::HillSolver solver(
            tests::looked_at(rotor, results::Form::hill, 4, harmonics), {});
        for (const double speed : {60.0, 70.0, 80.0})
            EXPECT_GT(stability::growth_of(solver.at(speed)), 3.6) << speed;
        EXPECT_NEAR(stability::growth_of(solver.at(60)), 3.714, 5e-4);
    }
}

// At rest the supports stand still, and motions there are no limit of those of slow speeds: bands
// and permissible anisotropy of a range from rest are those of the multipliers, and the same as of
// a range that begins higher up.
TEST(HillForm, RangesFromRestAreAnsweredAsFromAbove) {
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(2);
    rotor.discs = {tests::disc(1, 1, 1, 0.466)};
    rotor.anisotropies = {{"", 1, 0.1536, 0}};
    rotor.bearings = {tests::bearing(0, 0.78, 0.62, 0, 0.065),
                      tests::bearing(2, 0.78, 0.62, 0, 0.065)};
    const auto growth = [&](double dI, double speed) {
        rotor.anisotropies[0].dI = dI;
        const assembly::Discretization d(rotor, 1);
        return tests::PeriodicSystem(d, speed, {}).growth(steps);
    };
    const model::Case scene = tests::scene_of(rotor, 0, 8, 41);
    const auto from_rest = analyses::stability(scene, [&](const auto &) { return scene; });
    const model::Case above = tests::scene_of(rotor, 0.35, 8, 41);
    const auto from_above = analyses::stability(above, [&](const auto &) { return above; });
    ASSERT_EQ(from_rest.unstable.size(), 1U);
    ASSERT_EQ(from_above.unstable.size(), 1U);
    const auto [from, to] = from_rest.unstable[0];
    EXPECT_NEAR(from, from_above.unstable[0].from, 1e-9 * from);
    EXPECT_NEAR(to, from_above.unstable[0].to, 1e-9 * to);
    const double given = rotor.anisotropies[0].dI;
    constexpr double beside = 1e-5; // of the speed
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_EQ(growth(given, from * (1 + sign * beside)) > 0, sign > 0);
        EXPECT_EQ(growth(given, to * (1 + sign * beside)) > 0, sign < 0);
    }
    ASSERT_EQ(from_rest.permissible.size(), 1U);
    ASSERT_TRUE(from_rest.permissible[0].dI.has_value());
    const double permissible = *from_rest.permissible[0].dI;
    EXPECT_NEAR(permissible, *from_above.permissible[0].dI, 1e-8 * permissible);
    // The last band closes within the one there is; so far above that it is wider than a step.
    double most_below = -HUGE_VAL;
    double most_above = -HUGE_VAL;
    for (double speed = from; speed < to; speed += 0.01) {
        most_below = std::max(most_below, growth(0.998 * permissible, speed));
        most_above = std::max(most_above, growth(1.002 * permissible, speed));
    }
    EXPECT_LT(most_below, 0);
    EXPECT_GT(most_above, 0);
}

// With the largest anisotropy half a turn at the slowest speeds hides all motions, with the given
// one it does not: growth and bands are answered.
TEST(HillForm, SlowSpeedsWithoutPermissibleAnisotropyAreAnswered) {
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(2);
    rotor.discs = {tests::disc(1, 1, 1, 0.46)};
    rotor.anisotropies = {{"", 1, 0.12, 0}};
    rotor.bearings = {tests::bearing(0, 0.78, 0.505, 0, 0.102),
                      tests::bearing(2, 0.78, 0.505, 0, 0.102)};
    const model::Case scene = tests::scene_of(rotor, 0, 0.02, 41);
    const auto found = analyses::stability(scene, [&](const auto &) { return scene; });
    EXPECT_TRUE(found.unstable.empty());
    const assembly::Discretization d(rotor, 1);
    constexpr int slow_steps = 6000; // a turn takes some 50 periods of the slowest motion
    EXPECT_NEAR(found.growth.back(), tests::PeriodicSystem(d, 0.02, {}).growth(slow_steps), 1e-9);
}

/// The rotor of cases/hill_rotor on bearings that differ ninefold, hardly damped, with the largest
/// anisotropy that it can have.
model::Rotor strongly_unequal_rotor() {
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(1);
    rotor.discs = {tests::disc(0.5, 20, 0.8, 0.5)};
    rotor.anisotropies = {{"", 0.5, 0.24, 0}};
    rotor.bearings = {tests::bearing(0, 1e5, 9e5, 0, 0.5), tests::bearing(1, 1e5, 9e5, 0, 0.5)};
    return rotor;
}

TEST(HillForm, NarrowBandsOfFastMotionsAndNoFalseOnes) {
    const model::Rotor rotor = strongly_unequal_rotor();
    const assembly::Discretization d(rotor, 1);
    const stability::HillSolver solver(tests::looked_at(rotor, results::Form::hill, 1, 1), {});
    const auto found = stability::find_bands([&solver](double speed) { return solver.at(speed); },
                                             model::SpeedRange{160, 250, 10}.values());
    EXPECT_TRUE(found.doubtful.empty());
    ASSERT_EQ(found.bands.size(), 2U);
    // By the multipliers of the periodic equations: growth inside of every end, none outside.
    for (const auto &[from, to] : found.bands) {
        for (const double end : {from + 0.02, to - 0.02})
            EXPECT_GT(tests::PeriodicSystem(d, end, {}).growth(400), 1e-4);
        const double inside = (from + to) / 2;
        EXPECT_NEAR(tests::PeriodicSystem(d, inside, {}).growth(400),
                    stability::growth_of(solver.at(inside)), 1e-6 * inside);
        for (const double end : {from - 0.02, to + 0.02}) // rounding of the multipliers: 1e-9
            EXPECT_LT(tests::PeriodicSystem(d, end, {}).growth(400), 1e-6);
    }
}

/// Rigid rotors on random bearings, some of which drive.
model::Rotor random_rigid_rotor(std::mt19937 &random) {
    const auto uniform = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(1);
    const double Id = uniform(0.3, 2);
    const double Ip = uniform(0.4, 1.5) * Id;
    rotor.discs = {tests::disc(uniform(0.2, 0.8), uniform(5, 40), Id, Ip)};
    rotor.anisotropies = {
        {"", rotor.discs[0].z, uniform(0.02, 0.5) * std::min(Ip / 2, Id), uniform(0, 3)}};
    for (const double z : {0.0, 1.0}) {
        const double k = std::exp(uniform(11, 14));
        rotor.bearings.push_back(tests::bearing(z, k, k * uniform(0.3, 3), 0, 1e-4 * k));
        const double cross = uniform(-0.02, 0.05) * k;
        rotor.bearings.back().rows[0].k(0, 1) = cross;
        rotor.bearings.back().rows[0].k(1, 0) = -cross + uniform(-0.05, 0.05) * k;
    }
    return rotor;
}

// Every speed with as many harmonics as it needs: the growth of the multipliers wherever a growth
// is given, and at most speeds one is given.
TEST(HillForm, GrowthOfRandomRotorsIsThatOfTheMultipliers) {
    std::mt19937 random(7);
    int given = 0;
    int asked = 0;
    for (int i = 0; i < 12; ++i) {
        const model::Rotor rotor = random_rigid_rotor(random);
        const assembly::Discretization d(rotor, 1);
        const stability::HillSolver solver(tests::looked_at(rotor, results::Form::hill, 1, 1), {});
        for (const double speed : {60.0, 150.0, 310.0, 700.0}) {
            ++asked;
            std::vector<stability::Motion> motions;
            try {
                motions = solver.at(speed);
            } catch (const model::AnalysisFailure &) {
                continue;
            }
            ++given;
            const double growth = tests::PeriodicSystem(d, speed, {}).growth(600);
            EXPECT_NEAR(stability::growth_of(motions), growth, 1e-7 * speed) << i << " " << speed;
        }
    }
    EXPECT_GE(given, 3 * asked / 4);
}

/// Rigid rotor with two two-ball balancers (Rodrigues, Champneys, Friswell, Wilson): mass and
/// radius 1, first cylindrical critical speed 1; z from the centre of mass.
model::Rotor two_plane_rotor() {
    constexpr double m = 1e-4;
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(6);
    rotor.discs = {tests::disc(3, 1, 3.25, 0.5)};
    rotor.bearings = {damped_bearing(0, 0.5, 2.5, 0.02), damped_bearing(6, 0.5, 2.5, 0.02)};
    for (const double z : {1.0, 5.0}) {
        model::Balancer balancer;
        balancer.z = z;
        tests::row(balancer).n = 2;
        tests::row(balancer).mass = m;
        tests::row(balancer).radius = 1;
        tests::row(balancer).damping = 0.01 * m;
        balancer.imbalance = 0.5e-4; // half of the rotor's eccentricity of 1e-4
        rotor.balancers.push_back(balancer);
    }
    return rotor;
}

TEST(TwoPlaneBalancer, WindowsOfStabilityOnUnequalBearings) {
    // Computed with an independent program by Floquet multipliers on a grid of 0.05 over 0.6 to 6,
    // without the tilt inertia of the balls, which is of the order of their mass, 1e-4.
    const model::Rotor rotor = two_plane_rotor();
    const model::Case scene = tests::scene_of(rotor, 0.6, 6, 109);
    const balancers::Arrangement balls = balancers::arrangement_at_balance(rotor);
    const auto bands = analyses::unstable_bands_of(scene, balls, false).bands;
    std::vector<double> ends{0.6};
    ASSERT_FALSE(bands.empty());
    std::vector<std::pair<double, double>> stable;
    double last = 0.6;
    for (const auto &[from, to] : bands) {
        if (from - last > 0.01)
            stable.emplace_back(last, from);
        last = to;
    }
    if (last < 6)
        stable.emplace_back(last, 6);
    ASSERT_EQ(stable.size(), 2U);
    EXPECT_NEAR(stable[0].first, 2.50, 0.055);
    EXPECT_NEAR(stable[0].second, 2.70, 0.055);
    EXPECT_NEAR(stable[1].first, 4.55, 0.055);
    EXPECT_EQ(stable[1].second, 6);
}

TEST(TwoPlaneBalancer, GrowthIsThatOfTheMultipliers) {
    const model::Rotor rotor = two_plane_rotor();
    const assembly::Discretization d(rotor, 1);
    const balancers::Arrangement balls = balancers::arrangement_at_balance(rotor);
    const model::Case scene = tests::scene_of(rotor, 0.6, 6, 109);
    const stability::StabilityModel model =
        stability::stability_model(scene, scene.speeds->values());
    const stability::HillSolver solver(model, balls);
    for (const double speed : {0.9, 1.5, 2.3, 2.6, 3.4, 5.1}) {
        const tests::PeriodicSystem system(d, speed, balls);
        EXPECT_NEAR(stability::growth_of(solver.at(speed)), system.growth(80), 1e-7 * speed);
    }
}

} // namespace rotating_hill_test

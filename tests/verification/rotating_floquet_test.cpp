// Every unstable band by two routes: eigenvalues of constant matrices in rotating axes, and Floquet
// multipliers of the periodic equations in the fixed frame (tests/support/periodic_system.h).

#include "analyses/stability.h"
#include "ends/growth.h"
#include "input/case_file.h"
#include "results/formulation.h"
#include "stability/rotor_at_speeds.h"
#include "support/balancer_parts.h"
#include "support/looked_at.h"
#include "support/periodic_system.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace whirl;
using Values = std::vector<std::complex<double>>;

constexpr int steps = 120; // a turn; the collocation is of order 8

/// A rotor of few unknowns and where to look.
struct Scene {
    std::string name;
    model::Rotor rotor;
    double from = 0, to = 0; ///< rad/s
    int fewest_bands = 1;
};

void PrintTo(const Scene &scene, std::ostream *out) { *out << scene.name; }

model::Rotor shaft_with_disc(double c) {
    model::Rotor rotor;
    rotor.shaft.segments = {tests::cylinder(0.35, 0.03), tests::cylinder(0.55, 0.03)};
    rotor.shaft.order = 1;
    rotor.discs = {tests::disc(0.35, 12, 0.12, 0.2)};
    rotor.bearings = {tests::round_bearing(0, 5e6, c), tests::round_bearing(0.9, 5e6, c)};
    return rotor;
}

Scene anisotropic_disc(double c) {
    model::Rotor rotor = shaft_with_disc(c);
    rotor.anisotropies = {{"", 0.35, 0.05, 0.3}};
    return {c > 0 ? "anisotropic_disc_damped" : "anisotropic_disc", rotor, 20, 1300, c > 0 ? 1 : 2};
}

Scene keyway(double eta) {
    model::Rotor rotor = shaft_with_disc(eta > 0 ? 400 : 0);
    rotor.shaft.segments[1].asymmetry = 0.2;
    rotor.shaft.segments[1].asymmetry_angle = -0.5;
    rotor.shaft.internal_damping = eta;
    return {eta > 0 ? "keyway_internally_damped" : "keyway", rotor, 20, 900, 1};
}

Scene balls(int n, bool own_position) {
    model::Rotor rotor = shaft_with_disc(800);
    model::Balancer balancer;
    balancer.z = 0.35;
    tests::row(balancer).n = n;
    tests::row(balancer).mass = 1.6 / n;
    tests::row(balancer).radius = 0.15;
    tests::row(balancer).damping = 12;
    balancer.imbalance = 0.15;
    balancer.imbalance_radius = 0.12;
    if (own_position)
        balancer.position = tests::unsymmetric_position(1.6);
    rotor.balancers = {balancer};
    return {"balls_" + std::to_string(n) + (own_position ? "_unsymmetric" : ""), rotor, 40, 500, 1};
}

Scene pendulums() {
    model::Rotor rotor = shaft_with_disc(800);
    model::Balancer balancer;
    balancer.z = 0.35;
    tests::pendulums_of(balancer).mass = 0.4;
    tests::pendulums_of(balancer).arm = 0.12;
    tests::pendulums_of(balancer).pivot = 0.03;
    tests::pendulums_of(balancer).damping = 0.05;
    rotor.balancers = {balancer};
    return {"pendulums", rotor, 40, 500, 1};
}

std::vector<Scene> scenes() {
    return {anisotropic_disc(0), anisotropic_disc(150), keyway(0),       keyway(4e-5),
            balls(2, false),     balls(3, true),        balls(5, false), pendulums()};
}

class TwoRoutes : public testing::TestWithParam<Scene> {
  protected:
    const Scene &scene = GetParam();
    balancers::Arrangement balls = balancers::arrangement_at_balance(scene.rotor);
    assembly::Discretization d{scene.rotor, 1};
    model::Case at = tests::scene_of(scene.rotor, scene.from, scene.to, 61);

    [[nodiscard]] tests::PeriodicSystem periodic(double speed) const { return {d, speed, balls}; }
};

TEST_P(TwoRoutes, MultipliersAreTheExponentialsOfTheEigenvalues) {
    const ends::Growth rotor(tests::looked_at(scene.rotor, results::Form::rotating, 1), balls,
                             nullptr, {scene.from, scene.to});
    for (const double share : {0.3, 0.8}) {
        const double speed = scene.from + share * (scene.to - scene.from);
        const tests::PeriodicSystem system = periodic(speed);
        Values slow; // what the steps resolve
        for (const ends::Root &motion : rotor.motions().at(speed).roots)
            if (std::abs(motion.value) < 3 * speed)
                slow.push_back(motion.value);
        ASSERT_GE(slow.size(), 4U);
        EXPECT_LT(tests::largest_distance(tests::exponentials(slow, system.period()),
                                          system.multipliers(steps)),
                  1e-8)
            << speed;
    }
}

TEST_P(TwoRoutes, BandsAreUnstableInsideAndStableBeside) {
    const auto bands = analyses::unstable_bands_of(at, balls, false).bands;
    EXPECT_GE(bands.size(), static_cast<std::size_t>(scene.fewest_bands));
    const ends::Growth rotor(tests::looked_at(scene.rotor, results::Form::rotating, 1), balls,
                             nullptr, {scene.from, scene.to});
    for (const auto &[from, to] : bands) {
        for (const double share : {0.1, 0.6}) {
            const double speed = from + share * (to - from);
            const double growth = rotor.at(speed);
            EXPECT_GT(growth, 0);
            EXPECT_NEAR(periodic(speed).growth(steps), growth, 1e-6 * growth + 1e-8 * speed)
                << from << " " << to;
        }
        // Beside the ends, unless the next band or the border is there.
        const double off = 0.05 * std::min(to - from, 1.0);
        for (const double speed : {from - off, to + off}) {
            const bool elsewhere = std::any_of(bands.begin(), bands.end(), [&](const auto &band) {
                return speed > band.from && speed < band.to;
            });
            if (!elsewhere && speed > scene.from && speed < scene.to) {
                EXPECT_LT(periodic(speed).growth(steps), 1e-8 * speed) << from << " " << to;
            }
        }
    }
}

// No band was overlooked: the fixed frame's growth on a grid says the same.
TEST_P(TwoRoutes, GridOfMultipliersFindsNoOtherBand) {
    const auto bands = analyses::unstable_bands_of(at, balls, false).bands;
    constexpr int points = 12;
    for (int i = 0; i <= points; ++i) {
        const double speed = scene.from + (scene.to - scene.from) * (i + 0.37) / (points + 1);
        const bool inside = std::any_of(bands.begin(), bands.end(), [&](const auto &band) {
            return speed > band.from && speed < band.to;
        });
        EXPECT_EQ(periodic(speed).growth(steps) > 1e-7 * speed, inside) << speed;
    }
}

INSTANTIATE_TEST_SUITE_P(Rotating, TwoRoutes, testing::ValuesIn(scenes()),
                         [](const auto &instance) { return instance.param.name; });

} // namespace

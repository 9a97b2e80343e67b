// Single motions of a rotor that turns far slower than it vibrates, as roots of Hill's series.

#include "analyses/campbell.h"
#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "periodic/whole_root.h"
#include "results/campbell.h"
#include "stability/hill/hill_solver.h"
#include "stability/hill/periodic_motions.h"
#include "support/looked_at.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace slow_roots_test {

using namespace whirl;

constexpr double top = 31.4; // rad/s

/// A stiff drum of two stiffnesses on supports that differ; its motions begin at some 300 rad/s.
model::Rotor drum() {
    model::Rotor out;
    out.shaft.segments = {tests::cylinder(0.3, 0.11, 1), tests::cylinder(1.2, 0.3, 4),
                          tests::cylinder(0.3, 0.1, 1)};
    out.shaft.segments[1].asymmetry = 0.05;
    out.shaft.order = 2;
    out.discs = {tests::disc(0.3, 30, 0.3, 0.5), tests::disc(1.5, 60, 0.5, 0.9)};
    out.anisotropies = {{"", 1.5, 0.03, 0.3}};
    out.bearings = {tests::bearing(0, 4e7, 2.5e7, 0, 8e3), tests::bearing(1.8, 5e7, 3e7, 0, 8e3)};
    return out;
}

stability::HillSolver solver_of(const model::Rotor &rotor) {
    return {tests::looked_at(rotor, results::Form::hill, 2, 0, top),
            balancers::arrangement_at_balance(rotor)};
}

/// At rest, turned by an angle, with all unknowns: the largest real part of the modes.
double growth_at_rest(double angle) {
    model::Rotor turned = drum();
    turned.shaft.segments[1].asymmetry_angle += angle;
    turned.anisotropies[0].angle += angle;
    model::Case scene = tests::scene_of(turned, 0, 0, 1);
    scene.reduction = false;
    double out = -std::numeric_limits<double>::infinity();
    for (const results::CampbellMode &mode : analyses::campbell(scene).modes)
        if (mode.real.front())
            out = std::max(out, *mode.real.front());
    return out;
}

/// In the limit of slow turning a motion grows as it does on average over the positions of the
/// rotor at rest; what the speed adds is of its square.
TEST(SlowRoots, GrowthNextToRestIsTheAverageOverThePositionsAtRest) {
    const model::Rotor rotor = drum();
    const stability::HillSolver solver = solver_of(rotor);
    const auto growth = [&](double speed) { return stability::growth_of(solver.at(speed)); };
    constexpr int angles = 12;
    double mean = 0;
    for (int k = 0; k < angles; ++k)
        mean += growth_at_rest(std::numbers::pi * k / angles) / angles;
    const double slow = top / 64;
    const double limit = (4 * growth(slow) - growth(2 * slow)) / 3;
    EXPECT_NEAR(limit, mean, 1e-8 * std::abs(mean));
    EXPECT_GT(std::abs(growth_at_rest(0) - mean), 1e-4 * std::abs(mean)); // they do differ
    EXPECT_EQ(solver.by_monodromy()->unconfirmed(), 0);
}

TEST(SlowRoots, OfASeriesThatDoesNotReachTheMotionAreNone) {
    const model::Rotor rotor = drum();
    const assembly::Discretization d(rotor, 2);
    const periodic::WholeRotor whole(d, {});
    const double frequency = 400;
    const std::complex<double> guess(-12, 0.1);
    for (const double speed : {0.3, 0.49, 1.0, 2.0}) // 80 terms reach 48 to 320 rad/s
        EXPECT_FALSE(whole.next_to(speed, guess, frequency)) << speed;
}

} // namespace slow_roots_test

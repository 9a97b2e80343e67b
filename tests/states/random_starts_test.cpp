// Motions in time from random starts against the states that the search lists: every motion that
// ends turning with the rotor must have ended in one of them, and in none that is listed as
// unstable. WHIRL_STARTS=1000 takes so many starts a speed and says what came of them.

#include "analyses/simulate.h"
#include "balancers/kind.h"
#include "input/case_file.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"
#include "support/ring_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

namespace whirl::states {
namespace {

using results::Outcome;
using results::SteadyState;
using std::numbers::pi;

struct StartedScene {
    std::string name;
    model::Case scene;
    std::vector<double> speeds; ///< rad/s
    double time;                ///< s, of each motion
};

/// k = 1e6 N/m on 10 kg: 316 rad/s.
StartedScene jeffcott(const std::string &name, const std::vector<model::Balancer> &balancers,
                      double imbalance, const std::vector<double> &speeds) {
    model::Case scene = tests::RigidJeffcott{}.scene();
    scene.rotor.balancers = balancers;
    scene.rotor.imbalances = {tests::imbalance_at(0.5, imbalance, 0.3)};
    return {name, scene, speeds, 25};
}

StartedScene two_planes(const std::string &name, double offset, const std::vector<double> &speeds) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.9, 0.2, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 8000),
                            tests::isotropic_bearing(0.9, 3e6, 8000)};
    scene.rotor.balancers = {tests::ball_balancer(0.1, 2, 0.02, 0.1, 1),
                             tests::ball_balancer(0.7, 2, 0.02, 0.12, 1)};
    scene.rotor.imbalances = {tests::imbalance_at(0.35 + offset, 2e-3, 0.4),
                              tests::imbalance_at(0.8, 1.5e-3, -2)};
    return {name, scene, speeds, 20};
}

std::vector<StartedScene> scenes() {
    const auto balls = [](int n, double mass) {
        return tests::ball_balancer(0.5, n, mass, 0.1, 3);
    };
    model::Balancer unequal = balls(1, 0.07);
    auto &rows = std::get<model::Balls>(unequal.parts).rows;
    rows.push_back(rows.front());
    rows[1].mass = 0.04;
    rows[1].radius = 0.08;
    model::Case flexible = input::load_case(WHIRL_ROOT "/cases/shaft_two_balancers");
    model::Case rings = tests::ring_rotor(200);
    model::Case pendulums = tests::pendulum_rotor_scene(1, 1.0, 0.5, 0.02);
    return {
        jeffcott("TwoBalls", {balls(2, 0.05)}, 0.004, {150, 290, 330, 500}),
        jeffcott("TwoUnequalBalls", {unequal}, 0.005, {200, 330, 450, 700}),
        jeffcott("ThreeBalls", {balls(3, 0.04)}, 0.004, {200, 340, 600}),
        jeffcott("TooLittleCapacity", {balls(2, 0.05)}, 0.015, {250, 330, 600}),
        jeffcott("OneBall", {balls(1, 0.05)}, 0.003, {250, 340, 600}),
        two_planes("TwoPlanes", 0, {150, 250, 600, 1000}),
        two_planes("TwoPlanesCouple", -0.2, {150, 800, 1200}),
        {"FlexibleShaftSlowly", flexible, {300}, 40}, // balls creep: in 10 s nothing is decided
        {"FlexibleShaft", flexible, {1000, 1700}, 10},
        {"Rings", rings, {80, 150, 250}, 20},
        {"Pendulums", pendulums, {60, 150, 280}, 10},
    };
}

/// Angles of parts that can be exchanged in any order.
bool same_angles(const model::Balancer &balancer, const std::vector<double> &state,
                 const std::vector<double> &motion) {
    constexpr double near = 0.1; // rad: to simulate what swings by half of it is at rest
    const auto circled = balancers::kind_of(balancer)->circled();
    std::vector<bool> taken(state.size(), false);
    for (std::size_t k = 0; k < state.size(); ++k) {
        bool found = false;
        for (std::size_t i = 0; i < state.size() && !found; ++i) {
            const bool alike = circled.empty() ? i == k : circled[i].alike == circled[k].alike;
            if (!taken[i] && alike && std::abs(std::remainder(state[i] - motion[k], 2 * pi)) < near)
                taken[i] = found = true;
        }
        if (!found)
            return false;
    }
    return true;
}

bool ended_in(const SteadyState &state, const results::SimulateResult &motion,
              const model::Rotor &rotor) {
    for (std::size_t b = 0; b < rotor.balancers.size(); ++b) {
        const results::BalancerMotion &end = motion.balancers[b];
        // Of a family one arrangement stands for all: its planes tell it.
        constexpr double still =
            0.1; // what may be left of an amplitude that simulate calls balanced
        if (std::abs(state.amplitudes[b] - end.amplitude) > still * end.reference)
            return false;
        if (!state.family && !same_angles(rotor.balancers[b], state.angles[b], end.angles))
            return false;
    }
    return true;
}

int starts_asked_for() {
    const char *asked = std::getenv("WHIRL_STARTS");
    return asked != nullptr ? std::atoi(asked) : 0;
}

class RandomStarts : public testing::TestWithParam<StartedScene> {};

TEST_P(RandomStarts, EndInStatesThatAreListedAndNotUnstable) {
    const int asked = starts_asked_for();
    const int starts = asked > 0 ? asked : 12;
    int resting = 0;
    for (const double speed : GetParam().speeds) {
        model::Case scene = GetParam().scene;
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = GetParam().time;
        scene.simulate.run_up.clear();
        bool undecided = false;
        const StateSearch search(scene, speed, speed);
        const auto states = search.at(speed, undecided);
        EXPECT_FALSE(undecided);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> angle(-pi, pi);
        std::map<std::string, int> counts;
        for (int run = 0; run < starts; ++run) {
            scene.simulate.ball_angles.clear();
            for (const model::Balancer &balancer : scene.rotor.balancers) {
                const auto kind = balancers::kind_of(balancer);
                scene.simulate.ball_angles.emplace_back(kind->start_angles());
                for (double &one : scene.simulate.ball_angles.back()) // pendulums to the sides
                    one = kind->circled().empty() ? angle(random) / 4 : angle(random);
            }
            const results::SimulateResult motion = analyses::simulate(scene);
            const bool rests =
                motion.outcome == Outcome::balanced || motion.outcome == Outcome::offset;
            if (!rests) {
                ++counts[results::outcome_name(motion.outcome)];
                continue;
            }
            ++resting;
            const auto state = std::ranges::find_if(states, [&](const StateSearch::Found &found) {
                return ended_in(found.state, motion, scene.rotor);
            });
            std::string start;
            for (const auto &angles : scene.simulate.ball_angles)
                for (const double one : angles)
                    start += std::to_string(one) + " ";
            if (state == states.end()) {
                ++counts["not listed"];
                ADD_FAILURE() << "at " << speed << " from " << start << ": "
                              << results::outcome_name(motion.outcome) << ", no such state";
                continue;
            }
            // In a time that shows it: an unstable state can hold a motion for a while.
            const bool leaves = state->state.stable == false && !state->state.family &&
                                state->state.growth * scene.simulate.time > 5;
            EXPECT_FALSE(leaves) << "at " << speed << " from " << start << ": growth "
                                 << state->state.growth;
            ++counts[results::steady_kind_name(state->state.kind) + (leaves ? " (unstable)" : "")];
        }
        if (asked > 0) {
            const auto stable = std::ranges::count_if(
                states, [](const auto &found) { return found.state.stable != false; });
            std::cout << GetParam().name << " at " << speed << " rad/s, " << states.size()
                      << " states, " << stable << " not unstable:";
            for (const auto &[name, count] : counts)
                std::cout << " " << count << " " << name << ",";
            std::cout << "\n";
        }
    }
    EXPECT_GT(resting, starts / 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomStarts, testing::ValuesIn(scenes()),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace whirl::states

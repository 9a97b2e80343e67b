// What balancers must supply against imbalances anywhere, and what stays, against closed forms and
// against what other commands say of the same rotor.

#include "analyses/balance.h"
#include "analyses/response.h"
#include "analyses/simulate.h"
#include "analyses/steady_states.h"
#include "analyses/weights.h"
#include "closed_form/dry_friction.h"
#include "model/errors.h"
#include "results/simulate.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::tests::supply {
namespace {

using results::BalanceResult;
using results::LeftAt;
using results::Supply;
using Complex = std::complex<double>;
using std::numbers::pi;

const LeftAt &place(const BalanceResult &result, const std::string &of, double z) {
    const auto found = std::ranges::find_if(result.supply->left, [&](const LeftAt &left) {
        return left.of == of && std::abs(left.z - z) < 1e-12;
    });
    EXPECT_NE(found, result.supply->left.end());
    return *found;
}

BalanceResult answer(model::Case scene) {
    scene.balance.balanced_position = false;
    return analyses::balance(scene);
}

/// A rigid body of 60 kg on two supports, imbalances off its planes.
model::Case rigid_rotor(std::vector<double> planes, double c = 300) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(0.9, 0.2, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {isotropic_bearing(0, 2e6, c), isotropic_bearing(0.9, 3e6, c)};
    for (const double z : planes)
        scene.rotor.planes.push_back({"", z});
    scene.rotor.imbalances = {imbalance_at(0.35, 2e-3, 0.4), imbalance_at(0.8, 5e-4, -2)};
    scene.speeds = model::SpeedRange{0, 1200, 13};
    return scene;
}

// What two planes need on a rigid shaft is the static split of forces over two supports, at every
// speed: the body then stands still.
TEST(BalanceSupply, RigidRotorSplitsImbalancesByMoments) {
    const model::Case scene = rigid_rotor({0.1, 0.7});
    const BalanceResult result = answer(scene);
    ASSERT_TRUE(result.supply);
    Complex first = 0, second = 0;
    for (const model::Imbalance &own : scene.rotor.imbalances) {
        const Complex u = std::polar(own.mr, own.phase);
        first -= u * (0.7 - own.z) / 0.6;
        second -= u * (own.z - 0.1) / 0.6;
    }
    EXPECT_EQ(result.supply->with_balancers[0], Supply::at_rest);
    EXPECT_FALSE(result.supply->planes[0].needed[0]);
    EXPECT_EQ(place(result, "bearing", 0).amplitude.nothing[0], 0);
    for (std::size_t k = 1; k < result.speeds.size(); ++k) {
        EXPECT_EQ(result.supply->with_balancers[k],
                  result.supply->works[k] ? Supply::balanced : Supply::unkept);
        EXPECT_LT(std::abs(*result.supply->planes[0].needed[k] - first), 1e-9 * std::abs(first));
        EXPECT_LT(std::abs(*result.supply->planes[1].needed[k] - second), 1e-9 * std::abs(second));
        for (const LeftAt &left : result.supply->left)
            EXPECT_LT(*left.amplitude.balancers[k], 1e-9 * *left.amplitude.nothing[k]);
        EXPECT_LT(*place(result, "bearing", 0.9).force->balancers[k],
                  1e-9 * *place(result, "bearing", 0.9).force->nothing[k]);
    }
    // The weights do all of it too: they are the same.
    EXPECT_LT(std::abs(*result.supply->planes[0].weight - first), 1e-9 * std::abs(first));
    EXPECT_LT(std::abs(*result.supply->planes[1].beside_weights[5]), 1e-9 * std::abs(second));
}

// Three planes of a rigid rotor: any of infinitely many shares does; the smallest is taken.
TEST(BalanceSupply, PlanesThatDependShareOut) {
    const model::Case scene = rigid_rotor({0.1, 0.4, 0.7});
    const BalanceResult result = answer(scene);
    for (std::size_t k = 1; k < result.speeds.size(); ++k) {
        Complex force = 0, moment = 0;
        for (const model::Imbalance &own : scene.rotor.imbalances) {
            force += std::polar(own.mr, own.phase);
            moment += std::polar(own.mr * own.z, own.phase);
        }
        for (std::size_t p = 0; p < 3; ++p) {
            ASSERT_TRUE(result.supply->planes[p].needed[k]);
            force += *result.supply->planes[p].needed[k];
            moment += *result.supply->planes[p].needed[k] * scene.rotor.planes[p].z;
        }
        EXPECT_LT(std::abs(force), 1e-9 * 2e-3);
        EXPECT_LT(std::abs(moment), 1e-9 * 2e-3);
        // Least: at right angles to what makes no force and no moment, (1, -2, 1).
        EXPECT_LT(std::abs(*result.supply->planes[0].needed[k] -
                           2.0 * *result.supply->planes[1].needed[k] +
                           *result.supply->planes[2].needed[k]),
                  1e-8 * 2e-3);
    }
}

// Balls that resist rolling on a planar rotor: K = k/W^2 - M - n m + i c/W and the imbalance of the
// disc go into the closed form of all positions in which both of two stand, and the bound of more.
TEST(BalanceSupply, FrictionLetsBallsRestAsInClosedForm) {
    RigidJeffcott rotor;
    model::Case scene = rotor.scene();
    scene.rotor.balancers = {ball_balancer(0.5, 2, 0.05, 0.1, 0.5)};
    scene.rotor.imbalances = {imbalance_at(0.5, 0.004, 0.7)};
    model::BallRow &race = row(scene.rotor.balancers.front());
    race.diameter = 0.02;
    race.rolling = 1e-5; // friction 2 * 1e-5 / 0.02
    scene.speeds = model::SpeedRange{0, 900, 10};
    const BalanceResult result = answer(scene);
    ASSERT_TRUE(result.supply);
    const auto &friction = result.supply->planes.front().friction;
    ASSERT_EQ(friction.size(), 10U);
    EXPECT_FALSE(friction.front()); // at rest
    for (std::size_t i = 1; i < friction.size(); ++i) {
        const double W = result.speeds[i];
        const Complex K(1e6 / (W * W) - rotor.mass - 2 * 0.05, rotor.c / W);
        const auto rest = closed_form::dry_rest({K, 0.05, 0.1, 1e-3, 0.004, 2});
        ASSERT_TRUE(rest && friction[i]) << W;
        // K is a difference of terms up to 10 of its size, the response good to 1e-12.
        EXPECT_NEAR(friction[i]->residual, rest->residual, 1e-9 * rest->residual) << W;
        EXPECT_NEAR(friction[i]->from.value(), rest->from, 1e-9) << W;
        EXPECT_NEAR(friction[i]->to.value(), rest->to, 1e-9) << W;
    }
    row(scene.rotor.balancers.front()).n = 3;
    const BalanceResult three = answer(scene);
    const auto &bounds = three.supply->planes.front().friction;
    ASSERT_EQ(bounds.size(), 10U);
    for (std::size_t i = 1; i < bounds.size(); ++i) {
        const double W = three.speeds[i];
        const Complex K(1e6 / (W * W) - rotor.mass - 3 * 0.05, rotor.c / W);
        const auto bound = closed_form::dry_bound({K, 0.05, 0.1, 1e-3, 0.004, 3});
        ASSERT_EQ(bound.has_value(), bounds[i].has_value()) << W;
        if (bound) {
            EXPECT_NEAR(bounds[i]->residual, *bound, 1e-9 * *bound) << W;
            EXPECT_FALSE(bounds[i]->from || bounds[i]->to);
        }
    }
    row(scene.rotor.balancers.front()).rolling = 0;
    EXPECT_TRUE(answer(scene).supply->planes.front().friction.empty());
}

/// A planar rotor with n balls against an imbalance at its disc: k - M W^2 + i c W under W^2 U.
struct Planar {
    RigidJeffcott rotor;
    double U = 2e-3;
    double ball_moment = 0.5e-3; ///< kg m, each of two
    double ball = 1e-9;          ///< kg: without a mass to speak of
    double speed = 500;

    [[nodiscard]] model::Case scene(int n = 2) const {
        model::Case scene = rotor.scene();
        scene.rotor.balancers = {ball_balancer(0.5, n, ball, ball_moment / ball, 1e-6)};
        scene.rotor.balancers[0].tilt_inertia = false;
        scene.rotor.imbalances = {imbalance_at(0.5, U, 0.3)};
        scene.speeds = model::SpeedRange{speed, speed, 1};
        return scene;
    }
    [[nodiscard]] Complex per_moment() const {
        return speed * speed / Complex(rotor.kx - rotor.mass * speed * speed, rotor.c * speed);
    }
};

TEST(BalanceSupply, BeyondCapacityTheBallsStandWithTheDeflection) {
    const Planar of;
    const BalanceResult result = answer(of.scene());
    ASSERT_TRUE(result.supply);
    EXPECT_NEAR(*result.supply->planes[0].capacity, 1e-3, 1e-15);
    EXPECT_NEAR(std::abs(*result.supply->planes[0].needed[0]), of.U, 1e-12);
    EXPECT_NEAR(std::remainder(std::arg(*result.supply->planes[0].needed[0]) - 0.3 - pi, 2 * pi), 0,
                1e-9);
    EXPECT_EQ(result.supply->with_balancers[0], Supply::saturated);
    EXPECT_TRUE(result.supply->works[0]);
    // w + A C e = l e: |A| U = |l - A C|.
    const Complex A = of.per_moment();
    const double C = 2 * of.ball_moment;
    const double left =
        A.real() * C + std::sqrt(std::norm(A) * of.U * of.U - std::pow(A.imag() * C, 2));
    EXPECT_NEAR(*place(result, "plane", 0.5).amplitude.balancers[0], left, 1e-9 * left);
    EXPECT_NEAR(*place(result, "bearing", 0).amplitude.balancers[0], left, 1e-9 * left);
    EXPECT_NEAR(*place(result, "plane", 0.5).amplitude.nothing[0], std::abs(A) * of.U, 1e-12);
    // The one weight takes away what one plane can of it.
    EXPECT_LT(*place(result, "plane", 0.5).amplitude.weights[0], 1e-9 * left);
    EXPECT_LT(*place(result, "plane", 0.5).amplitude.both[0], 1e-9 * left);
}

// The search for steady states finds the same position among its states, and that it keeps.
TEST(BalanceSupply, BeyondCapacityIsAStableState) {
    const Planar of;
    model::Case scene = of.scene();
    scene.states = model::StatesSettings{};
    const BalanceResult result = analyses::balance(scene);
    ASSERT_TRUE(result.states);
    const double left = *place(result, "plane", 0.5).amplitude.balancers[0];
    EXPECT_TRUE(std::ranges::any_of(result.states->states, [&](const results::SteadyState &state) {
        return state.kind == results::SteadyState::Kind::coincident &&
               state.stable.value_or(false) && std::abs(state.residual / left - 1) < 1e-6;
    }));
}

TEST(BalanceSupply, JustTheCapacityIsEnough) {
    Planar of;
    of.U = 2 * of.ball_moment;
    const BalanceResult result = answer(of.scene());
    EXPECT_EQ(result.supply->with_balancers[0], Supply::balanced);
    EXPECT_LT(*place(result, "plane", 0.5).amplitude.balancers[0], 1e-15);
}

TEST(BalanceSupply, BelowResonanceNothingIsSaidOfBallsBeyondTheirCapacity) {
    Planar of;
    of.speed = 200;
    const BalanceResult result = answer(of.scene());
    EXPECT_EQ(result.supply->with_balancers[0], Supply::beyond);
    EXPECT_FALSE(result.supply->works[0]);
    EXPECT_FALSE(place(result, "plane", 0.5).amplitude.balancers[0]);
    EXPECT_NEAR(std::abs(*result.supply->planes[0].needed[0]), of.U, 1e-12);
}

TEST(BalanceSupply, OneBallAlwaysMakesItsWhole) {
    Planar of;
    of.U = 0.2e-3;
    const BalanceResult result = answer(of.scene(1));
    EXPECT_EQ(result.supply->with_balancers[0], Supply::coarse);
    EXPECT_NEAR(result.supply->planes[0].least, of.ball_moment, 1e-15);
    EXPECT_FALSE(place(result, "plane", 0.5).amplitude.balancers[0]);
}

/// A uniform shaft on damped bearings with two light balancers; the imbalance is elsewhere. At its
/// speed the balanced position keeps.
model::Case flexible(double ball = 0.004) {
    model::Case scene;
    scene.name = "flexible";
    scene.rotor.shaft = uniform_shaft(1, 0.05, steel());
    scene.rotor.discs = {disc_at(0.45, 27, 0.155, 0.3)};
    scene.rotor.bearings = {isotropic_bearing(0, 2e6, 1000), isotropic_bearing(1, 2e6, 1000)};
    for (const double z : {0.2, 0.8}) {
        scene.rotor.balancers.push_back(ball_balancer(z, 2, ball, 0.05, 0.5));
        scene.rotor.balancers.back().tilt_inertia = false;
    }
    scene.rotor.imbalances = {imbalance_at(0.45, 1e-3, 0.7), imbalance_at(1, 2e-4, 2)};
    scene.rotor.probes = {{"p1", 0.1}, {"p2", 0.9, pi / 2}};
    scene.speeds = model::SpeedRange{1700, 1700, 1};
    return scene;
}

Complex sum_of(const std::vector<double> &angles, double moment) {
    Complex sum = 0;
    for (const double angle : angles)
        sum += std::polar(moment, angle);
    return sum;
}

// The equations of motion in time, solved for balls at rest, say the same; so does the response of
// the rotor with what is needed as imbalances.
TEST(BalanceSupply, FlexibleShaftAgreesWithStatesAndResponse) {
    model::Case scene = flexible();
    scene.states = model::StatesSettings{};
    const BalanceResult result = analyses::balance(scene);
    ASSERT_TRUE(result.supply && result.states);
    const auto state =
        std::ranges::find_if(result.states->states, [](const results::SteadyState &found) {
            return found.kind == results::SteadyState::Kind::balanced;
        });
    ASSERT_NE(state, result.states->states.end());
    EXPECT_EQ(result.supply->with_balancers[0], Supply::balanced);
    EXPECT_TRUE(result.supply->works[0]);
    model::Case with = scene;
    with.rotor.balancers.clear();
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex needed = *result.supply->planes[p].needed[0];
        // The states are those of a reduced rotor, good to 1e-6.
        EXPECT_LT(std::abs(sum_of(state->angles[p], 0.004 * 0.05) - needed),
                  1e-5 * std::abs(needed));
        with.rotor.imbalances.push_back(
            {"", scene.rotor.balancers[p].z, std::abs(needed), std::arg(needed)});
    }
    const results::ResponseResult response = analyses::unbalance_response(with);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(*place(result, "probe", scene.rotor.probes[i].z).amplitude.balancers[0],
                    response.probes[i].amplitude[0], 1e-9 * response.probes[i].amplitude[0]);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(*place(result, "bearing", scene.rotor.bearings[i].z).force->balancers[0],
                    response.bearings[i].force[0], 1e-9 * response.bearings[i].force[0]);
    int planes = 0;
    for (const results::ResponseNode &node : response.nodes)
        if (std::abs(node.z - 0.2) < 1e-9 || std::abs(node.z - 0.8) < 1e-9) {
            ++planes;
            EXPECT_LT(node.amplitude[0],
                      1e-9 * *place(result, "plane", node.z).amplitude.nothing[0]);
        }
    EXPECT_EQ(planes, 2);
}

// One balancer of two has too little: it stands with what is left of its plane's motion, the other
// stills its own plane. Among the steady states that is one with a plane in balance, and it keeps.
TEST(BalanceSupply, OneOfTwoBalancersBeyondItsCapacity) {
    model::Case scene = flexible();
    for (model::Balancer &balancer : scene.rotor.balancers) {
        row(balancer).mass = 1e-5; // hardly any: the answer is that of balls without
        row(balancer).radius = 10;
        row(balancer).damping = 1e-3;
    }
    scene.states = model::StatesSettings{};
    const BalanceResult result = analyses::balance(scene);
    ASSERT_TRUE(result.supply && result.states);
    ASSERT_EQ(result.supply->with_balancers[0], Supply::saturated);
    const double left = *place(result, "plane", 0.8).amplitude.balancers[0];
    EXPECT_LT(*place(result, "plane", 0.2).amplitude.balancers[0], 1e-9 * left);
    EXPECT_GT(left, 1e-6);
    EXPECT_TRUE(std::ranges::any_of(result.states->states, [&](const results::SteadyState &state) {
        return state.kind == results::SteadyState::Kind::partly_balanced &&
               state.stable.value_or(false) && state.amplitudes[0] < 1e-9 * left &&
               std::abs(state.amplitudes[1] / left - 1) < 1e-5;
    }));
}

// A motion in time ends there, and leaves at the stations what is said to be left.
TEST(BalanceSupply, MotionInTimeLeavesTheResidual) {
    model::Case scene = flexible();
    const BalanceResult result = answer(scene);
    scene.simulate.time = 6; // motions die out as exp(-2.6 t)
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex needed = *result.supply->planes[p].needed[0];
        const double apart = std::acos(std::abs(needed) / (2 * 0.004 * 0.05));
        // Off the position by 0.15 rad.
        scene.simulate.ball_angles.push_back(
            {std::arg(needed) + apart + 0.15, std::arg(needed) - apart});
    }
    const results::SimulateResult motion = analyses::simulate(scene);
    int compared = 0;
    for (const results::StationMotion &station : motion.stations)
        for (const LeftAt &left : result.supply->left)
            if (left.of == "bearing" && std::abs(station.z - left.z) < 1e-9) {
                EXPECT_NEAR(station.amplitude / *left.amplitude.balancers[0], 1, 1e-3);
                ++compared;
            }
    EXPECT_EQ(compared, 2);
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex needed = *result.supply->planes[p].needed[0];
        EXPECT_LT(std::abs(sum_of(motion.balancers[p].angles, 0.004 * 0.05) - needed),
                  1e-3 * std::abs(needed));
    }
}

// The weights are those of the command weights for the same probes and speeds.
TEST(BalanceSupply, WeightsAreThoseOfTheCommand) {
    for (const auto method : {model::WeightsMethod::least_squares, model::WeightsMethod::minimax}) {
        model::Case scene = flexible();
        scene.rotor.planes = {{"a", 0.2}, {"b", 0.8}};
        scene.rotor.planes[1].max = 2.2e-4;
        scene.rotor.planes[0].fixed = {std::polar(1e-4, 1.0)};
        scene.weights.emplace();
        scene.weights->speeds = {600, 1000, 1700};
        scene.weights->method = method;
        const BalanceResult result = answer(scene);
        const results::WeightsResult weights = analyses::correction_weights(scene);
        EXPECT_EQ(result.supply->weight_speeds, scene.weights->speeds);
        for (std::size_t p = 0; p < 2; ++p)
            // Those of least maximum are known to the root of the gap.
            EXPECT_LT(std::abs(*result.supply->planes[p].weight - weights.weights[p].weight),
                      1e-4 * std::abs(weights.weights[p].weight));
        for (const results::WeightReading &reading : weights.residual)
            if (reading.speed == 1700.0) {
                const LeftAt &left = place(result, "probe", reading.probe == "p1" ? 0.1 : 0.9);
                EXPECT_NEAR(*left.amplitude.weights[0], std::abs(reading.after),
                            1e-4 * std::abs(reading.before));
                EXPECT_NEAR(*left.amplitude.nothing[0], std::abs(reading.before),
                            1e-9 * std::abs(reading.before));
            }
    }
}

// Bearings that differ: what is needed leaves the planes without forward motion.
TEST(BalanceSupply, AnisotropicBearingsLoseTheForwardPart) {
    model::Case scene = flexible();
    scene.rotor.bearings[0].rows[0].k(1, 1) = 1.2e6;
    scene.rotor.bearings[1].rows[0].k(0, 1) = 2e5;
    scene.rotor.planes = {{"a", 0.2}, {"b", 0.8}};
    scene.rotor.balancers.clear();
    const BalanceResult result = answer(scene);
    ASSERT_TRUE(result.supply);
    EXPECT_FALSE(result.supply->planes[0].capacity);
    EXPECT_EQ(result.supply->with_balancers[0], Supply::balanced);
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex needed = *result.supply->planes[p].needed[0];
        scene.rotor.imbalances.push_back(
            {"", scene.rotor.planes[p].z, std::abs(needed), std::arg(needed)});
    }
    const results::ResponseResult response = analyses::unbalance_response(scene);
    int compared = 0;
    for (const results::ResponseNode &node : response.nodes)
        if (std::abs(node.z - 0.2) < 1e-9 || std::abs(node.z - 0.8) < 1e-9) {
            EXPECT_LT(std::abs(node.major[0] + node.minor[0]) / 2, 1e-9 * node.major[0]);
            EXPECT_NEAR(*place(result, "plane", node.z).amplitude.balancers[0], node.major[0],
                        1e-9 * node.major[0]);
            ++compared;
        }
    EXPECT_EQ(compared, 2);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(*place(result, "probe", scene.rotor.probes[i].z).amplitude.balancers[0],
                    response.probes[i].amplitude[0], 1e-9 * response.probes[i].amplitude[0]);
}

// A rotor that is not axisymmetric: the answer depends on the direction, and is still exact.
TEST(BalanceSupply, RotorThatIsNotAxisymmetric) {
    model::Case scene = flexible();
    scene.rotor.anisotropies = {{"", 0.45, 0.1, 0.4}};
    scene.rotor.planes = {{"a", 0.2}, {"b", 0.8}};
    scene.rotor.balancers.clear();
    const BalanceResult result = answer(scene);
    ASSERT_TRUE(result.supply);
    EXPECT_FALSE(result.supply->planes[0].weight);
    EXPECT_FALSE(place(result, "probe", 0.1).amplitude.weights[0]);
    for (std::size_t p = 0; p < 2; ++p) {
        const Complex needed = *result.supply->planes[p].needed[0];
        scene.rotor.imbalances.push_back(
            {"", scene.rotor.planes[p].z, std::abs(needed), std::arg(needed)});
    }
    const results::ResponseResult response = analyses::unbalance_response(scene);
    int planes = 0;
    for (const results::ResponseNode &node : response.nodes)
        if (std::abs(node.z - 0.2) < 1e-9 || std::abs(node.z - 0.8) < 1e-9) {
            EXPECT_LT(node.amplitude[0],
                      1e-8 * *place(result, "plane", node.z).amplitude.nothing[0]);
            ++planes;
        }
    EXPECT_EQ(planes, 2);
    EXPECT_NEAR(*place(result, "probe", 0.1).amplitude.balancers[0],
                response.probes[0].amplitude[0], 1e-8 * response.probes[0].amplitude[0]);
}

TEST(BalanceSupply, NeitherRotorNorBearingsTheSameIsRefusedInWords) {
    model::Case scene = flexible();
    scene.rotor.anisotropies = {{"", 0.45, 0.02, 0}};
    scene.rotor.bearings[0].rows[0].k(1, 1) = 1.9e6;
    scene.rotor.planes = {{"a", 0.2}};
    scene.rotor.balancers.clear();
    scene.speeds = model::SpeedRange{500, 500, 1};
    const BalanceResult result = answer(scene);
    EXPECT_FALSE(result.supply);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const results::Sentence &note) {
        return note.starts_with("what balancers must supply is not answered");
    }));
}

TEST(BalanceSupply, NothingToBalance) {
    model::Case scene = flexible();
    scene.rotor.imbalances.clear();
    EXPECT_FALSE(answer(scene).supply);
}

// Two equal and opposite imbalances drive the second motion of bending alone: a plane in the
// middle, its node, has nothing to do with it, and all of it stays.
TEST(BalanceSupply, PlaneAtANodeLeavesTheModeAlone) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(1, 0.04, steel());
    scene.rotor.bearings = {isotropic_bearing(0, 1e9, 1e3), isotropic_bearing(1, 1e9, 1e3)};
    scene.rotor.imbalances = {imbalance_at(0.25, 1e-4), imbalance_at(0.75, 1e-4, pi)};
    scene.rotor.planes = {{"node", 0.5}};
    scene.rotor.probes = {{"quarter", 0.25}};
    scene.speeds = model::SpeedRange{1000, 1000, 1};
    const BalanceResult result = answer(scene);
    // By symmetry the middle stands still: nothing is needed there, and nothing changes.
    EXPECT_LT(std::abs(*result.supply->planes[0].needed[0]), 1e-9 * 1e-4);
    const results::LeftMotion &left = place(result, "probe", 0.25).amplitude;
    EXPECT_NEAR(*left.balancers[0], *left.nothing[0], 1e-9 * *left.nothing[0]);
}

// Balancers beside planes of their own, and one that stands in none.
TEST(BalanceSupply, BalancersOutsideThePlanes) {
    model::Case scene = flexible();
    scene.rotor.planes = {{"a", 0.2}, {"b", 0.6}};
    const BalanceResult result = answer(scene);
    EXPECT_TRUE(result.supply->planes[0].capacity);
    EXPECT_FALSE(result.supply->planes[1].capacity);
    EXPECT_TRUE(result.supply->planes[0].needed[0]);
    EXPECT_FALSE(result.supply->planes[1].needed[0]);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const results::Sentence &note) {
        return note.find("stands in none of the planes") != std::string::npos;
    }));
}

// At a resonance without damping there is no motion, and no number.
TEST(BalanceSupply, UndampedResonanceHasNoNumbers) {
    Planar of;
    of.rotor.c = 0;
    of.speed = of.rotor.natural();
    model::Case scene = of.scene();
    const BalanceResult result = answer(scene);
    EXPECT_EQ(result.supply->with_balancers[0], Supply::resonance);
    EXPECT_FALSE(result.supply->planes[0].needed[0]);
    EXPECT_FALSE(place(result, "plane", 0.5).amplitude.nothing[0]);
}

/// Two balancers in the plane of the disc, of these numbers of balls.
model::Case two_in_one_plane(const Planar &of, int first, int second) {
    model::Case scene = of.scene(first);
    model::Balancer other = of.scene(second).rotor.balancers[0];
    scene.rotor.balancers.push_back(other);
    return scene;
}

// Two balancers in one plane are one of all their balls: none has more to do than it can while the
// other could do more, and together they reach as far as both.
TEST(BalanceSupply, BalancersInOnePlaneShareByCapacity) {
    Planar of;
    of.U = 1.9e-3;
    const BalanceResult result = answer(two_in_one_plane(of, 1, 3));
    ASSERT_TRUE(result.supply);
    ASSERT_EQ(result.supply->planes.size(), 2U);
    EXPECT_EQ(result.supply->with_balancers[0], Supply::balanced);
    Complex sum = 0;
    for (const results::PlaneSupply &plane : result.supply->planes) {
        ASSERT_TRUE(plane.needed[0]);
        sum += *plane.needed[0];
        EXPECT_NEAR(std::abs(*plane.needed[0]) / *plane.capacity, of.U / (4 * of.ball_moment),
                    1e-12);
    }
    EXPECT_NEAR(*result.supply->planes[0].capacity, of.ball_moment, 1e-12); // in their order
    EXPECT_LT(std::abs(sum + std::polar(of.U, 0.3)), 1e-12);
    // More than there is: all of it, at one angle.
    of.U = 3e-3;
    const BalanceResult beyond = answer(two_in_one_plane(of, 1, 3));
    const BalanceResult one = answer(of.scene(4));
    EXPECT_EQ(beyond.supply->with_balancers[0], Supply::saturated);
    EXPECT_NEAR(*place(beyond, "bearing", 0).amplitude.balancers[0],
                *place(one, "bearing", 0).amplitude.balancers[0], 1e-12);
}

// One ball always makes its whole; two of them, each a balancer, any sum up to both.
TEST(BalanceSupply, TwoBallsInOnePlaneAreNotTooCoarse) {
    Planar of;
    of.U = 0.2e-3;
    EXPECT_EQ(answer(two_in_one_plane(of, 1, 1)).supply->with_balancers[0], Supply::balanced);
    EXPECT_EQ(answer(two_in_one_plane(of, 1, 3)).supply->with_balancers[0], Supply::balanced);
    EXPECT_EQ(answer(of.scene(1)).supply->with_balancers[0], Supply::coarse);
}

// Why by capacity: equal balls of one plane see one motion, W = A (U + sum of them), and in the
// film of their race go as angle' = Im(W exp(-i angle)). Nothing tells them apart but where they
// start, so that over starts without a preference the mean of each is the same, and the sum of all
// of them is what is needed every time.
TEST(BalanceSupply, EqualBallsShareByCapacityInTheMean) {
    constexpr int first = 2, all = 7; // balls of one balancer and of both
    const Complex imbalance = std::polar(3.0, 0.7);
    unsigned state = 12345; // of a linear congruential generator
    const auto start = [&state] {
        state = 1664525U * state + 1013904223U;
        return 2 * pi * (state >> 8U) / double(1U << 24U);
    };
    constexpr int runs = 4000;
    Complex mean = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<double> angles(all);
        for (double &angle : angles)
            angle = start();
        Complex W = 1;
        for (int step = 0; step < 4000 && std::abs(W) > 1e-7; ++step) {
            W = -imbalance; // above resonance the plane moves against what is on it
            for (const double angle : angles)
                W -= std::polar(1.0, angle);
            for (double &angle : angles)
                angle += 0.05 * (W * std::polar(1.0, -angle)).imag();
        }
        for (int i = 0; i < first; ++i)
            mean += std::polar(1.0, angles[static_cast<std::size_t>(i)]) / double(runs);
    }
    // A sum of two unit vectors scatters by less than two, its mean by that over the root of runs.
    EXPECT_LT(std::abs(mean + imbalance * double(first) / double(all)), 4 * std::sqrt(2.0 / runs));
}

// Three planes of a rigid rotor, one with little: the others do more, as long as all can be done.
TEST(BalanceSupply, PlanesThatDependSpareTheSmallOne) {
    model::Case scene = rigid_rotor({});
    for (const double z : {0.1, 0.4, 0.7}) {
        scene.rotor.balancers.push_back(ball_balancer(z, 2, 1e-9, 1, 1e-6));
        scene.rotor.balancers.back().tilt_inertia = false;
    }
    const auto capacities = [&](std::vector<double> each) {
        for (std::size_t i = 0; i < 3; ++i)
            row(scene.rotor.balancers[i]).radius = each[i] / 2e-9;
        scene.speeds = model::SpeedRange{1200, 1200, 1};
        return answer(scene);
    };
    // Two planes need some 1.2e-3 and 0.9e-3 kg m; the middle one cannot help much.
    const BalanceResult small = capacities({1.6e-3, 1e-5, 1.6e-3});
    ASSERT_TRUE(small.supply->works[0]);
    EXPECT_EQ(small.supply->with_balancers[0], Supply::balanced);
    for (const results::PlaneSupply &plane : small.supply->planes)
        EXPECT_LE(std::abs(*plane.needed[0]), *plane.capacity * (1 + 1e-9));
    // An end with too little for its half is helped by the middle.
    const BalanceResult helped = capacities({1e-3, 2e-3, 1.6e-3});
    EXPECT_EQ(helped.supply->with_balancers[0], Supply::balanced);
    for (const results::PlaneSupply &plane : helped.supply->planes)
        EXPECT_LE(std::abs(*plane.needed[0]), *plane.capacity * (1 + 1e-9));
    const BalanceResult beyond = capacities({1e-4, 1e-4, 1e-4});
    EXPECT_EQ(beyond.supply->with_balancers[0], Supply::saturated);
}

// Phases against the spin: the same answer, its moments turned the other way.
TEST(BalanceSupply, PhasesLagWhereTheCaseSaysSo) {
    model::Case scene = flexible();
    scene.rotor.planes = {{"a", 0.2}, {"b", 0.8}};
    scene.rotor.planes[0].fixed = {std::polar(1e-4, 1.0)};
    scene.weights.emplace();
    scene.weights->speeds = {600, 1000, 1700};
    const BalanceResult lead = answer(scene);
    scene.weights->lag = true;
    scene.rotor.planes[0].fixed = {std::polar(1e-4, -1.0)};
    const BalanceResult lag = answer(scene);
    EXPECT_FALSE(lead.supply->lag);
    EXPECT_TRUE(lag.supply->lag);
    for (std::size_t p = 0; p < 2; ++p) {
        const results::PlaneSupply &own = lag.supply->planes[p];
        const results::PlaneSupply &other = lead.supply->planes[p];
        EXPECT_EQ(*own.needed[0], std::conj(*other.needed[0]));
        EXPECT_EQ(*own.beside_weights[0], std::conj(*other.beside_weights[0]));
        EXPECT_EQ(*own.weight, std::conj(*other.weight));
    }
    EXPECT_EQ(*place(lag, "probe", 0.1).amplitude.both[0],
              *place(lead, "probe", 0.1).amplitude.both[0]);
    // As the command weights has them.
    const results::WeightsResult weights = analyses::correction_weights(scene);
    for (std::size_t p = 0; p < 2; ++p)
        EXPECT_LT(std::abs(*lag.supply->planes[p].weight - weights.weights[p].weight),
                  1e-9 * std::abs(weights.weights[p].weight));
}

// What rounding leaves is nothing, and has no direction; what lies along an axis lies on it.
TEST(BalanceSupply, RoundingHasNoPhase) {
    model::Case scene = rigid_rotor({0.35, 0.8});
    scene.rotor.imbalances = {imbalance_at(0.35, 2e-3)};
    scene.speeds = model::SpeedRange{1000, 1200, 3};
    const BalanceResult result = answer(scene);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(std::arg(*result.supply->planes[0].needed[k]), pi);
        EXPECT_EQ(*result.supply->planes[1].needed[k], 0.0);
    }
    EXPECT_EQ(std::arg(*result.supply->planes[0].weight), pi);
    EXPECT_EQ(*result.supply->planes[1].weight, 0.0);
    // The same at all speeds: none of them is the one at which most is needed.
    EXPECT_TRUE(std::ranges::any_of(result.findings, [](const results::Sentence &finding) {
        return finding.find("the same at all these speeds") != std::string::npos;
    }));
    EXPECT_TRUE(std::ranges::none_of(result.findings, [](const results::Sentence &finding) {
        return finding.find("needs at most") != std::string::npos;
    }));
}

// A speed of the weights at which there is no motion is not left out without a word.
TEST(BalanceSupply, WeightSpeedAtAResonanceIsNamed) {
    Planar of;
    of.rotor.c = 0;
    model::Case scene = of.scene();
    scene.weights.emplace();
    scene.weights->speeds = {of.rotor.natural(), 500};
    const BalanceResult result = answer(scene);
    EXPECT_EQ(result.supply->weight_speeds, std::vector<double>{500});
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const results::Sentence &note) {
        return note.find("those for the other speeds alone") != std::string::npos &&
               note.weight() == model::Weight::warning;
    }));
}

} // namespace
} // namespace whirl::tests::supply

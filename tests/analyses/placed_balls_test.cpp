// The balanced position where imbalances stand anywhere, and motions about it: against rotors of
// which the same is known otherwise, and against motions in time.

#include "analyses/balance.h"
#include "analyses/placed_balls.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "input/case_file.h"
#include "results/simulate.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::tests::placed {
namespace {

using Complex = std::complex<double>;

const analyses::CaseWith no_entries = [](const std::vector<std::string> &) {
    return model::Case{};
};

/// A rigid body of 60 kg on two damped supports with two and three balls in two planes.
model::Case rigid_rotor() {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(0.9, 0.2, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {isotropic_bearing(0, 2e6, 3000), isotropic_bearing(0.9, 3e6, 2500)};
    scene.rotor.balancers = {ball_balancer(0.1, 2, 0.05, 0.1, 0.5),
                             ball_balancer(0.7, 3, 0.03, 0.12, 0.4)};
    scene.speeds = model::SpeedRange{150, 1200, 22};
    return scene;
}

/// The same imbalances, of which every balancer is there for its own: on a rigid shaft two planes
/// share them by moments, at all speeds alike.
model::Case split(model::Case scene) {
    model::Rotor &rotor = scene.rotor;
    const double a = rotor.balancers[0].z;
    const double b = rotor.balancers[1].z;
    Complex first;
    Complex second;
    for (const model::Imbalance &one : rotor.imbalances) {
        const Complex u = std::polar(one.mr, one.phase);
        first += u * (b - one.z) / (b - a);
        second += u * (one.z - a) / (b - a);
    }
    rotor.imbalances.clear();
    for (const auto &[balancer, u] :
         {std::pair(&rotor.balancers[0], first), std::pair(&rotor.balancers[1], second)}) {
        balancer->imbalance = std::abs(u);
        balancer->imbalance_phase = std::arg(u);
    }
    return scene;
}

model::Case with_imbalances(model::Case scene) {
    scene.rotor.imbalances = {imbalance_at(0.35, 6e-3, 0.4), imbalance_at(0.8, 3e-3, -2)};
    return scene;
}

void expect_same(const std::vector<results::Interval> &a, const std::vector<results::Interval> &b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        // Ends of both searches are known to some 1e-10 of the speed.
        EXPECT_NEAR(a[i].from, b[i].from, 1e-8 * b[i].from);
        EXPECT_NEAR(a[i].to, b[i].to, 1e-8 * b[i].to);
    }
}

TEST(PlacedBalls, RigidRotorIsThatWhoseBalancersHaveTheImbalancesThemselves) {
    // The other way: linear elements of balls at fixed angles, unstable bands by following roots.
    const model::Case scene = with_imbalances(rigid_rotor());
    const results::StabilityResult found = analyses::stability(scene, no_entries);
    const results::StabilityResult known = analyses::stability(split(scene), no_entries);
    EXPECT_EQ(found.all_imbalances, std::optional(true));
    EXPECT_EQ(known.all_imbalances, std::optional(false));
    EXPECT_GT(known.unstable.size(), 0);
    expect_same(found.unstable, known.unstable);
    EXPECT_TRUE(found.no_position.empty());
    EXPECT_EQ(found.neutral_pairs, known.neutral_pairs);
    ASSERT_EQ(found.growth.size(), known.growth.size());
    for (std::size_t i = 0; i < known.growth.size(); ++i) {
        EXPECT_NEAR(found.growth[i], known.growth[i], 1e-7 * known.speeds[i]); // of both solvers
        EXPECT_EQ(found.verdict[i], known.verdict[i]) << known.speeds[i];
    }
    ASSERT_EQ(found.ends.size(), known.ends.size());
    for (std::size_t i = 0; i < known.ends.size(); ++i) {
        EXPECT_NEAR(found.ends[i].speed, known.ends[i].speed, 1e-8 * known.ends[i].speed);
        EXPECT_EQ(found.ends[i].kind, known.ends[i].kind);
        EXPECT_EQ(found.ends[i].growing_below, known.ends[i].growing_below);
        EXPECT_EQ(found.ends[i].growing_above, known.ends[i].growing_above);
        ASSERT_TRUE(found.ends[i].frequency_rotating && known.ends[i].frequency_rotating);
        EXPECT_NEAR(*found.ends[i].frequency_rotating, *known.ends[i].frequency_rotating,
                    1e-6 * known.ends[i].speed);
    }
    const auto positions = [](const model::Case &of) {
        return analyses::balance(of).balanced_position.value();
    };
    const results::BalancedPosition real = positions(scene);
    EXPECT_TRUE(real.all_imbalances);
    expect_same(real.bands, positions(split(scene)).bands);
}

// Growth falls faster than the speed: next to rest its sign drowns in rounding, and is not taken
// for a decay.
TEST(PlacedBalls, BandsBeginAtRestWhereTheMotionGrowsFromThereOn) {
    model::Case scene = with_imbalances(rigid_rotor());
    scene.speeds->from = 0;
    const results::StabilityResult found = analyses::stability(scene, no_entries);
    const results::StabilityResult known = analyses::stability(split(scene), no_entries);
    ASSERT_FALSE(known.unstable.empty());
    EXPECT_EQ(known.unstable.front().from, 0);
    expect_same(found.unstable, known.unstable);
    EXPECT_EQ(found.ends.size(), known.ends.size());
}

TEST(PlacedBalls, TwoBallsInTwoPlanesHaveTheAnglesOfTheClosedForm) {
    model::Case scene = with_imbalances(rigid_rotor());
    tests::row(scene.rotor.balancers[1]).n = 2;
    const model::Case other = split(scene);
    std::vector<results::Sentence> notes;
    const auto position = analyses::placed_by_all_imbalances(scene, 1, {200, 900}, notes);
    ASSERT_TRUE(position);
    for (const double speed : {200.0, 555.0, 900.0}) {
        const auto found = position->at(speed);
        ASSERT_TRUE(found);
        for (int i : {0, 1}) {
            const model::Balancer &b = other.rotor.balancers[i];
            const double half = // two unit vectors at +-half about the direction against it
                std::acos(b.imbalance / (2 * tests::row(b).mass * tests::row(b).radius));
            for (const double angle : found->state.angles[i])
                EXPECT_NEAR(std::abs(std::remainder(angle - b.imbalance_phase - std::numbers::pi,
                                                    2 * std::numbers::pi)),
                            half, 1e-9);
        }
    }
}

/// A flexible shaft with imbalances beside and between two balancers.
model::Case flexible_rotor() {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/shaft_two_balancers");
    scene.states.reset();
    for (model::Balancer &balancer : scene.rotor.balancers)
        balancer.tilt_inertia = false; // as balancers without mass have none
    return scene;
}

TEST(PlacedBalls, FlexibleShaftHasThePositionThatSuppliesWhatIsNeeded) {
    // What is needed comes from the forced motion of the whole rotor.
    const model::Case scene = flexible_rotor();
    const results::BalanceResult result = analyses::balance(scene);
    std::vector<results::Sentence> notes;
    const auto position =
        analyses::placed_by_all_imbalances(scene, scene.rotor.shaft.order, result.speeds, notes);
    ASSERT_TRUE(position);
    int compared = 0;
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        const auto found = position->at(result.speeds[k]);
        for (int p : {0, 1}) {
            const auto &plane = result.supply->planes[p];
            if (!plane.needed[k])
                continue;
            const double asked = std::abs(*plane.needed[k]) / *plane.capacity;
            if (asked > 1 + 1e-6)
                EXPECT_FALSE(found) << result.speeds[k];
            if (!found)
                continue;
            const model::BallRow &row = tests::row(scene.rotor.balancers[p]);
            Complex sum;
            for (const double angle : found->state.angles[p])
                sum += std::polar(row.mass * row.radius, angle);
            // Of the reduction, which is to be good to 1e-6.
            EXPECT_LT(std::abs(sum - *plane.needed[k]), 1e-5 * *plane.capacity);
            ++compared;
        }
    }
    EXPECT_GT(compared, 40);
    // Where a position ends some plane needs just its capacity.
    ASSERT_TRUE(result.balanced_position);
    int limits = 0;
    for (const results::Interval &gone : result.balanced_position->missing)
        for (const double speed : {gone.from, gone.to}) {
            if (speed == scene.speeds->from || speed == scene.speeds->to)
                continue;
            model::Case there = scene;
            there.speeds = model::SpeedRange{speed, speed, 1};
            there.balance.balanced_position = false;
            const results::BalanceResult at = analyses::balance(there);
            double most = 0;
            for (const auto &plane : at.supply->planes)
                most = std::max(most, std::abs(*plane.needed[0]) / *plane.capacity);
            EXPECT_NEAR(most, 1, 1e-5);
            ++limits;
        }
    EXPECT_GT(limits, 0);
}

/// How far the balls are at the end of a motion in time that began next to the position, rad, over
/// how far they were at first.
double left_of_a_push(model::Case scene, double speed, double time) {
    constexpr double push = 0.02;
    std::vector<results::Sentence> notes;
    const auto position =
        analyses::placed_by_all_imbalances(scene, scene.rotor.shaft.order, {speed}, notes);
    const std::vector<std::vector<double>> angles = position->at(speed)->state.angles;
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = time;
    scene.simulate.ball_angles = angles;
    scene.simulate.ball_angles[0][0] += push;
    const results::SimulateResult motion = analyses::simulate(scene);
    double most = 0;
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t k = 0; k < angles[i].size(); ++k)
            most =
                std::max(most, std::abs(std::remainder(motion.balancers[i].angles[k] - angles[i][k],
                                                       2 * std::numbers::pi)));
    return most / push;
}

TEST(PlacedBalls, MotionsInTimeReturnWhereItIsStableAndLeaveWhereItIsNot) {
    const model::Case scene = flexible_rotor();
    const results::StabilityResult known = analyses::stability(scene, no_entries);
    ASSERT_GT(known.speeds.size(), 1);
    int stable = 0;
    int unstable = 0;
    for (std::size_t k = 0; k < known.speeds.size(); k += 4) {
        const double growth = known.growth[k];
        if (std::isnan(growth) || std::abs(growth) < 1.5)
            continue;
        const double left = left_of_a_push(scene, known.speeds[k], 5 / std::abs(growth));
        if (growth < 0)
            EXPECT_LT(left, 0.2) << known.speeds[k]; // exp(-5), and what a push begins with
        else
            EXPECT_GT(left, 2) << known.speeds[k];
        ++(growth < 0 ? stable : unstable);
    }
    EXPECT_GT(stable, 1);
    EXPECT_GT(unstable, 1);
}

/// Roots of two balls in their balanced position at angles phi and -phi, without damping: of
/// M x'' + G x' + K x = 0 in rotating axes, x the two deflections of the plane and the turning of
/// each ball along its race, from Newton's equations of a point mass and two balls.
/// @param mass    of everything, kg;  @param moment  m R of a ball, kg m
Eigen::VectorXcd undamped_roots(double mass, double k, double moment, double radius, double phi,
                                double speed) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d G = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
    const double squared = speed * speed;
    M.diagonal() << mass, mass, moment * radius, moment * radius;
    G(1, 0) = 2 * speed * mass;
    G(0, 1) = -G(1, 0);
    K(0, 0) = K(1, 1) = k - mass * squared;
    for (const int ball : {2, 3}) {
        const double angle = ball == 2 ? phi : -phi;
        const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
        const Eigen::Vector2d along(-std::sin(angle), std::cos(angle));
        M.block<2, 1>(0, ball) = moment * along;
        G.block<2, 1>(0, ball) = -2 * speed * moment * out;
        K.block<2, 1>(0, ball) = -squared * moment * along;
        M.block<1, 2>(ball, 0) = M.block<2, 1>(0, ball).transpose();
        G.block<1, 2>(ball, 0) = -G.block<2, 1>(0, ball).transpose();
        K.block<1, 2>(ball, 0) = K.block<2, 1>(0, ball).transpose();
    }
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Zero();
    A.topRightCorner<4, 4>().setIdentity();
    A.bottomLeftCorner<4, 4>() = -M.inverse() * K;
    A.bottomRightCorner<4, 4>() = -M.inverse() * G;
    return A.eigenvalues();
}

TEST(PlacedBalls, WithoutDampingABandEndsWhereTwoRootsMeet) {
    // All other roots stay on the imaginary axis: which two meet there says the frequency.
    RigidJeffcott rotor;
    rotor.c = 0;
    model::Case scene = rotor.scene();
    const double moment = 0.05 * 0.1;
    const double imbalance = 0.004;
    scene.rotor.balancers = {ball_balancer(0.5, 2, 0.05, 0.1, 0)};
    scene.rotor.imbalances = {imbalance_at(0.5, imbalance, 0)};
    scene.speeds = model::SpeedRange{150, 900, 31};
    const auto found = analyses::stability(scene, no_entries);
    ASSERT_EQ(found.ends.size(), 1U);
    const results::StabilityEnd &end = found.ends.front();
    EXPECT_EQ(end.kind, results::EndKind::pair);
    EXPECT_EQ(end.growing_below, 2);
    EXPECT_EQ(end.growing_above, 0);
    const double phi = std::acos(-imbalance / (2 * moment));
    const auto fastest = [&](double speed) {
        const Eigen::VectorXcd roots =
            undamped_roots(rotor.mass + 2 * 0.05, rotor.kx, moment, 0.1, phi, speed);
        return *std::ranges::max_element(roots, {}, [](Complex root) { return root.real(); });
    };
    // What grows does so with the square root of the distance to the end.
    constexpr double beside = 1e-6;
    const Complex growing = fastest(end.speed * (1 - beside));
    EXPECT_GT(growing.real(), 1e-2);
    EXPECT_LT(fastest(end.speed * (1 + beside)).real(), 1e-5);
    ASSERT_TRUE(end.frequency_rotating);
    EXPECT_NEAR(*end.frequency_rotating, std::abs(growing.imag()), 1e-4 * *end.frequency_rotating);
}

TEST(PlacedBalls, SaysWhereItIsNotAnswered) {
    model::Case scene = with_imbalances(rigid_rotor());
    scene.rotor.bearings[0].rows[0].k(0, 0) *= 1.5;
    const results::StabilityResult result = analyses::stability(scene, no_entries);
    EXPECT_EQ(result.all_imbalances, std::optional(false));
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const auto &note) {
        return note.text().find("imbalance of their own balancer") != std::string::npos &&
               note.text().find("bearings that are the same in x and y") != std::string::npos;
    }));
}

} // namespace
} // namespace whirl::tests::placed

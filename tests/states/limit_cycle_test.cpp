// Motions that repeat themselves in the rotor: against the steady whirl of a ball that stalled,
// which is known in closed form, and against properties of every flow.

#include "linalg/dense/general_eigen.h"
#include "simulation/equations.h"
#include "states/limit_cycle.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

namespace whirl::states {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// A planar rotor of a point mass with balls in its race, m R = 0.005 kg m each.
struct Rotor {
    tests::RigidJeffcott jeffcott;
    int n = 1;
    double ball = 0.05;  ///< kg
    double radius = 0.1; ///< m
    double drag = 0.5;   ///< N s/m
    double imbalance = 0;
    double speed = 500; ///< rad/s

    [[nodiscard]] model::Case scene() const {
        model::Case scene = jeffcott.scene();
        scene.name = "jeffcott";
        scene.rotor.balancers = {tests::ball_balancer(0.5, n, ball, radius, drag, 0)};
        if (imbalance > 0)
            scene.rotor.imbalances = {tests::imbalance_at(0.5, imbalance, 0)};
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 1;
        return scene;
    }
    [[nodiscard]] double mass() const { return jeffcott.mass + n * ball; }
    [[nodiscard]] double moment() const { return ball * radius; }
};

LimitCycles cycles_of(const Rotor &rotor) {
    const simulation::MotionScene motion = simulation::motion_scene(rotor.scene());
    return {motion.parts, motion.moment, simulation::OdeMethod::explicit_high_order};
}

/// A ball that whirls slower than the rotor, next to its critical speed: the drag of the race
/// against the power that the supports take,
///     (k - M w^2 + i c w) a = m R w^2,  drag R^2 (Omega - w) = -m R w^2 Im a.
struct Stalled {
    double whirl = 0; ///< rad/s
    Complex deflection;

    /// @param from, to  between which the whirl is, rad/s
    Stalled(const Rotor &rotor, double from, double to) {
        const auto deflected = [&rotor](double w) {
            return rotor.moment() * w * w /
                   Complex(rotor.jeffcott.kx - rotor.mass() * w * w, rotor.jeffcott.c * w);
        };
        const auto torque = [&](double w) {
            return rotor.drag * rotor.radius * rotor.radius * (rotor.speed - w) +
                   rotor.moment() * w * w * deflected(w).imag();
        };
        std::uintmax_t steps = 100;
        const auto [low, high] = boost::math::tools::toms748_solve(
            torque, from, to, boost::math::tools::eps_tolerance<double>(50), steps);
        whirl = (low + high) / 2;
        deflection = deflected(whirl);
    }

    /// Exponents of small motions, in axes that turn with the ball: x = (Re u, Im u, angle).
    [[nodiscard]] Eigen::VectorXcd exponents(const Rotor &rotor) const {
        const double m = rotor.mass();
        const double c = rotor.jeffcott.c;
        const double w = whirl;
        const double mR = rotor.moment();
        Eigen::Matrix3d M;
        M << m, 0, 0, 0, m, mR, 0, mR, mR * rotor.radius;
        Eigen::Matrix3d C;
        C << c, -2 * w * m, -2 * w * mR, 2 * w * m, c, 0, 2 * w * mR, 0,
            rotor.drag * rotor.radius * rotor.radius;
        Eigen::Matrix3d K;
        const double k = rotor.jeffcott.kx - m * w * w;
        K << k, -c * w, 0, c * w, k, -w * w * mR, 0, -w * w * mR, mR * w * w * deflection.real();
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
        A.topRightCorner(3, 3).setIdentity();
        A.bottomLeftCorner(3, 3) = -M.inverse() * K;
        A.bottomRightCorner(3, 3) = -M.inverse() * C;
        return linalg::general_eigenvalues(A);
    }
};

/// All at (deflection, velocity) of the reduced rotor whose plane is deflected as asked.
Eigen::VectorXd start_at(const LimitCycles &cycles, Complex deflection, Complex velocity,
                         const std::vector<double> &angles, double rate) {
    const reduction::Row &row = cycles.parts().planes.front().w;
    const Eigen::Index r = row.size();
    const Eigen::Index n = 2 * r + std::ssize(angles);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(2 * n);
    const Eigen::VectorXd unit = row / row.squaredNorm();
    out.segment(0, r) = deflection.real() * unit;
    out.segment(r, r) = deflection.imag() * unit;
    out.segment(n, r) = velocity.real() * unit;
    out.segment(n + r, r) = velocity.imag() * unit;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        out(2 * r + static_cast<Eigen::Index>(i)) = angles[i];
        out(n + 2 * r + static_cast<Eigen::Index>(i)) = rate;
    }
    return out;
}

/// A cycle against a ball that stalled in closed form.
void expect_cycle_is(const Stalled &stalled, const Rotor &rotor) {
    const LimitCycles cycles = cycles_of(rotor);
    const auto cycle = cycles.next_to(start_at(cycles, 0.99 * stalled.deflection,
                                               Complex(0, stalled.whirl) * stalled.deflection,
                                               {0.0}, 0.999 * (stalled.whirl - rotor.speed)),
                                      rotor.speed);
    ASSERT_TRUE(cycle);
    EXPECT_EQ(cycle->turns, std::vector<int>{-1});
    // The integrator's error, 1e-11 of the sizes of the motion a step, over some ten steps.
    EXPECT_NEAR(cycle->period, 2 * pi / (rotor.speed - stalled.whirl), 1e-8 * cycle->period);
    const reduction::Row &row = cycles.parts().planes.front().w;
    int states = 0;
    cycles.follow(cycle->start, cycle->speed, cycle->period, 12,
                  [&](double, const Eigen::VectorXd &state) {
                      const double w = std::hypot(state.head(row.size()).dot(row),
                                                  state.segment(row.size(), row.size()).dot(row));
                      EXPECT_NEAR(w, std::abs(stalled.deflection), 1e-8 * w);
                      ++states;
                  });
    EXPECT_EQ(states, 13);
    // The rotor's slopes add multipliers of their own; those of the plane are among all. Axes that
    // turn with the ball come back to those of the rotor a whole turn later, after a period.
    int compared = 0;
    double growth = -HUGE_VAL;
    for (const Complex &exponent : stalled.exponents(rotor)) {
        if (std::abs(exponent) < 1e-6 * stalled.whirl)
            continue; // along the cycle
        growth = std::max(growth, exponent.real());
        const Complex multiplier = std::exp(exponent * cycle->period);
        const double apart = (cycle->multipliers.array() - multiplier).abs().minCoeff();
        EXPECT_LT(apart, 1e-5 * std::max(1.0, std::abs(multiplier))); // central differences: 1e-6
        ++compared;
    }
    EXPECT_EQ(compared, 5);
    EXPECT_LT(cycle->multiplier_error, 1e-5);
    EXPECT_EQ(cycle->stable(), growth < 0);
    if (growth > 0)
        EXPECT_NEAR(cycle->growth(), growth, 1e-5 / cycle->period);
}

TEST(LimitCycles, ABallThatStalledWhirlsAsInClosedForm) {
    // Below the resonance (316 rad/s is past its peak) the power that the supports take grows with
    // the whirl speed, above it falls: the one stays, the other does not.
    const Rotor rotor;
    const Stalled below(rotor, 100, 316);
    const Stalled above(rotor, 316, 400);
    EXPECT_LT(below.exponents(rotor).real().maxCoeff(), 1e-6 * rotor.speed);
    EXPECT_GT(above.exponents(rotor).real().maxCoeff(), 1);
    expect_cycle_is(below, rotor);
    expect_cycle_is(above, rotor);
}

/// Speed of the rotor at which a ball whirls at w, by the torque about its race.
double speed_of(const Rotor &rotor, double w) {
    const Complex a = rotor.moment() * w * w /
                      Complex(rotor.jeffcott.kx - rotor.mass() * w * w, rotor.jeffcott.c * w);
    return w - rotor.moment() * w * w * a.imag() / (rotor.drag * rotor.radius * rotor.radius);
}

TEST(LimitCycles, ABranchTurnsWhereItDoesInClosedForm) {
    // The speed has a maximum over the whirl speed next to the resonance: the ball breaks away.
    // Further up a minimum, below which no ball whirls there. Both are folds.
    const Rotor rotor;
    const auto extreme = [&](double from, double to, double sign) {
        return boost::math::tools::brent_find_minima(
                   [&](double w) { return sign * speed_of(rotor, w); }, from, to, 50)
            .first;
    };
    const double highest = extreme(290, 330, -1);
    const double lowest = extreme(highest, 450, 1);
    const LimitCycles cycles = cycles_of(rotor);
    const Stalled below(rotor, 100, 316);
    const auto cycle = cycles.next_to(start_at(cycles, 0.99 * below.deflection,
                                               Complex(0, below.whirl) * below.deflection, {0.0},
                                               0.999 * (below.whirl - rotor.speed)),
                                      rotor.speed);
    ASSERT_TRUE(cycle);
    const double from = 380;
    const double to = 640;
    const CycleBranch branch = cycles.branch(*cycle, from, to, 20);
    std::vector<double> folds;
    for (const BranchPoint &point : branch.points) {
        const double whirl = point.cycle.speed - 2 * pi / point.cycle.period;
        EXPECT_NEAR(point.cycle.speed, speed_of(rotor, whirl), 1e-7 * point.cycle.speed);
        if (point.kind == BranchPoint::Kind::fold)
            folds.push_back(point.cycle.speed);
    }
    ASSERT_EQ(folds.size(), 2U);
    // Next to an extreme the speed changes with the square of what the place is wrong by.
    EXPECT_NEAR(folds[0], speed_of(rotor, highest), 1e-7 * folds[0]);
    EXPECT_NEAR(folds[1], speed_of(rotor, lowest), 1e-7 * folds[1]);
    EXPECT_EQ(branch.first, CycleBranch::End::range);
    EXPECT_EQ(branch.last, CycleBranch::End::range);
    EXPECT_EQ(branch.points.front().cycle.speed, from);
    EXPECT_EQ(branch.points.back().cycle.speed, to);
    EXPECT_EQ(branch.points.front().cycle.stable(), true);
}

} // namespace
} // namespace whirl::states

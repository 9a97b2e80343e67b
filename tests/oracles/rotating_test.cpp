// State matrix in rotating axes, Floquet multipliers and pendulums against closed forms.

#include "oracles/ball_motion.h"
#include "oracles/floquet.h"
#include "oracles/pendulums.h"
#include "oracles/rotating_state.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl::oracles;

CaseRotor read(const std::string &name, const std::vector<std::string> &settings = {}) {
    return read_case(std::string(WHIRL_ROOT "/cases/") + name + "/case.toml", settings);
}

/// Nearest eigenvalue.
double distance(const std::vector<Complex> &all, const Complex &wanted) {
    Real out = 1e30L;
    for (const Complex &lambda : all)
        out = std::min(out, std::abs(lambda - wanted));
    return static_cast<double>(out);
}

/// Mass on a damped spring: roots of the fixed frame, turned by the spin.
TEST(RotatingState, turns_the_frequencies_of_a_round_rotor_by_the_spin) {
    RigidRotor body;
    body.mass = 2;
    body.A = 1;
    body.C = 0.4L;
    body.k0 = 50;
    body.k2 = 9;
    body.c0 = 0.6L;
    const Real speed = 4;
    const auto found = rotating_body(body).eigenvalues(speed);
    const Complex translation(-0.15L, std::sqrt(25 - 0.15L * 0.15L));
    EXPECT_LT(distance(found, translation - Complex(0, speed)), 1e-15);
    EXPECT_LT(distance(found, std::conj(translation) - Complex(0, speed)), 1e-15);
    const Real tilt = (0.4L * speed + std::sqrt(0.16L * speed * speed + 36)) / 2;
    EXPECT_LT(distance(found, Complex(0, tilt - speed)), 1e-15);
}

TEST(RotatingState, agrees_with_the_closed_form_of_the_anisotropic_rotor) {
    const RigidRotor body = bare_rotor(read("anisotropic_rotor"));
    const auto bands = growing_bands(rotating_body(body), 0.01L, 6, 120, 0);
    const auto closed = AnisotropicRotor(body).unstable();
    ASSERT_EQ(bands.size(), 1U);
    EXPECT_NEAR(static_cast<double>(bands[0].first / closed[0]), 1, 1e-15);
    EXPECT_NEAR(static_cast<double>(bands[0].second / closed[1]), 1, 1e-15);
    EXPECT_NEAR(static_cast<double>(closed[0]), 2.381264, 5e-7); // printed in the paper
    EXPECT_NEAR(static_cast<double>(closed[1]), 3.788366, 5e-7);
    // |1 - C| < a: everything above one root; 3.36 at C = 0.95 of the paper
    RigidRotor short_rotor = body;
    short_rotor.C = 0.95L * body.A;
    const auto above = growing_bands(rotating_body(short_rotor), 0.01L, 6, 120, 0);
    ASSERT_EQ(above.size(), 1U);
    EXPECT_NEAR(static_cast<double>(above[0].first), 3.36, 5e-3);
    EXPECT_EQ(static_cast<double>(above[0].second), 6);
}

/// With the balls free a root is zero where the rotor pinned at the balancer is critical.
TEST(RotatingState, free_balls_hold_their_plane_at_zero_roots) {
    const CaseRotor rotor = read("centrifuge_two_balls", {"bearing[0].c=0", "bearing[1].c=0"});
    const RotatingRotor state = rotating_composite(rotor);
    const auto sign = [&state](Real speed) { return determinant(state.static_matrix(speed)) > 0; };
    for (const Real speed : split_additional_speeds(composite_rotor(rotor), rotor.balancers[0].z))
        EXPECT_NE(sign(speed * (1 - 1e-12L)), sign(speed * (1 + 1e-12L)));
    RotatingRotor frozen = state;
    frozen.balls.clear();
    for (const Real speed : split_resonances(composite_rotor(rotor))) {
        const Real below = determinant(frozen.static_matrix(speed * (1 - 1e-12L)));
        const Real above = determinant(frozen.static_matrix(speed * (1 + 1e-12L)));
        EXPECT_LT(static_cast<double>(below * above), 0);
    }
}

/// Capacity 1: both balls opposite the imbalance, |D| = 1, a zero root at every speed.
TEST(RotatingState, balls_at_full_capacity_are_neutral) {
    const CaseRotor rotor = read("centrifuge_two_balls", {"balancer[0].imbalance=0.144"});
    const auto found = rotating_composite(rotor).eigenvalues(300);
    EXPECT_LT(distance(found, 0), 1e-12 * 300);
}

/// Rodrigues et al. (2008): balanced above a Hopf point, at 2.944 with the inertia of the balls.
TEST(RotatingState, two_plane_balancer_is_stable_above_its_hopf_point) {
    const RotatingRotor state = rotating_composite(read("rodrigues_two_plane"));
    EXPECT_GT(static_cast<double>(state.growth(2.94L)), 1e-7);
    EXPECT_LT(static_cast<double>(state.growth(2.95L)), 1e-7); // neutral motions of equal planes
}

/// One ball off its place by 1e-7: the deflection grows as the state matrix says.
TEST(BallMotion, follows_the_state_matrix_while_small) {
    const CaseRotor rotor = read("rodrigues_two_plane");
    const double place = 2 * std::numbers::pi / 3;
    const std::vector<std::vector<double>> start{{place + 1e-7, -place}, {place, -place}};
    const auto growth = static_cast<double>(rotating_composite(rotor).growth(2.5L));
    const double late = ball_motion(rotor, 2.5, start, 80).residual;
    const double early = ball_motion(rotor, 2.5, start, 50).residual;
    EXPECT_GT(growth, 0.1);
    EXPECT_LT(late, 0.01);
    // The largest of the last fortieth of 80 and 50 s, part of an oscillation
    EXPECT_NEAR(std::log(late / early) / (30 * growth), 1, 0.1);
}

/// Rodrigues et al. (2008): (Omega, eps, m) = (4, 0.01, 0.005) balances at +-120 degrees.
TEST(BallMotion, balances_where_published) {
    const CaseRotor rotor = read("rodrigues_two_plane");
    const BallOutcome end = ball_motion(rotor, 4, rotor.ball_angles, 1500);
    EXPECT_EQ(end.name(), "balanced");
    EXPECT_NEAR(end.angles.at(0).at(0), 2 * std::numbers::pi / 3, 2e-3);
    EXPECT_NEAR(end.angles.at(1).at(1), -2 * std::numbers::pi / 3, 2e-3);
}

TEST(Floquet, constant_coefficients_give_exponentials) {
    PeriodicSystem system;
    const RealMatrix one = RealMatrix::Identity(1, 1);
    system.M = [one](Real) { return one; };
    system.D = [one](Real) { return RealMatrix(one * 0.2L); };
    system.K = [one](Real) { return RealMatrix(one * 4); };
    system.period = 1.5L;
    const Complex lambda(-0.1L, std::sqrt(4 - 0.01L));
    EXPECT_LT(distance(multipliers(system), std::exp(lambda * system.period)), 1e-14);
}

/// y'' + (a - 2 q cos 2t) y = 0 at q = 1 is unstable between b1 = -0.1102488170 and
/// a1 = 1.8591080725 (Abramowitz and Stegun, table 20.1).
TEST(Floquet, mathieu_equation) {
    const auto grows = [](Real a) {
        PeriodicSystem system;
        system.M = [](Real) { return RealMatrix(RealMatrix::Identity(1, 1)); };
        system.D = [](Real) { return RealMatrix(RealMatrix::Zero(1, 1)); };
        system.K = [a](Real t) {
            return RealMatrix(RealMatrix::Identity(1, 1) * (a - 2 * std::cos(2 * t)));
        };
        system.period = std::numbers::pi_v<Real>;
        return floquet_growth(system) > 1e-7L;
    };
    const auto bands = bands_where(grows, -0.3L, 2.5L, 28);
    ASSERT_EQ(bands.size(), 1U);
    EXPECT_NEAR(static_cast<double>(bands[0].first), -0.1102488170, 1e-9);
    EXPECT_NEAR(static_cast<double>(bands[0].second), 1.8591080725, 1e-9);
}

TEST(Floquet, on_isotropic_bearings_is_the_state_matrix) {
    const CaseRotor rotor = read("anisotropic_rotor");
    const RotatingRotor state = rotating_body(bare_rotor(rotor));
    for (const double speed : {1.0, 2.9, 5.0})
        EXPECT_NEAR(static_cast<double>(floquet_growth(rigid_periodic(rotor, speed))),
                    static_cast<double>(state.growth(speed)), 1e-12);
}

PendulumRotor first_figure(Real H, Real h) {
    PendulumRotor out = pendulum_rotor(read("pendulum_planar"));
    out.H = H;
    out.h = h;
    return out;
}

TEST(Pendulums, small_imbalance_gives_the_approximate_efficiency) {
    PendulumRotor rotor = first_figure(0.3L, 0);
    rotor.u0 = 1e-8L;
    for (const double ratio : {0.5, 1.2, 3.0})
        EXPECT_NEAR(static_cast<double>(exact_efficiency(rotor, ratio)),
                    static_cast<double>(approximate_efficiency(rotor, ratio)), 1e-13);
    EXPECT_NEAR(static_cast<double>(approximate_efficiency(rotor, 1e9L) / rotor.limit()), 1, 1e-12);
    EXPECT_NEAR(static_cast<double>(approximate_efficiency(first_figure(0, 0), rotor.threshold())),
                1, 1e-15);
}

/// Ranges that the theory of the balancer names for the first rotor of the paper's figures.
TEST(Pendulums, small_motions_grow_in_the_ranges_known) {
    const auto unstable = [](Real H, Real h) {
        return bands_where(
            [&](Real ratio) { return linear_growth(first_figure(H, h), ratio) > 1e-8L; }, 0.1L, 4,
            100);
    };
    const auto undamped = unstable(0, 0);
    ASSERT_FALSE(undamped.empty());
    EXPECT_NEAR(static_cast<double>(undamped.front().first), 0.72, 6e-3);
    EXPECT_NEAR(static_cast<double>(undamped.back().second), 2.52, 6e-3);
    const auto damped = unstable(0.3L, 0.5L);
    ASSERT_EQ(damped.size(), 1U);
    EXPECT_NEAR(static_cast<double>(damped[0].first), 0.63, 6e-3);
    EXPECT_NEAR(static_cast<double>(damped[0].second), 2.27, 6e-3);
    EXPECT_TRUE(unstable(1, 0.5L).empty());
}

TEST(Pendulums, motion_in_time_follows_the_linear_one) {
    EXPECT_EQ(pendulum_motion(first_figure(1, 0.5L), 1.2L, 0.05L, -0.02L, 2).name(), "at rest");
    EXPECT_NE(pendulum_motion(first_figure(0.3L, 0.05L), 1.2L, 0.05L, -0.02L, 2).name(), "at rest");
    // Swing of the last fortieth, after times an exponential apart
    PendulumRotor rotor = first_figure(0.3L, 0.05L);
    rotor.u0 = 0;
    const Real growth = linear_growth(rotor, 1.2L) * rotor.omega0;
    const Real ratio = pendulum_motion(rotor, 1.2L, 1e-9L, 0, 0.9L).swing /
                       pendulum_motion(rotor, 1.2L, 1e-9L, 0, 0.8L).swing;
    EXPECT_GT(static_cast<double>(growth), 0);
    EXPECT_NEAR(static_cast<double>(std::log(ratio) / (0.1L * growth)), 1, 0.25);
}

} // namespace

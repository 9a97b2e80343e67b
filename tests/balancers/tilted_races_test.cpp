// Races tilted against the shaft: against Newton's equations of a ball on a circle in space, energy
// and angular momentum, a rigid rotor in closed form, eigenvalues of the motion in time.

#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "balancers/kind.h"
#include "balancers/state_motions.h"
#include "model/errors.h"
#include "results/simulate.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/written_case.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace whirl::tilted_races {
namespace {

using Complex = std::complex<double>;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

model::Balls &balls_of(model::Balancer &balancer) { return std::get<model::Balls>(balancer.parts); }

/// The rotation about an axis across z that takes z to the direction (slope, 1).
Eigen::Matrix3d leaning(const Eigen::Vector2d &slope) {
    const double angle = slope.norm();
    if (angle == 0)
        return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(-slope(1), slope(0), 0) / angle)
        .toRotationMatrix();
}
Eigen::Vector2d turned(const Eigen::Vector2d &v, double angle) {
    return Eigen::Rotation2Dd(angle) * v;
}
Eigen::Vector3d on_circle(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

constexpr double mass = 0.03;   ///< kg
constexpr double radius = 0.08; ///< m

/// Coordinates: x, y and slopes of the plane, the angle of the ball in the fixed frame, that of the
/// rotor.
using Coordinates = Eigen::Matrix<double, 6, 1>;

/// Where the ball is, its angle that which is seen along the axis: at r (e, -C) on the plane that
/// leans by a slope, C = e . slope, r^2 (1 + C^2) = R^2.
Eigen::Vector3d on_leaning_circle(const Eigen::Vector2d &slope, double angle) {
    const Eigen::Vector2d e(std::cos(angle), std::sin(angle));
    const double C = e.dot(slope);
    return radius / std::sqrt(1 + C * C) * Eigen::Vector3d(e(0), e(1), -C);
}
Eigen::Vector3d place(const Coordinates &q, const Eigen::Vector2d &race) {
    return Eigen::Vector3d(q(0), q(1), 0) +
           on_leaning_circle(Eigen::Vector2d(q.segment<2>(2)) + turned(race, q(5)), q(4));
}

// A race that leans in a shaft that leans is one that leans by both, to the second order.
TEST(TiltedRace, LeansByTheSlopesOfBoth) {
    const double small = 1e-3;
    const Eigen::Vector2d shaft(0.8 * small, -0.5 * small);
    const Eigen::Vector2d race(0.3 * small, 0.9 * small);
    for (double angle = 0; angle < 6; angle += 0.7) {
        const Eigen::Vector3d turned_twice =
            leaning(shaft) * (leaning(race) * on_circle(radius, angle));
        const double seen = std::atan2(turned_twice(1), turned_twice(0));
        EXPECT_LT((turned_twice - on_leaning_circle(shaft + race, seen)).norm(),
                  3 * small * small * small * radius);
        // It stands along z by R tilt cos(a - angle of the tilt): the race leans away from there.
        const double z = (leaning(race) * on_circle(radius, angle))(2);
        EXPECT_NEAR(z, -race.norm() * radius * std::cos(angle - std::atan2(race(1), race(0))),
                    small * small * radius);
    }
}

/// Q_i = m r'' . dr/dq_i of the ball on its way through q with q' and q''.
Coordinates inertia_forces(const Coordinates &q, const Coordinates &v, const Coordinates &a,
                           const Eigen::Vector2d &race) {
    const auto at = [&](double t) { return place(q + v * t + a * (t * t / 2), race); };
    const double h = 2e-3 / v.cwiseAbs().maxCoeff();
    // Of sixth order.
    const Eigen::Vector3d acceleration =
        (2 * (at(-3 * h) + at(3 * h)) - 27 * (at(-2 * h) + at(2 * h)) + 270 * (at(-h) + at(h)) -
         490 * at(0)) /
        (180 * h * h);
    Coordinates out;
    for (int i = 0; i < 6; ++i) {
        constexpr double step = 1e-4;
        const auto moved = [&](double by) {
            return place(q + by * step * Coordinates::Unit(i), race);
        };
        const Eigen::Vector3d slope =
            (45 * (moved(1) - moved(-1)) - 9 * (moved(2) - moved(-2)) + (moved(3) - moved(-3))) /
            (60 * step);
        out(i) = mass * acceleration.dot(slope);
    }
    return out;
}

// To second order in slopes and tilt; of what is left at half the size is a
// quarter.
TEST(TiltedRace, BallsMoveAsNewtonSays) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> between(-1, 1);
    for (int run = 0; run < 20; ++run) {
        Coordinates q0, v0, a0;
        for (int i = 0; i < 6; ++i) {
            q0(i) = between(random);
            v0(i) = between(random);
            a0(i) = between(random);
        }
        const double direction = pi * between(random);
        std::array<double, 2> left{};
        std::array<double, 2> tilting{};
        for (const int half : {0, 1}) {
            const double small = half == 0 ? 4e-3 : 2e-3;
            Coordinates q = q0, v = v0, a = a0;
            q.head<2>().setZero(); // what they would couple is of the third order
            v.head<2>().setZero();
            a.head<2>().setZero();
            q.segment<2>(2) *= small;
            v.segment<2>(2) *= 100 * small;
            a.segment<2>(2) *= 1e4 * small;
            q.tail<2>() *= 3;
            v.tail<2>() *= 100;
            a.tail<2>() *= 1e4;
            model::Balancer balancer = tests::ball_balancer(0, 1, mass, radius, 0);
            balls_of(balancer).tilt = 0.7 * small;
            balls_of(balancer).tilt_angle = direction;
            const auto kind = balancers::kind_of(balancer);
            const auto motion = kind->motion(true, 0);
            const Eigen::Vector2d race(kind->inclination().real(), kind->inclination().imag());
            balancers::PlaneMotion plane{q.head<4>(), v.head<4>()};
            const double angle = q(4) - q(5);
            const double own = v(4) - v(5);
            const double cosine = std::cos(q(4));
            const double sine = std::sin(q(4));
            balancers::MassEquation e;
            motion->equations(plane, {q(5), v(5)}, &angle, &own, {&cosine, &sine}, &e);
            Coordinates found;
            const Eigen::Vector4d y = a.head<4>();
            Eigen::Vector4d Qy = Eigen::Vector4d::Zero();
            // The mass and its mean inertia are the rotor's own.
            Qy.head<2>() = mass * y.head<2>();
            Qy.tail<2>() = e.tilt * y.tail<2>() + mass * radius * radius / 2 * y.tail<2>();
            found.head<4>() = e.u * a(4) + Qy - e.force - e.per_spin * a(5);
            found(4) = e.a * a(4) + e.u.dot(y) + e.b + e.by_spin * a(5);
            found(5) =
                e.torque(0) + e.torque(1) * a(5) + e.by_spin * a(4) + e.swash.dot(y.tail<2>());
            const Coordinates expected = inertia_forces(q, v, a, race);
            // Forces that are there without slopes are in the first two and the fifth.
            const double size = mass * radius * radius * 1e4;
            EXPECT_LT((found - expected).tail<4>().cwiseAbs().maxCoeff(), 1e-6 * size);
            left[static_cast<std::size_t>(half)] =
                (found - expected).segment<2>(2).norm() / (size * small);
            tilting[static_cast<std::size_t>(half)] = std::abs(found(5) - expected(5)) / size;
        }
        EXPECT_LT(left[1], 1e-4); // of the moments: second order in the slopes
        EXPECT_LT(left[1], 0.3 * left[0] + 3e-7);
        EXPECT_LT(tilting[1], 1e-8);
    }
}

TEST(TiltedRace, KeepsEnergyAndMomentum) {
    model::Case scene = tests::flexible_rotor(200);
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balls_of(balancer).tilt = 0.05;
        balls_of(balancer).tilt_angle = 0.4;
    }
    balls_of(scene.rotor.balancers[0]).eccentricity = 0.005;
    balls_of(scene.rotor.balancers[1]).ellipticity = 0.02;
    scene.simulate.gravity = 9.81;
    const auto expect_books_close = [](const model::Case &one) {
        const results::SimulateResult result = analyses::simulate_alone(one);
        EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
        EXPECT_LT(std::abs(result.audit.momentum_error), 1e-6 * result.audit.momentum_scale);
    };
    expect_books_close(scene);
    model::Case motor = scene;
    motor.simulate.torque = 3;
    motor.simulate.torque_slope = 0.01;
    expect_books_close(motor);
    model::Case run_up = scene;
    run_up.simulate.run_up = {{0, 50}, {0.3, 400}};
    for (model::Balancer &balancer : run_up.rotor.balancers)
        balls_of(balancer).release_speed = 240;
    expect_books_close(run_up);
}

TEST(TiltedRace, SmallMotionsAreThoseOfTheMotionInTime) {
    for (const double speed : {120.0, 260.0}) {
        model::Case scene = tests::flexible_rotor(speed);
        scene.states = model::StatesSettings{};
        for (model::Balancer &balancer : scene.rotor.balancers) {
            tests::row(balancer).n = 2;
            balls_of(balancer).tilt = 0.02;
            balls_of(balancer).tilt_angle = 0.5;
        }
        tests::row(scene.rotor.balancers[1]).n = 1;
        scene.rotor.balancers[1].imbalance_radius.reset();
        tests::expect_motions_in_time_about(scene, speed, Kind::out_of_round);
    }
}

/// A rigid rotor of 10 kg, Id 0.05 and Ip 0.09 kg m2 between two bearings 0.5 m to either side of
/// its centre of mass, with two balls there.
struct Rigid {
    double k = 5e5, c = 200;     ///< of each bearing
    double imbalance = 3e-3;     ///< kg m
    double ball = 0.05, R = 0.1; ///< kg and m
    double tilt = 0, tilt_angle = 0.9;

    [[nodiscard]] model::Case scene() const {
        model::Case scene;
        scene.name = "rigid";
        scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
        scene.rotor.shaft.rigid = true;
        scene.rotor.discs = {tests::disc_at(0.5, 10, 0.05, 0.09)};
        scene.rotor.bearings = {tests::isotropic_bearing(0, k, c),
                                tests::isotropic_bearing(1, k, c)};
        scene.rotor.balancers = {tests::ball_balancer(0.5, 2, ball, R, 0.5, imbalance)};
        balls_of(scene.rotor.balancers[0]).tilt = tilt;
        balls_of(scene.rotor.balancers[0]).tilt_angle = tilt_angle;
        scene.states = model::StatesSettings{};
        return scene;
    }
};

// Balls that balance are as far along z as the race takes them: a couple m R W^2 z each, that of
// the rotor's plane, which leans by it. To first order in the tilt.
TEST(TiltedRace, BalancedBallsLeaveACouple) {
    for (const double speed : {500.0, 900.0}) {
        Rigid of;
        of.tilt = 1e-4;
        const model::Case scene = of.scene();
        const states::StateSearch search(scene, speed, speed);
        bool undecided = false;
        const auto states = search.at(speed, undecided);
        EXPECT_FALSE(undecided);
        const auto balanced = std::ranges::min_element(
            states, {}, [](const auto &found) { return found.state.residual; });
        ASSERT_NE(balanced, states.end());
        EXPECT_LT(balanced->state.residual, 2 * of.R * of.tilt * of.tilt);
        const Eigen::VectorXd y =
            search.equations().plane_rows() * balanced->x.head(search.equations().rotor_unknowns());
        const Complex slope(y(2), y(3));
        // Small in z, the point masses lie on a plane with slopes of their own: real 2 x 2.
        const double half = std::acos(-of.imbalance / (2 * of.ball * of.R));
        const Complex stiffness((of.k + of.k) / 4 - (0.05 - 0.09) * speed * speed,
                                2 * of.c / 4 * speed);
        Eigen::Matrix2d A;
        A << stiffness.real(), -stiffness.imag(), stiffness.imag(), stiffness.real();
        Eigen::Vector2d couple = Eigen::Vector2d::Zero();
        for (const double a : {half, -half}) {
            const Eigen::Vector2d e(std::cos(a), std::sin(a));
            const double inertia = of.ball * of.R * of.R;
            A += inertia * speed * speed * e * e.transpose();
            const double z = of.R * of.tilt * std::cos(a - of.tilt_angle);
            couple += of.ball * of.R * speed * speed * z * e;
        }
        const Eigen::Vector2d expected = A.partialPivLu().solve(couple);
        EXPECT_LT((Eigen::Vector2d(slope.real(), slope.imag()) - expected).norm(),
                  1e-3 * expected.norm());
        EXPECT_GT(expected.norm(), 5e-4 * of.tilt);
    }
}

// No start of Newton's method on all equations leads to a state that the search has not.
TEST(TiltedRace, SteadyStatesAreAllThatNewtonFinds) {
    const double speed = 160;
    model::Case scene = tests::flexible_rotor(speed);
    tests::row(scene.rotor.balancers[0]).n = 2;
    tests::row(scene.rotor.balancers[1]).n = 1;
    scene.rotor.balancers[1].imbalance_radius.reset();
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balls_of(balancer).tilt = 0.02;
        balls_of(balancer).tilt_angle = -0.8;
    }
    const states::StateSearch search(scene, speed, speed);
    bool undecided = false;
    const auto states = search.at(speed, undecided);
    EXPECT_FALSE(undecided);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> angle(-pi, pi);
    int found_again = 0;
    for (int run = 0; run < 1000; ++run) {
        Eigen::VectorXd angles(3);
        for (double &one : angles)
            one = angle(random);
        Eigen::VectorXd x = search.equations().with_angles(angles, speed);
        if (search.equations().refine(x, speed, 1e-4) > 1e-10)
            continue;
        ++found_again;
        const auto close = [](double a, double b) {
            return std::abs(std::remainder(a - b, 2 * pi)) < 1e-6;
        };
        EXPECT_TRUE(std::ranges::any_of(states, [&](const auto &state) {
            const Eigen::VectorXd a = x.tail(3);
            const Eigen::VectorXd b = state.x.tail(3);
            return close(a(2), b(2)) && ((close(a(0), b(0)) && close(a(1), b(1))) ||
                                         (close(a(0), b(1)) && close(a(1), b(0))));
        })) << x.tail(3).transpose();
    }
    EXPECT_GT(found_again, 100);
}

TEST(TiltedRace, MistakesAreNamed) {
    model::Case scene = Rigid{}.scene();
    balls_of(scene.rotor.balancers[0]).tilt = 0.01;
    scene.speeds = model::SpeedRange{500, 500, 1};
    EXPECT_THROW((void)analyses::stability(scene, {}), model::AnalysisFailure);
    const auto expect = [](const std::string &keys, const std::string &key) {
        try {
            (void)tests::written_case(
                "[shaft]\nsegments = [{length = 1, outer = 0.05, material = \"s\"}]\n"
                "[[bearing]]\nz = 0\nk = 1e7\nc = 100\n[[bearing]]\nz = 1\nk = "
                "1e7\nc = 100\n"
                "[[balancer]]\nz = 0.5\nmass = 0.01\nradius = 0.1\n" +
                keys);
            ADD_FAILURE() << "accepted: " << keys;
        } catch (const model::BadInput &mistake) {
            EXPECT_NE(std::string(mistake.what()).find(key), std::string::npos) << mistake.what();
        }
    };
    expect("tilt = 0.2\n", "balancer[0].tilt");
    expect("tilt_angle = 0.2\n", "balancer[0].tilt_angle");
    expect("tilt = \"1 deg\"\nrolling_resistance = 1e-5\n", "balancer[0].tilt");
    expect("tilt = 0.01\nheld = true\n", "balancer[0].held");
    expect("tilt = 0.01\ntilt_inertia = false\n", "balancer[0].tilt_inertia");
}

} // namespace
} // namespace whirl::tilted_races

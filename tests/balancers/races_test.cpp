// Races whose centre is off the axis, tracks of their own, balls held up to a speed: against
// Newton's equations of the balls, closed forms and other ways of the program to the same.

#include "analyses/balance.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "balancers/held.h"
#include "balancers/kind.h"
#include "balancers/state_motions.h"
#include "model/errors.h"
#include "results/simulate.h"
#include "simulation/equations.h"
#include "simulation/motion.h"
#include "states/branches.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"
#include "support/written_case.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace whirl::races {
namespace {

using Complex = std::complex<double>;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

model::Balls &balls_of(model::Balancer &balancer) { return std::get<model::Balls>(balancer.parts); }

/// A planar rotor, k - M W^2 + i c W, with balls in a race about e in the rotor.
struct Planar {
    tests::RigidJeffcott rotor;
    int n = 2;
    double ball = 0.05;      ///< kg
    double radius = 0.1;     ///< m
    double drag = 0.5;       ///< N s/m
    double imbalance = 3e-3; ///< kg m
    double phase = 0.4;      ///< rad
    double e = 2e-4;         ///< m
    double direction = 1.1;  ///< rad
    double ellipticity = 0;
    double long_axis = 0.7; ///< rad

    [[nodiscard]] Complex centre() const { return std::polar(e, direction); }
    /// Where a ball is in the rotor, or derivatives of that over its angle: R cos 2(a - b) is half
    /// the sum of two harmonics.
    [[nodiscard]] Complex place(double a, int derivative) const {
        const Complex i(0, 1);
        const double twice = 2 * long_axis;
        return (derivative == 0 ? centre() : 0) +
               radius * (std::pow(i, derivative) * std::polar(1.0, a) +
                         ellipticity / 2 *
                             (std::pow(3.0 * i, derivative) * std::polar(1.0, 3 * a - twice) +
                              std::pow(-i, derivative) * std::polar(1.0, twice - a)));
    }
    [[nodiscard]] Complex U() const { return std::polar(imbalance, phase); }
    [[nodiscard]] model::Case scene(double speed) const {
        model::Case scene = rotor.scene();
        scene.name = "race";
        model::Balancer balancer = tests::ball_balancer(0.5, n, ball, radius, drag, imbalance);
        balancer.imbalance_phase = phase;
        balancer.tilt_inertia = false;
        balls_of(balancer).eccentricity = e;
        balls_of(balancer).eccentricity_angle = direction;
        balls_of(balancer).ellipticity = ellipticity;
        balls_of(balancer).ellipticity_angle = long_axis;
        scene.rotor.balancers = {balancer};
        scene.states = model::StatesSettings{};
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 3;
        return scene;
    }
    /// Without balls, and with their mass on the axis.
    [[nodiscard]] Complex dynamic(double speed, bool with_balls) const {
        const double mass = rotor.mass + (with_balls ? n * ball : 0);
        return {rotor.kx - mass * speed * speed, rotor.c * speed};
    }
    /// sum m R exp(i a) of balls that hold the centre of their race still: (k - M W^2 + i c W)(-e)
    /// = W^2 (U + sum).
    [[nodiscard]] Complex needed(double speed) const {
        return -dynamic(speed, false) * centre() / (speed * speed) - U();
    }
};

Complex sum_of(const model::Case &scene, const std::vector<double> &angles) {
    const auto masses = balancers::kind_of(scene.rotor.balancers.front())->circled();
    Complex sum = 0;
    for (std::size_t j = 0; j < masses.size(); ++j)
        sum += std::polar(masses[j].moment, angles[j]);
    return sum;
}

// --- Motion in time ----------------------------------------------------------------------------

/// Newton's equations of the planar rotor and its balls, in Cartesian components: unknown are the
/// rotor's acceleration, those of the balls along their race, and the forces across it.
struct Newton {
    Complex rotor;             ///< acceleration, m/s2
    std::vector<double> balls; ///< angular accelerations in the rotor, rad/s2
    double torque = 0;         ///< of the drive about the axis without that of inertia, N m
};
struct PlanarState {
    Complex w, v;
    std::vector<double> angles, rates; ///< in the rotor
    double theta = 0, speed = 0, acceleration = 0;
};

Newton newton(const Planar &of, const PlanarState &s, double gravity) {
    const Complex i(0, 1);
    const auto n = static_cast<Eigen::Index>(s.angles.size());
    const Complex spin = std::polar(1.0, s.theta);
    const Complex of_turning = i * s.acceleration - s.speed * s.speed; // of what turns along
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 + 2 * n, 2 + 2 * n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(2 + 2 * n);
    const auto put = [](auto &&to, Complex value) { to << value.real(), value.imag(); };
    A.topLeftCorner<2, 2>().diagonal().setConstant(of.rotor.mass);
    Complex on_rotor = -of.rotor.kx * s.w - of.rotor.c * s.v - of.U() * spin * of_turning;
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto at = static_cast<std::size_t>(j);
        const double rate = s.rates[at];
        const auto path = [&](int k) { return spin * of.place(s.angles[at], k); };
        const Complex out = -i * path(1) / std::abs(path(1)); // across the race
        const Complex drag = -of.drag * rate * path(1);       // on the ball
        // m (w'' + P'') = drag - N out - i m gravity, P = z(a) exp(i th)
        const Eigen::Index row = 2 + 2 * j;
        A.block<2, 2>(row, 0).diagonal().setConstant(of.ball);
        put(A.block<2, 1>(row, row), of.ball * path(1));
        put(A.block<2, 1>(row, row + 1), out);
        put(b.segment<2>(row),
            drag - i * of.ball * gravity -
                of.ball * (path(0) * of_turning + 2.0 * i * s.speed * rate * path(1) +
                           rate * rate * path(2)));
        // On the rotor the other way round; its own static sag carries the weight of the balls.
        put(A.block<2, 1>(0, row + 1), -out);
        on_rotor += -drag + i * of.ball * gravity;
    }
    put(b.head<2>(), on_rotor);
    const Eigen::VectorXd x = A.fullPivLu().solve(b);
    Newton result{{x(0), x(1)}, {}, 0};
    for (Eigen::Index j = 0; j < n; ++j)
        result.balls.push_back(x(2 + 2 * j));
    return result;
}

void expect_newton(Planar of) {
    of.n = 3;
    const double gravity = 9.81;
    model::Case scene = of.scene(0);
    scene.simulate.time = 1;
    scene.simulate.gravity = gravity;
    scene.simulate.run_up = {{0, 100}, {1, 400}};
    const simulation::MotionScene prepared = simulation::motion_scene(scene);
    simulation::RotorMotion motion(prepared.parts);
    const double t = 0.3;
    motion.enter_piece(t);
    const Eigen::VectorXd row = motion.parts().planes.front().w;
    const Eigen::Index r = row.size();
    const Eigen::Index n = motion.coordinates();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> between(-1, 1);
    for (int k = 0; k < 20; ++k) {
        PlanarState s;
        s.theta = 100 * t + 150 * t * t;
        s.speed = 100 + 300 * t;
        s.acceleration = 300;
        s.w = {1e-3 * between(random), 1e-3 * between(random)};
        s.v = {between(random), between(random)};
        Eigen::VectorXd state = Eigen::VectorXd::Zero(motion.size());
        const Eigen::VectorXd shape = row / row.squaredNorm();
        state.head(r) = s.w.real() * shape;
        state.segment(r, r) = s.w.imag() * shape;
        state.segment(n, r) = s.v.real() * shape;
        state.segment(n + r, r) = s.v.imag() * shape;
        for (int j = 0; j < of.n; ++j) {
            s.angles.push_back(pi * between(random));
            s.rates.push_back(80 * between(random));
            state(2 * r + j) = s.angles.back();
            state(n + 2 * r + j) = s.rates.back();
        }
        Eigen::VectorXd rates(motion.size());
        motion.rates(t, state.data(), rates.data());
        const Newton expected = newton(of, s, gravity);
        const Complex found(row.dot(rates.segment(n, r)), row.dot(rates.segment(n + r, r)));
        // Rounding of sums of forces some hundred times what is left of them.
        EXPECT_LT(std::abs(found - expected.rotor), 1e-11 * std::abs(expected.rotor));
        for (int j = 0; j < of.n; ++j)
            EXPECT_NEAR(rates(n + 2 * r + j), expected.balls[static_cast<std::size_t>(j)],
                        1e-11 * 4e4);
    }
}

TEST(EccentricRace, MovesAsNewtonSays) {
    Planar of;
    of.e = 0.009; // far more than any race's, to be seen
    expect_newton(of);
}

TEST(RaceOutOfRound, MovesAsNewtonSays) {
    Planar of;
    of.ellipticity = 0.1;
    for (const double e : {0.0, 0.009}) {
        of.e = e;
        expect_newton(of);
    }
}

/// Energy and angular momentum over what was exchanged.
void expect_books_close(const model::Case &scene, double tolerance) {
    const results::SimulateResult result = analyses::simulate_alone(scene);
    EXPECT_LT(std::abs(result.audit.energy_error), tolerance * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), tolerance * result.audit.momentum_scale);
}

/// The torque that the drive must give is in the books alone: with a motor it turns the rotor.
void expect_energy_and_momentum(model::Case scene) {
    scene.simulate.gravity = 9.81;
    expect_books_close(scene, 1e-6);
    model::Case motor = scene;
    motor.simulate.torque = 3;
    motor.simulate.torque_slope = 0.01;
    expect_books_close(motor, 1e-6);
    model::Case run_up = scene;
    run_up.simulate.run_up = {{0, 50}, {0.3, 400}};
    expect_books_close(run_up, 1e-6);
    for (model::Balancer &balancer : run_up.rotor.balancers)
        balls_of(balancer).release_speed = 240;
    expect_books_close(run_up, 1e-6);
}

TEST(EccentricRace, KeepsEnergyAndMomentum) {
    model::Case scene = tests::flexible_rotor(200);
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balls_of(balancer).eccentricity = 0.005;
        balls_of(balancer).eccentricity_angle = 0.8;
    }
    expect_energy_and_momentum(scene);
    model::Case run_up = scene;
    run_up.simulate.gravity = 9.81;
    run_up.simulate.run_up = {{0, 50}, {0.3, 400}};
    for (model::Balancer &balancer : run_up.rotor.balancers) {
        balls_of(balancer).release_speed.reset();
        balls_of(balancer).contact = true;
        for (model::BallRow &own : balls_of(balancer).rows)
            own.diameter = 0.015;
    }
    expect_books_close(run_up, 1e-6);
}

TEST(RaceOutOfRound, KeepsEnergyAndMomentum) {
    model::Case scene = tests::flexible_rotor(200);
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balls_of(balancer).ellipticity = 0.08;
        balls_of(balancer).ellipticity_angle = 0.4;
    }
    balls_of(scene.rotor.balancers[0]).eccentricity = 0.005;
    expect_energy_and_momentum(scene);
    model::StationForce shaken;
    shaken.x = 30;
    shaken.y = -20;
    shaken.frequency = 300;
    scene.simulate.base = model::BaseMotion{shaken, {}};
    expect_books_close(scene, 1e-6);
}

TEST(EccentricRace, BallsEndWhereItsCentreRests) {
    const double speed = 700; // above the critical one, 316 rad/s
    const Planar of;
    model::Case scene = of.scene(speed);
    const results::SimulateResult result = analyses::simulate_alone(scene);
    EXPECT_NEAR(result.balancers.front().amplitude, of.e, 1e-6 * of.e);
    EXPECT_LT(std::abs(sum_of(scene, result.balancers.front().angles) - of.needed(speed)),
              1e-5 * std::abs(of.needed(speed)));
    EXPECT_NE(result.evidence.text().find("off the axis"), std::string::npos);
    EXPECT_LT(result.at_rest->away.value(), 1e-4);
}

// --- Steady states -----------------------------------------------------------------------------

TEST(EccentricRace, SteadyStatesAreThoseOfTheClosedForm) {
    for (const double e : {5e-5, 4e-4})
        for (const double speed : {150.0, 305.0, 400.0, 900.0}) {
            Planar of;
            of.e = e;
            const model::Case scene = of.scene(speed);
            bool undecided = false;
            const auto states = states::StateSearch(scene, speed, speed).at(speed, undecided);
            EXPECT_FALSE(undecided);
            const double moment = of.ball * of.radius;
            const bool can = std::abs(of.needed(speed)) <= 2 * moment;
            int balanced = 0;
            for (const auto &found : states) {
                const std::vector<double> &angles = found.state.angles.front();
                const Complex sum = sum_of(scene, angles);
                // D w = W^2 (U + n m e + sum), balls on the line of w + e.
                const Complex w = speed * speed * (of.U() + 2 * of.ball * of.centre() + sum) /
                                  of.dynamic(speed, true);
                EXPECT_NEAR(found.state.residual, std::abs(w), 1e-9 * std::abs(w));
                for (const double angle : angles)
                    EXPECT_LT(std::abs(std::imag((w + of.centre()) * std::polar(1.0, -angle))),
                              1e-9 * (std::abs(w) + e));
                if (found.state.kind != Kind::balanced)
                    continue;
                ++balanced;
                EXPECT_LT(std::abs(w + of.centre()), 1e-9 * e);
                EXPECT_LT(std::abs(sum - of.needed(speed)), 1e-9 * moment);
            }
            EXPECT_EQ(balanced, can ? 1 : 0) << e << " " << speed;
            EXPECT_GE(states.size(), can ? 2U : 1U); // balls opposite each other at least
        }
}

/// Of a rotor whose races are changed so.
void expect_small_motions(const std::function<void(model::Balls &)> &change, Kind kind) {
    for (const double speed : {120.0, 260.0}) {
        model::Case scene = tests::flexible_rotor(speed);
        scene.states = model::StatesSettings{};
        for (model::Balancer &balancer : scene.rotor.balancers)
            change(balls_of(balancer));
        scene.rotor.balancers[1].imbalance_radius.reset();
        tests::expect_motions_in_time_about(scene, speed, kind);
    }
}

TEST(EccentricRace, SmallMotionsAreThoseOfTheMotionInTime) {
    expect_small_motions(
        [](model::Balls &balls) {
            balls.eccentricity = 1e-3;
            balls.eccentricity_angle = -0.6;
        },
        Kind::coincident);
}

TEST(RaceOutOfRound, SmallMotionsAreThoseOfTheMotionInTime) {
    expect_small_motions(
        [](model::Balls &balls) { // two balls and one, in races off the axis as well
            balls.rows.front().n = balls.rows.front().n == 3 ? 1 : 2;
            balls.eccentricity = 1e-3;
            balls.ellipticity = 0.03;
            balls.ellipticity_angle = 0.5;
        },
        Kind::out_of_round);
}

/// Newton's method from a grid of starts for two balls: W^2 (U + n m c + sum of z) = D w and
/// (w + c + z) . dz/da = 0.
std::vector<std::array<double, 2>> pairs_by_newton(const Planar &of, double speed) {
    const auto along = [](Complex a, Complex b) { return std::real(std::conj(a) * b); };
    const Complex D = of.dynamic(speed, true) / (speed * speed);
    const auto left = [&](const std::array<double, 2> &a) {
        const Complex w = (of.U() + of.ball * (of.place(a[0], 0) + of.place(a[1], 0))) / D;
        return Eigen::Vector2d(along(w + of.place(a[0], 0), of.place(a[0], 1)),
                               along(w + of.place(a[1], 0), of.place(a[1], 1)));
    };
    std::vector<std::array<double, 2>> found;
    constexpr int starts = 24;
    for (int k = 0; k < starts * starts; ++k) {
        std::array<double, 2> a{2 * pi / starts * (k % starts), 2 * pi / starts * (k / starts)};
        for (int step = 0; step < 25; ++step) {
            constexpr double small = 1e-6;
            Eigen::Matrix2d J;
            for (std::size_t j = 0; j < 2; ++j) {
                std::array<double, 2> up = a, down = a;
                up[j] += small;
                down[j] -= small;
                J.col(static_cast<Eigen::Index>(j)) = (left(up) - left(down)) / (2 * small);
            }
            const Eigen::Vector2d by = J.fullPivLu().solve(left(a));
            a = {a[0] - by(0), a[1] - by(1)};
        }
        if (!(left(a).norm() < 1e-12 * of.radius * of.radius))
            continue;
        for (double &angle : a)
            angle -= 2 * pi * std::floor(angle / (2 * pi));
        const auto near = [](double x, double y) {
            return std::abs(std::remainder(x - y, 2 * pi)) < 1e-6;
        };
        if (std::ranges::none_of(found, [&](const auto &b) {
                return (near(a[0], b[0]) && near(a[1], b[1])) ||
                       (near(a[0], b[1]) && near(a[1], b[0]));
            }))
            found.push_back(a);
    }
    return found;
}

TEST(RaceOutOfRound, SteadyStatesAreAllThatNewtonFinds) {
    for (const double ellipticity : {1e-4, 3e-3, 0.08})
        for (const double speed : {150.0, 305.0, 900.0}) {
            Planar of;
            of.ellipticity = ellipticity;
            const model::Case scene = of.scene(speed);
            bool undecided = false;
            const auto states = states::StateSearch(scene, speed, speed).at(speed, undecided);
            EXPECT_FALSE(undecided);
            const auto expected = pairs_by_newton(of, speed);
            EXPECT_EQ(states.size(), expected.size()) << ellipticity << " " << speed;
            for (const auto &found : states) {
                EXPECT_EQ(found.state.kind, Kind::out_of_round);
                const std::vector<double> &a = found.state.angles.front();
                EXPECT_TRUE(std::ranges::any_of(
                    expected,
                    [&](const auto &b) {
                        const auto apart = [&](std::size_t i, std::size_t k) {
                            return std::abs(std::remainder(a[i] - b[k], 2 * pi));
                        };
                        return std::min(apart(0, 0) + apart(1, 1), apart(0, 1) + apart(1, 0)) <
                               1e-7;
                    }))
                    << a[0] << " " << a[1];
                const Complex w = speed * speed *
                                  (of.U() + of.ball * (of.place(a[0], 0) + of.place(a[1], 0))) /
                                  of.dynamic(speed, true);
                EXPECT_NEAR(found.state.residual, std::abs(w), 1e-8 * std::abs(w));
            }
        }
}

/// One rotor at all its speeds.
class OverSpeeds : public states::Followed {
  public:
    explicit OverSpeeds(const states::StateSearch &search) : _search(search) {}
    const states::StateSearch &search(double) override { return _search; }
    [[nodiscard]] double speed(double place) const override { return place; }

  private:
    const states::StateSearch &_search;
};

// Several branches end between two speeds: each at a speed of its own, at which as many states come
// or go as Newton's method finds on both sides.
TEST(RaceOutOfRound, BranchesThatEndInOneStepEndEachAtItsOwnSpeed) {
    Planar of;
    of.ellipticity = 0.01;
    of.e = 0;
    const std::vector<double> speeds{276, 288, 300, 312, 324};
    const states::StateSearch search(of.scene(speeds.front()), speeds.front(), speeds.back());
    OverSpeeds over(search);
    std::vector<states::AtPlace> all;
    for (const double speed : speeds) {
        bool undecided = false;
        all.push_back({speed, over.at(speed, undecided)});
        EXPECT_FALSE(undecided);
    }
    results::SteadyStates found;
    states::join_branches(over, all, found);
    using BorderKind = results::SteadyBorder::Kind;
    std::map<double, int> ends; // how many branches end
    for (const results::SteadyBorder &border : found.borders)
        if (border.kind == BorderKind::fold || border.kind == BorderKind::limit)
            ends[border.speed] += border.kind == BorderKind::fold ? 2 : 1;
    EXPECT_GE(ends.size(), 3U);
    for (const auto &[speed, count] : ends) {
        constexpr double near = 1e-4; // of the speed: states are a hundredth of a radian apart
        const auto below = std::ssize(pairs_by_newton(of, speed * (1 - near)));
        const auto above = std::ssize(pairs_by_newton(of, speed * (1 + near)));
        EXPECT_EQ(std::abs(below - above), count) << speed;
    }
}

// On a rotor that hardly moves each ball is by itself. With L = m [(rho^2 + rho'^2) a'^2 +
// W^2 rho^2]/2 it swings about the long axis with w^2 = 4 ellipticity W^2/(1 + ellipticity) and
// leaves the short one.
TEST(RaceOutOfRound, BallsSwingAboutTheLongAxis) {
    const double speed = 200;
    Planar of;
    of.e = 0;
    of.drag = 0;
    of.ellipticity = 0.02;
    of.rotor.kx = of.rotor.ky = 1e13; // a rotor moves by m W^2/k = 2e-10 of what balls do
    const model::Case scene = of.scene(speed);
    const states::StateSearch search(scene, speed, speed);
    bool undecided = false;
    int on_long_axis = 0;
    const auto states = search.at(speed, undecided);
    EXPECT_EQ(states.size(), 10U); // pairs out of four places, two alike
    for (const auto &found : states) {
        std::vector<double> expected;
        for (const double angle : found.state.angles.front()) {
            const double turned = std::remainder(2 * (angle - of.long_axis), 2 * pi);
            const bool on_long = std::abs(turned) < 1e-6;
            EXPECT_NEAR(std::abs(turned), on_long ? 0 : pi, 1e-6);
            const double e = on_long ? of.ellipticity : -of.ellipticity;
            expected.push_back(4 * e / (1 + e) * speed * speed);
        }
        std::ranges::sort(expected);
        on_long_axis += expected.front() > 0;
        const auto motions = search.equations().about(found.x, speed);
        std::vector<double> squares; // of the balls, far slower than the rotor
        for (const modes::Root &root : modes::all_roots(motions, speed, 0))
            if (std::abs(root.value) < 2 * speed && root.value.imag() >= 0)
                squares.push_back(-std::real(root.value * root.value));
        std::ranges::sort(squares);
        squares.erase(
            std::unique(squares.begin(), squares.end(),
                        [&](double a, double b) { return std::abs(a - b) < 1e-5 * speed * speed; }),
            squares.end());
        EXPECT_NEAR(squares.front(), expected.front(), 1e-6 * speed * speed);
        EXPECT_NEAR(squares.back(), expected.back(), 1e-6 * speed * speed);
    }
    EXPECT_EQ(on_long_axis, 3);
}

// Two balls that balance feel h = 2 ellipticity R sin 2(a - b) along the race each; to first order
// in it their plane is deflected so that Im(w exp(-i a)) = h holds both.
TEST(RaceOutOfRound, MovesTheBalancedPosition) {
    const double speed = 900;
    Planar of;
    of.e = 0;
    of.ellipticity = 1e-7;
    const double half = std::acos(-of.imbalance / (2 * of.ball * of.radius));
    const std::array<double, 2> a{of.phase + half, of.phase - half};
    Eigen::Matrix2d A;
    Eigen::Vector2d h;
    for (Eigen::Index j = 0; j < 2; ++j) {
        const double angle = a[static_cast<std::size_t>(j)];
        A.row(j) << -std::sin(angle), std::cos(angle);
        h(j) = 2 * of.ellipticity * of.radius * std::sin(2 * (angle - of.long_axis));
    }
    const Eigen::Vector2d w = A.fullPivLu().solve(h);
    const model::Case scene = of.scene(speed);
    bool undecided = false;
    const auto states = states::StateSearch(scene, speed, speed).at(speed, undecided);
    const auto near = std::ranges::find_if(
        states, [&](const auto &found) { return found.state.residual < 2 * w.norm(); });
    ASSERT_NE(near, states.end());
    // Second order: the balls move by M w/(m R), 7e-5.
    EXPECT_NEAR(near->state.residual, w.norm(), 3e-4 * w.norm());
    EXPECT_TRUE(near->state.stable.value());
}

TEST(RaceOutOfRound, MotionsEndInAStableState) {
    const double speed = 700;
    Planar of;
    of.ellipticity = 0.01;
    model::Case scene = of.scene(speed);
    scene.simulate.time = 6;
    const results::SimulateResult result = analyses::simulate_alone(scene);
    const std::vector<double> &angles = result.balancers.front().angles;
    bool undecided = false;
    const auto states = states::StateSearch(scene, speed, speed).at(speed, undecided);
    EXPECT_TRUE(std::ranges::any_of(states, [&](const auto &found) {
        const std::vector<double> &a = found.state.angles.front();
        const auto apart = [&](std::size_t i, std::size_t k) {
            return std::abs(std::remainder(a[i] - angles[k], 2 * pi));
        };
        return found.state.stable == true &&
               std::min(apart(0, 0) + apart(1, 1), apart(0, 1) + apart(1, 0)) < 1e-5;
    }));
}

// A round race at one place, one out of round at the other: branches go on over the speed.
TEST(RaceOutOfRound, StandsBesideARoundOne) {
    model::Case scene = tests::flexible_rotor(900);
    balls_of(scene.rotor.balancers[0]).rows.front().n = 2;
    balls_of(scene.rotor.balancers[1]).ellipticity = 0.01;
    scene.states = model::StatesSettings{};
    const results::SteadyStates found = states::steady_states(scene, {900, 905});
    ASSERT_FALSE(found.states.empty());
    std::map<int, std::vector<const results::SteadyState *>> branches;
    for (const results::SteadyState &state : found.states)
        branches[state.branch].push_back(&state);
    for (const auto &[number, states] : branches) {
        ASSERT_EQ(states.size(), 2U) << number;
        for (std::size_t k = 0; k < 2; ++k) // the same ball
            EXPECT_LT(
                std::abs(std::remainder(states[1]->angles[1][k] - states[0]->angles[1][k], 2 * pi)),
                0.2);
    }
}

TEST(RaceOutOfRound, WhatIsOfRoundRacesIsRefused) {
    Planar of;
    of.e = 0;
    of.ellipticity = 0.01;
    model::Case scene = of.scene(700);
    EXPECT_THROW((void)analyses::stability(scene, {}), model::AnalysisFailure);
    const results::BalanceResult result = analyses::balance(scene);
    EXPECT_EQ(result.supply->with_balancers[0], results::Supply::unknown);
    EXPECT_FALSE(result.supply->planes[0].needed[0]);
    EXPECT_FALSE(result.states->states.empty());
    balls_of(scene.rotor.balancers[0]).rows.front().n = 5;
    EXPECT_THROW((void)states::StateSearch(scene, 700, 700), model::AnalysisFailure);
}

// --- What balancers must supply ----------------------------------------------------------------

TEST(EccentricRace, BalanceCountsIt) {
    Planar of;
    of.e = 1e-4;
    for (const double speed : {400.0, 700.0, 2000.0}) {
        model::Case scene = of.scene(speed);
        scene.balance.balanced_position = false;
        scene.states.reset();
        const results::BalanceResult result = analyses::balance(scene);
        ASSERT_TRUE(result.supply);
        const Complex needed = of.needed(speed);
        EXPECT_LT(std::abs(*result.supply->planes[0].needed[0] - needed), 1e-9 * std::abs(needed));
        const bool can = std::abs(needed) <= 2 * of.ball * of.radius;
        EXPECT_EQ(result.supply->with_balancers[0],
                  can ? results::Supply::balanced : results::Supply::saturated);
        for (const results::LeftAt &left : result.supply->left)
            if (can && left.of == "plane")
                EXPECT_NEAR(*left.amplitude.balancers[0], of.e, 1e-9 * of.e);
    }
}

// Two planes of a flexible shaft: the steady state in which both centres rest asks for the same.
TEST(EccentricRace, BalanceAndStatesAgreeOnAFlexibleShaft) {
    const double speed = 900;
    model::Case scene = tests::flexible_rotor(speed);
    scene.rotor.balancers[1].imbalance_radius.reset();
    double direction = 0.3;
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balancer.tilt_inertia = false;
        balancer.imbalance /= 4;
        balls_of(balancer).eccentricity = 2e-5;
        balls_of(balancer).eccentricity_angle = direction -= 1.4;
    }
    scene.states = model::StatesSettings{};
    scene.balance.balanced_position = false;
    const results::BalanceResult result = analyses::balance(scene);
    ASSERT_TRUE(result.supply && result.states);
    const auto balanced =
        std::ranges::find_if(result.states->states, [](const results::SteadyState &state) {
            return state.kind == Kind::balanced;
        });
    ASSERT_NE(balanced, result.states->states.end());
    for (std::size_t p = 0; p < 2; ++p) {
        EXPECT_NEAR(balanced->amplitudes[p], 2e-5, 1e-10);
        const auto masses = balancers::kind_of(scene.rotor.balancers[p])->circled();
        Complex sum = 0;
        for (std::size_t j = 0; j < masses.size(); ++j)
            sum += std::polar(masses[j].moment, balanced->angles[p][j]);
        const Complex needed = *result.supply->planes[p].needed[0];
        EXPECT_LT(std::abs(sum - needed), 1e-5 * std::abs(needed)); // of the shapes of states
    }
}

TEST(EccentricRace, StabilityIsThatOfThePositionItAsksFor) {
    const double speed = 700;
    const Planar of;
    model::Case scene = of.scene(speed);
    const results::StabilityResult result = analyses::stability(scene, {});
    bool undecided = false;
    for (const auto &found : states::StateSearch(scene, speed, speed).at(speed, undecided))
        if (found.state.kind == Kind::balanced)
            EXPECT_NEAR(result.growth.front(), found.state.growth,
                        1e-6 * std::abs(found.state.growth));
}

TEST(EccentricRace, TwoCentresInOnePlaneAreRefused) {
    Planar of;
    model::Case scene = of.scene(700);
    scene.rotor.balancers.push_back(scene.rotor.balancers.front());
    balls_of(scene.rotor.balancers.back()).eccentricity_angle += 1;
    bool undecided = false;
    EXPECT_THROW((void)states::StateSearch(scene, 700, 700).at(700, undecided),
                 model::AnalysisFailure);
    scene.states.reset();
    scene.balance.balanced_position = false;
    const results::BalanceResult result = analyses::balance(scene);
    EXPECT_EQ(result.supply->with_balancers[0], results::Supply::unknown);
    EXPECT_FALSE(result.supply->planes[0].needed[0]);
}

// Balls that are held are an imbalance n m e more.
TEST(EccentricRace, HeldBallsAreAnImbalance) {
    const Planar of;
    const model::Balancer balancer = of.scene(1).rotor.balancers.front();
    const Complex left = balancers::held_masses(balancer, {1.0, 2.5}).imbalance;
    const Complex expected = of.U() + 2 * of.ball * of.centre() +
                             of.ball * of.radius * (std::polar(1.0, 1.0) + std::polar(1.0, 2.5));
    EXPECT_LT(std::abs(left - expected), 1e-15);
    Planar out_of_round;
    out_of_round.ellipticity = 0.05;
    EXPECT_LT(
        std::abs(balancers::held_masses(out_of_round.scene(1).rotor.balancers.front(), {1.0, 2.5})
                     .imbalance -
                 of.U() - of.ball * (out_of_round.place(1, 0) + out_of_round.place(2.5, 0))),
        1e-15);
}

// --- Tracks of their own -----------------------------------------------------------------------

std::string balancer_text(const std::string &keys) {
    return "[shaft]\nsegments = [{length = 1, outer = 0.05, material = \"s\"}]\n"
           "[[bearing]]\nz = 0\nk = 1e7\nc = 100\n[[bearing]]\nz = 1\nk = 1e7\nc = 100\n"
           "[[balancer]]\nz = 0.5\n" +
           keys;
}

void expect_mistake(const std::string &keys, const std::string &key, const std::string &text) {
    try {
        (void)tests::written_case(balancer_text(keys));
        ADD_FAILURE() << "accepted: " << keys;
    } catch (const model::BadInput &mistake) {
        EXPECT_NE(std::string(mistake.what()).find("balancer[0]." + key), std::string::npos)
            << mistake.what();
        EXPECT_NE(std::string(mistake.what()).find(text), std::string::npos) << mistake.what();
    }
}

TEST(Tracks, AreRowsOfOneBall) {
    const model::Case scene = tests::written_case(
        balancer_text("mass = 0.01\ndamping = 0.1\nradii = [0.1, 0.12, 0.14]\nimbalance = 1e-3\n"));
    const model::Balancer &balancer = scene.rotor.balancers.front();
    const auto kind = balancers::kind_of(balancer);
    EXPECT_NEAR(kind->reach().imbalance, 0.01 * 0.36, 1e-15);
    const auto masses = kind->circled();
    ASSERT_EQ(masses.size(), 3U);
    EXPECT_NEAR(masses[2].moment, 0.0014, 1e-15);
    EXPECT_NE(masses[0].alike, masses[1].alike);
    // The polygon of m R closes on the imbalance.
    const std::vector<double> angles = balancers::held_angles(balancer, nullptr, "balancer[0]");
    Complex sum = 1e-3;
    for (std::size_t j = 0; j < 3; ++j)
        sum += std::polar(masses[j].moment, angles[j]);
    EXPECT_LT(std::abs(sum), 1e-15);
}

// On two tracks the balls balance as the triangle of m R1, m R2 and what is needed: law of cosines.
TEST(Tracks, TwoBallsCloseATriangle) {
    Planar of;
    of.e = 0;
    of.phase = 0;
    model::Case scene = of.scene(700);
    balls_of(scene.rotor.balancers[0]).rows = {{1, 0.05, 0.08, 0.5}, {1, 0.05, 0.12, 0.5}};
    bool undecided = false;
    const double a = 0.05 * 0.08, b = 0.05 * 0.12, c = of.imbalance;
    int balanced = 0;
    for (const auto &found : states::StateSearch(scene, 700, 700).at(700, undecided)) {
        if (found.state.kind != Kind::balanced)
            continue;
        ++balanced;
        const double angle = std::acos((b * b - a * a - c * c) / (2 * a * c));
        EXPECT_NEAR(std::abs(found.state.angles[0][0]), angle, 1e-9);
    }
    EXPECT_EQ(balanced, 2); // and its mirror image
}

TEST(Tracks, MistakesAreNamed) {
    const std::string balls = "mass = 0.01\nradii = ";
    expect_mistake(balls + "[0.1, 0.105]\n", "radii", "leave room");
    expect_mistake(balls + "[]\n", "radii", "one a ball");
    expect_mistake(balls + "[0.1, -0.1]\n", "radii", "above 0 m");
    expect_mistake(balls + "[0.1, 0.2]\nn = 2\n", "n", "got both");
    expect_mistake(balls + "[0.1, 0.2]\nradius = 0.1\n", "radius", "got both");
    expect_mistake(balls + "[0.1, 0.2]\ncontact = true\n", "contact", "got both");
    expect_mistake("kind = \"pendulum4\"\nmass = 1\narm = 0.1\npivot = 0.1\nradii = [0.1]\n",
                   "radii", "only with kind = \"ball\"");
    const std::string race = "mass = 0.01\nradius = 0.1\n";
    expect_mistake(race + "eccentricity = 0.02\n", "eccentricity", "a tenth of the radius");
    expect_mistake(race + "eccentricity = -1e-4\n", "eccentricity", "0 or more");
    expect_mistake(race + "eccentricity_angle = 1\n", "eccentricity_angle", "alone");
    expect_mistake(race + "eccentricity = 1e-4\nrolling_resistance = 1e-5\n", "eccentricity",
                   "resist rolling");
    expect_mistake(race + "ellipticity = 0.2\n", "ellipticity", "[0, 0.1]");
    expect_mistake(race + "ellipticity_angle = 1\n", "ellipticity_angle", "alone");
    for (const std::string other : {"contact = true\n", "rolling_resistance = 1e-5\n"})
        expect_mistake(race + "ellipticity = 1e-3\n" + other, "ellipticity", "touch or resist");
    expect_mistake(race + "ellipticity = 1e-3\nheld = true\n", "held", "out of round");
    expect_mistake(race + "release_speed = 0\n", "release_speed", "greater than 0");
    expect_mistake(race + "release_speed = 100\ncontact = true\n", "release_speed",
                   "pass each other");
}

// --- Balls held up to a speed ------------------------------------------------------------------

TEST(Release, SpinReachesASpeed) {
    using simulation::Spin;
    EXPECT_EQ(Spin(300).reaches(200), 0);
    EXPECT_FALSE(Spin(100).reaches(200));
    const std::vector<std::pair<double, double>> run_up{{1, 100}, {2, 300}, {3, 300}, {5, -500}};
    const Spin spin(run_up);
    EXPECT_NEAR(spin.reaches(200).value(), 1.5, 1e-15);
    EXPECT_NEAR(spin.reaches(400).value(), 4.75, 1e-14); // backwards
    EXPECT_EQ(spin.reaches(300), 2);
    EXPECT_FALSE(spin.reaches(501));
}

// Until they are released the balls are those of a balancer held, an imbalance; then they move.
TEST(Release, BallsAreHeldUntilTheSpeed) {
    Planar of;
    model::Case scene = of.scene(0);
    scene.simulate.time = 6;
    scene.simulate.run_up = {{0, 50}, {2, 700}};
    scene.simulate.ball_angles = {{0.3, 2.2}};
    balls_of(scene.rotor.balancers[0]).release_speed = 600;
    const results::SimulateResult result = analyses::simulate_alone(scene);
    model::Case held = scene;
    held.rotor.balancers[0].held = true;
    balancers::hold(held);
    const results::SimulateResult as_held = analyses::simulate_alone(held);
    std::size_t compared = 0;
    double largest = 0;
    for (std::size_t k = 0; k < result.series.time.size(); ++k)
        largest = std::max(largest, result.series.amplitude[0][k]);
    const auto middle = std::ranges::find_if(as_held.stations,
                                             [](const auto &station) { return station.z == 0.5; });
    ASSERT_NE(middle, as_held.stations.end());
    const std::vector<double> &expected =
        as_held.series.amplitude[static_cast<std::size_t>(middle - as_held.stations.begin())];
    for (std::size_t k = 0; k < result.series.time.size() && result.series.time[k] <= 550.0 / 325;
         ++k) {
        ++compared;
        EXPECT_EQ(result.series.angles[0][k], 0.3);
        EXPECT_EQ(result.series.angles[1][k], 2.2);
        // Largest of a step by a polynomial each: 1e-5 of the motion.
        EXPECT_NEAR(result.series.amplitude[0][k], expected[k], 1e-4 * largest)
            << result.series.time[k];
    }
    EXPECT_GT(compared, 100U);
    EXPECT_NE(result.series.angles[0].back(), 0.3);
    EXPECT_NEAR(result.balancers.front().amplitude, of.e, 1e-4 * of.e);
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-6 * result.audit.momentum_scale);
}

TEST(Release, ASpeedThatIsNeverReachedIsRefused) {
    model::Case scene = Planar().scene(300);
    balls_of(scene.rotor.balancers[0]).release_speed = 375;
    EXPECT_THROW((void)simulation::motion_scene(scene), model::BadInput);
    scene.speeds = model::SpeedRange{400, 400, 1}; // free from the start
    EXPECT_EQ(simulation::motion_scene(scene).parts.free.front().from, 0);
}

} // namespace
} // namespace whirl::races

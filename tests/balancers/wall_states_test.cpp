// Steady states with balls at walls: against all pairs of angles by bisection and Newton's method,
// rotors that have the balls at walls as masses of their own, and motions in time.

#include "analyses/simulate.h"
#include "balancers/kind.h"
#include "results/simulate.h"
#include "states/branches.h"
#include "states/matching.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace whirl::wall_states {
namespace {

using Complex = std::complex<double>;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

model::Balls &balls_of(model::Balancer &balancer) { return std::get<model::Balls>(balancer.parts); }

/// A planar rotor, k - M W^2 + i c W, with two balls between walls.
struct Planar {
    tests::RigidJeffcott rotor;
    double ball = 0.05;      ///< kg
    double radius = 0.1;     ///< m
    double diameter = 0.02;  ///< m
    double drag = 0.5;       ///< N s/m
    double imbalance = 3e-3; ///< kg m
    double ellipticity = 0;
    double long_axis = 2; ///< rad
    std::vector<double> walls{1.4, -0.5};

    [[nodiscard]] model::Case scene(double speed) const {
        model::Case scene = rotor.scene();
        scene.name = "walls";
        model::Balancer balancer = tests::ball_balancer(0.5, 2, ball, radius, drag, imbalance);
        balancer.tilt_inertia = false;
        balls_of(balancer).rows.front().diameter = diameter;
        balls_of(balancer).walls = walls;
        balls_of(balancer).restitution = 0.4;
        balls_of(balancer).ellipticity = ellipticity;
        balls_of(balancer).ellipticity_angle = long_axis;
        scene.rotor.balancers = {balancer};
        scene.states = model::StatesSettings{};
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 6;
        return scene;
    }
    [[nodiscard]] double rho(double a) const {
        return radius * (1 + ellipticity * std::cos(2 * (a - long_axis)));
    }
    [[nodiscard]] double slope(double a) const {
        return -2 * radius * ellipticity * std::sin(2 * (a - long_axis));
    }
    [[nodiscard]] Complex deflection(double a, double b, double speed) const {
        const Complex D(rotor.kx - (rotor.mass + 2 * ball) * speed * speed, rotor.c * speed);
        return speed * speed *
               (imbalance + ball * (std::polar(rho(a), a) + std::polar(rho(b), b))) / D;
    }
    /// Torque on the ball at a over m W^2, the other one at b, m2.
    [[nodiscard]] double push(double a, double b, double speed) const {
        const Complex out = std::polar(1.0, a);
        return std::real(std::conj(deflection(a, b, speed) + rho(a) * out) *
                         Complex(slope(a), rho(a)) * out);
    }
    /// Distance of the plane of a wall from the centre of a ball less its radius, m.
    [[nodiscard]] double room(double a, double wall) const {
        return rho(a) * std::abs(std::sin(a - wall)) - diameter / 2;
    }
    [[nodiscard]] bool is_free(double a) const {
        return std::ranges::none_of(
            walls, [&](double wall) { return std::cos(a - wall) > 0 && room(a, wall) < 0; });
    }
    struct Stop {
        double angle;
        int towards; ///< the wall
    };
    [[nodiscard]] std::vector<Stop> stops() const {
        std::vector<Stop> out;
        for (const double wall : walls)
            for (const int side : {-1, 1}) {
                double near = wall;
                double far = wall + side * pi / 2;
                for (int i = 0; i < 60; ++i) {
                    const double middle = (near + far) / 2;
                    (room(middle, wall) < 0 ? near : far) = middle;
                }
                out.push_back({far, -side});
            }
        return out;
    }
    /// Force on the wall at a stop, N.
    [[nodiscard]] double wall_force(double a, double b, double wall, double speed) const {
        const double arm = std::abs(rho(a) * std::cos(a - wall) + slope(a) * std::sin(a - wall));
        return ball * speed * speed * std::abs(push(a, b, speed)) / arm;
    }
};

struct Pair {
    double a, b;
    bool a_rests = false, b_rests = false;
};
bool same_angle(double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)) < 1e-7; }
bool same_pair(const Pair &p, double a, double b) {
    return (same_angle(p.a, a) && same_angle(p.b, b)) || (same_angle(p.a, b) && same_angle(p.b, a));
}

/// Roots of f over a turn.
std::vector<double> roots_around(const auto &f) {
    constexpr int parts = 4000;
    std::vector<double> out;
    for (int i = 0; i < parts; ++i) {
        double low = 2 * pi * (i + 0.123) / parts;
        double high = 2 * pi * (i + 1.123) / parts;
        if ((f(low) > 0) == (f(high) > 0))
            continue;
        for (int k = 0; k < 60; ++k) {
            const double middle = (low + high) / 2;
            ((f(middle) > 0) == (f(low) > 0) ? low : high) = middle;
        }
        out.push_back((low + high) / 2);
    }
    return out;
}

/// Every pair of places of two balls: free by Newton's method from a grid of starts, one at a stop
/// and one free by bisection, both at stops.
std::vector<Pair> all_pairs(const Planar &of, double speed) {
    std::vector<Pair> out;
    const auto add = [&](const Pair &pair) {
        if (std::ranges::none_of(
                out, [&](const Pair &other) { return same_pair(other, pair.a, pair.b); }))
            out.push_back(pair);
    };
    constexpr int starts = 20;
    for (int k = 0; k < starts * starts; ++k) {
        Eigen::Vector2d x(2 * pi / starts * (k % starts + 0.3), 2 * pi / starts * (k / starts));
        const auto left = [&](const Eigen::Vector2d &at) {
            return Eigen::Vector2d(of.push(at(0), at(1), speed), of.push(at(1), at(0), speed));
        };
        for (int step = 0; step < 30; ++step) {
            Eigen::Matrix2d J;
            constexpr double small = 1e-6;
            for (int j = 0; j < 2; ++j)
                J.col(j) = (left(x + small * Eigen::Vector2d::Unit(j)) -
                            left(x - small * Eigen::Vector2d::Unit(j))) /
                           (2 * small);
            x -= J.fullPivLu().solve(left(x));
        }
        if (left(x).norm() < 1e-13 * of.radius * of.radius && of.is_free(x(0)) && of.is_free(x(1)))
            add({x(0), x(1)});
    }
    const auto stops = of.stops();
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const double at = stops[i].angle;
        for (const double b : roots_around([&](double a) { return of.push(a, at, speed); }))
            if (of.is_free(b) && stops[i].towards * of.push(at, b, speed) > 0)
                add({at, b, true, false});
        for (std::size_t k = 0; k <= i; ++k) {
            const double other = stops[k].angle;
            if (stops[i].towards * of.push(at, other, speed) > 0 &&
                stops[k].towards * of.push(other, at, speed) > 0)
                add({at, other, true, true});
        }
    }
    return out;
}

TEST(WallStates, AreAllPairsOfPlaces) {
    int resting = 0;
    for (const double ellipticity : {0.0, 2e-3, 0.05})
        for (const double speed : {150.0, 305.0, 350.0, 700.0}) {
            Planar of;
            of.ellipticity = ellipticity;
            const model::Case scene = of.scene(speed);
            bool undecided = false;
            const auto states = states::StateSearch(scene, speed, speed).at(speed, undecided);
            EXPECT_FALSE(undecided);
            const auto expected = all_pairs(of, speed);
            EXPECT_EQ(states.size(), expected.size()) << ellipticity << " " << speed;
            for (const auto &found : states) {
                const std::vector<double> &a = found.state.angles.front();
                const auto pair = std::ranges::find_if(
                    expected, [&](const Pair &one) { return same_pair(one, a[0], a[1]); });
                ASSERT_NE(pair, expected.end()) << a[0] << " " << a[1];
                const bool rests = pair->a_rests || pair->b_rests;
                resting += rests;
                EXPECT_EQ(found.state.kind == Kind::at_wall, rests);
                EXPECT_NEAR(found.state.residual, std::abs(of.deflection(a[0], a[1], speed)),
                            1e-8 * found.state.residual + 1e-15);
                const std::vector<double> &forces = found.state.wall_forces.front();
                for (const std::size_t k : {0U, 1U}) {
                    const bool held = same_angle(a[k], pair->a) ? pair->a_rests : pair->b_rests;
                    EXPECT_EQ(forces[k] > 0, held);
                    for (const double wall : of.walls)
                        if (held && std::abs(of.room(a[k], wall)) < 1e-9 &&
                            std::cos(a[k] - wall) > 0) {
                            const double force = of.wall_force(a[k], a[1 - k], wall, speed);
                            EXPECT_NEAR(forces[k], force, 1e-8 * force);
                        }
                }
            }
        }
    EXPECT_GT(resting, 20);
}

// A ball at a wall is a mass of the rotor: one free ball beside it on a heavier rotor, with its
// imbalance.
TEST(WallStates, SmallMotionsAreThoseWithTheBallFixed) {
    const Planar of;
    int compared = 0;
    for (const double speed : {150.0, 305.0, 700.0}) {
        const model::Case scene = of.scene(speed);
        const states::StateSearch search(scene, speed, speed);
        bool undecided = false;
        for (const auto &found : search.at(speed, undecided)) {
            const std::vector<double> &forces = found.state.wall_forces.front();
            if (std::ranges::count_if(forces, [](double force) { return force > 0; }) != 1)
                continue;
            const std::size_t free = forces[0] > 0 ? 1 : 0;
            const std::vector<double> &a = found.state.angles.front();
            model::Case fixed = scene;
            fixed.rotor.discs.front().mass += of.ball;
            fixed.rotor.imbalances = {tests::imbalance_at(0.5, of.ball * of.radius, a[1 - free])};
            model::Balls &balls = balls_of(fixed.rotor.balancers.front());
            balls.walls.clear();
            balls.rows.front().n = 1;
            bool ignored = false;
            const auto others = states::StateSearch(fixed, speed, speed).at(speed, ignored);
            const auto same = std::ranges::find_if(others, [&](const auto &other) {
                return same_angle(other.state.angles.front().front(), a[free]);
            });
            ASSERT_NE(same, others.end());
            EXPECT_NEAR(found.state.growth, same->state.growth, 1e-8 * speed);
            EXPECT_EQ(found.state.growing, same->state.growing);
            ++compared;
        }
    }
    EXPECT_GT(compared, 4);
}

TEST(WallStates, MotionsThatComeToRestAreInOneOfThem) {
    const double speed = 700;
    const Planar of;
    const model::Case scene = of.scene(speed);
    const results::SteadyStates states = states::steady_states(scene, {speed});
    int at_wall = 0;
    for (const std::array<double, 2> start :
         {std::array{0.3, -1.5}, {0.5, 0.9}, {2.0, 3.0}, {-0.2, 2.6}, {1.7, -0.8}}) {
        model::Case started = scene;
        started.simulate.ball_angles = {{start[0], start[1]}};
        const results::SimulateResult result = analyses::simulate_alone(started);
        const std::vector<double> &ends = result.balancers.front().angles;
        const auto own = std::ranges::find_if(states.states, [&](const auto &state) {
            const std::vector<double> &a = state.angles.front();
            const auto apart = [&](std::size_t i, std::size_t k) {
                return std::abs(std::remainder(a[i] - ends[k], 2 * pi));
            };
            return std::min(apart(0, 0) + apart(1, 1), apart(0, 1) + apart(1, 0)) < 1e-3;
        });
        ASSERT_NE(own, states.states.end()) << ends[0] << " " << ends[1];
        EXPECT_EQ(own->stable, true);
        at_wall += own->kind == Kind::at_wall;
        // Between the walls where they started: on the same side of 1.4 after -0.5.
        const auto between = [&](double angle) {
            const auto turned = [](double a) { return a - 2 * pi * std::floor(a / (2 * pi)); };
            return turned(angle - of.walls[1]) < turned(of.walls[0] - of.walls[1]);
        };
        for (const std::size_t k : {0U, 1U})
            EXPECT_EQ(between(ends[k]), between(start[k]));
    }
    EXPECT_GE(at_wall, 2);
}

// A ball that meets a wall or leaves it as the speed changes: as many states come or go there as
// pairs of places do, and one branch goes on as another or ends with it.
TEST(WallStates, BranchesEndWhereBallsMeetWalls) {
    for (const double ellipticity : {0.0, 0.01}) {
        Planar of;
        of.ellipticity = ellipticity;
        std::vector<double> speeds;
        for (double speed = 240; speed <= 400; speed += 4)
            speeds.push_back(speed);
        const results::SteadyStates found = states::steady_states(of.scene(240), speeds);
        EXPECT_TRUE(found.undecided.empty());
        using BorderKind = results::SteadyBorder::Kind;
        int walls = 0;
        int gone_on = 0;
        constexpr double same = 1e-6; // of the speed: two branches that end together
        // Of a branch that is there between two speeds of the list only one end is seen.
        const auto crowded = [&](double speed) {
            return std::ranges::any_of(found.borders, [&](const auto &one) {
                const double apart = std::abs(one.speed - speed);
                return apart > same * speed && apart < 4;
            });
        };
        std::map<double, int> change; // of the number of states
        for (const results::SteadyBorder &border : found.borders) {
            EXPECT_NE(border.kind, BorderKind::undecided);
            const auto before = change.lower_bound(border.speed * (1 - same));
            const bool known = before != change.end() && before->first < border.speed * (1 + same);
            int &own = known ? before->second : change[border.speed];
            if (border.growing_below < 0)
                own += border.other ? 2 : 1;
            if (border.growing_above < 0)
                own -= border.other ? 2 : 1;
            if (border.kind != BorderKind::wall)
                continue;
            ++walls;
            // Of two balls that come to a wall together a third branch.
            EXPECT_TRUE(crowded(border.speed) ||
                        std::ranges::any_of(found.borders,
                                            [&](const auto &one) {
                                                return one.kind == BorderKind::wall && one.other &&
                                                       std::abs(one.speed - border.speed) <
                                                           same * border.speed;
                                            }))
                << border.speed;
            gone_on += border.growing_below >= 0 && border.growing_above >= 0;
        }
        EXPECT_GT(walls, 2);
        EXPECT_GT(gone_on, 0);
        int compared = 0;
        for (const auto &[speed, by] : change) {
            if (crowded(speed))
                continue;
            ++compared;
            constexpr double near = 1e-5;
            const auto below = std::ssize(all_pairs(of, speed * (1 - near)));
            const auto above = std::ssize(all_pairs(of, speed * (1 + near)));
            EXPECT_EQ(above - below, by) << speed << " " << ellipticity;
        }
        EXPECT_GT(compared, 2);
    }
}

// Nothing but the walls marks a direction: balls press on them, as the deflected rotor lags behind.
TEST(WallStates, WithoutImbalanceBallsLeanOnWalls) {
    Planar of;
    of.imbalance = 0;
    for (const double speed : {150.0, 700.0}) {
        bool undecided = false;
        const auto states = states::StateSearch(of.scene(speed), speed, speed).at(speed, undecided);
        int resting = 0;
        for (const auto &found : states) {
            resting += found.state.kind == Kind::at_wall;
            const std::vector<double> &a = found.state.angles.front();
            if (found.state.kind == Kind::at_wall)
                EXPECT_NEAR(found.state.residual, std::abs(of.deflection(a[0], a[1], speed)),
                            1e-8 * found.state.residual);
        }
        EXPECT_GT(resting, 2);
    }
}

// Two balls without an imbalance stand opposite each other at any angle that the walls leave free
// at both ends of a diameter, and round rotors move alike at all of them.
TEST(WallStates, APairStandsWhereverADiameterIsFree) {
    constexpr double speed = 700;
    const auto balanced = [](const Planar &of) {
        bool undecided = false;
        auto states = states::StateSearch(of.scene(speed), speed, speed).at(speed, undecided);
        EXPECT_FALSE(undecided);
        std::erase_if(states, [](const auto &found) { return found.state.kind != Kind::balanced; });
        return states;
    };
    Planar open;
    open.imbalance = 0;
    open.walls = {};
    const auto without = balanced(open);
    ASSERT_EQ(without.size(), 1);
    int none = 0;
    for (const double diameter : {0.02, 0.15}) // half widths of walls 5.7 and 48.6 deg
        for (const std::vector<double> &walls :
             {std::vector<double>{pi / 2}, {-pi / 2}, {0}, {2 * pi / 3, -pi / 2}, {0, pi / 2}}) {
            Planar of = open;
            of.diameter = diameter;
            of.walls = walls;
            bool room = false;
            for (double a = 0; a < pi; a += 1e-3)
                room = room || (of.is_free(a) && of.is_free(a + pi));
            none += room ? 0 : 1;
            const auto states = balanced(of);
            ASSERT_EQ(states.size(), room ? 1 : 0) << diameter << " " << walls[0];
            if (!room)
                continue;
            EXPECT_TRUE(states[0].state.family);
            for (const double a : states[0].state.angles[0])
                EXPECT_TRUE(of.is_free(a));
            EXPECT_NEAR(states[0].state.growth, without[0].state.growth,
                        1e-9 * std::abs(without[0].state.growth));
        }
    EXPECT_GT(none, 0);
}

// A fold is one whatever the steps, also where its partner ends at a wall within the same one.
TEST(WallStates, AFoldIsOneOnAnyGrid) {
    Planar of;
    of.rotor.kx = of.rotor.ky = 1e5;
    of.rotor.c = 200;
    of.radius = 0.06;
    of.drag = 1;
    of.walls = {2 * pi / 3, -pi / 2};
    for (const int count : {3, 21}) {
        const auto found =
            states::steady_states(of.scene(80), model::SpeedRange{80, 85, count}.values());
        using BorderKind = results::SteadyBorder::Kind;
        const auto fold =
            std::ranges::find(found.borders, BorderKind::fold, &results::SteadyBorder::kind);
        ASSERT_NE(fold, found.borders.end()) << count;
        EXPECT_NEAR(fold->speed, 83.8217, 1e-4);
        // Two states less beyond, by Newton's method from many starts.
        EXPECT_EQ(all_pairs(of, 83.82).size(), all_pairs(of, 83.823).size() + 2);
    }
}

} // namespace
} // namespace whirl::wall_states

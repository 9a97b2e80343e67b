// All steady states of rotors with balancers, against closed forms and other eigenvalues.

#include "analyses/steady_states.h"
#include "balancers/arrangement.h"
#include "ends/growth.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "stability/rotor_at_speeds.h"
#include "states/branches.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace whirl::states {
namespace {

using results::SteadyState;
using Kind = results::SteadyState::Kind;
using std::numbers::pi;

std::vector<StateSearch::Found> all_at(const model::Case &scene, double speed) {
    bool undecided = false;
    const StateSearch search(scene, speed, speed);
    auto out = search.at(speed, undecided);
    EXPECT_FALSE(undecided);
    return out;
}

int count(const std::vector<StateSearch::Found> &states, Kind kind) {
    return static_cast<int>(std::ranges::count_if(
        states, [kind](const StateSearch::Found &found) { return found.state.kind == kind; }));
}

/// A planar Jeffcott rotor (point mass on kx = ky and c) with n balls.
struct PlanarJeffcott {
    tests::RigidJeffcott rotor;
    int n = 2;
    double ball = 0.05;  ///< kg
    double radius = 0.1; ///< m
    double drag = 0.5;   ///< N s/m
    double imbalance = 0.004;

    [[nodiscard]] model::Case scene() const {
        model::Case scene = rotor.scene();
        scene.name = "jeffcott";
        scene.rotor.balancers = {tests::ball_balancer(0.5, n, ball, radius, drag, imbalance)};
        scene.states = model::StatesSettings{};
        return scene;
    }
    [[nodiscard]] std::complex<double> dynamic(double speed) const {
        return {rotor.kx - (rotor.mass + n * ball) * speed * speed, rotor.c * speed};
    }
};

TEST(StateSearch, PlanarJeffcottHasTheStatesOfItsClosedForm) {
    // W = Omega^2 (U + b e^{i t})/D: balls at t, b = m R (p - q), on the line of W where
    // Im e^{-i t} W = 0, that is U sin(t + arg D) = -b sin(arg D); for b = 0 one direction.
    for (const int n : {1, 2, 3, 4, 6}) {
        PlanarJeffcott jeffcott;
        jeffcott.n = n;
        jeffcott.ball = 0.1 / n;
        for (const double imbalance : {0.003, 0.0085, 0.02}) {
            jeffcott.imbalance = imbalance;
            for (const double speed : {60.0, 200.0, 305.0, 330.0, 700.0}) {
                const auto states = all_at(jeffcott.scene(), speed);
                const std::complex<double> D = jeffcott.dynamic(speed);
                const double moment = jeffcott.ball * jeffcott.radius;
                const bool can = n > 1 && imbalance <= n * moment;
                int expected = can ? 1 : 0;
                EXPECT_EQ(count(states, Kind::balanced), can ? 1 : 0);
                for (int opposite = 0; 2 * opposite <= n; ++opposite) {
                    const double b = moment * (n - 2 * opposite);
                    const double sine = -b / imbalance * std::sin(std::arg(D));
                    if (std::abs(sine) > 1)
                        continue;
                    std::vector<double> directions{std::asin(sine) - std::arg(D)};
                    if (b > 1e-12)
                        directions.push_back(pi - std::asin(sine) - std::arg(D));
                    for (const double t : directions) {
                        ++expected;
                        const double residual =
                            std::abs(speed * speed * (imbalance + b * std::polar(1.0, t)) / D);
                        const auto is_there = [&](const StateSearch::Found &found) {
                            int at_ends[2] = {0, 0};
                            for (const double angle : found.state.angles[0])
                                for (const int end : {0, 1})
                                    at_ends[end] += std::abs(std::remainder(angle - t - end * pi,
                                                                            2 * pi)) < 1e-9;
                            return at_ends[0] + at_ends[1] == n &&
                                   (at_ends[1] == opposite ||
                                    (b < 1e-12 && at_ends[0] == opposite)) &&
                                   std::abs(found.state.residual - residual) < 1e-9 * residual;
                        };
                        EXPECT_EQ(std::ranges::count_if(states, is_there), 1)
                            << n << " balls, " << opposite << " opposite at " << t;
                    }
                }
                EXPECT_EQ(states.size(), expected);
            }
        }
    }
}

TEST(StateSearch, BalancedStateIsAsStableAsItsLinearElementSays) {
    // Without slopes the forms agree; the other way to the same eigenvalues.
    for (const double speed : {200.0, 320.0, 340.0, 500.0, 900.0}) {
        model::Case scene = PlanarJeffcott{}.scene();
        scene.speeds = model::SpeedRange{speed, speed, 1};
        const auto states = all_at(scene, speed);
        const auto balanced = std::ranges::find_if(states, [](const StateSearch::Found &found) {
            return found.state.kind == Kind::balanced;
        });
        ASSERT_NE(balanced, states.end());
        const double growth = ends::Growth(stability::stability_model(scene, {speed}),
                                           balancers::arrangement_at_balance(scene.rotor), {speed})
                                  .at(speed);
        EXPECT_NEAR(balanced->state.growth, growth, 1e-7 * speed);
        EXPECT_LT(balanced->state.residual, 1e-15);
    }
}

TEST(StateSearch, PublishedBordersOfTwoBallsInAPlane) {
    // K. Green, A. R. Champneys, N. J. Lieven, Bifurcation analysis of an automatic dynamic
    // balancing mechanism for eccentric rotors, J. Sound Vib. 291 (2006): mu = m/M = 0.05,
    // delta = eps/R = 0.01, zeta = beta = 0.01. In units of M, R and sqrt(k/M): balanced stable
    // from 1.030 to 1.094 and above 1.882 (three digits).
    const model::Case scene = tests::jeffcott_two_balls(0.05);
    const auto balanced_stable = [&scene](double speed) {
        for (const StateSearch::Found &found : all_at(scene, speed))
            if (found.state.kind == Kind::balanced)
                return found.state.stable == true;
        return false;
    };
    EXPECT_FALSE(balanced_stable(0.9));
    EXPECT_FALSE(balanced_stable(1.0));
    EXPECT_TRUE(balanced_stable(1.06));
    EXPECT_FALSE(balanced_stable(1.2));
    EXPECT_FALSE(balanced_stable(1.8));
    EXPECT_TRUE(balanced_stable(2.0));
}

TEST(StateSearch, RaceOfTwoPlanesByItself) {
    // Two planes with two balls, static imbalance in the middle of a symmetric rotor: states come
    // with their mirror image, planes exchanged.
    const auto states = all_at(tests::rodrigues_rotor(2.6, 0.01, 0.01), 2.6);
    EXPECT_EQ(count(states, Kind::balanced), 1);
    EXPECT_EQ(count(states, Kind::partly_balanced) % 2, 0);
    for (const StateSearch::Found &found : states) {
        EXPECT_LT(found.state.defect, 1e-9);
        const double left = found.state.amplitudes[0];
        const double right = found.state.amplitudes[1];
        EXPECT_EQ(
            std::ranges::count_if(states,
                                  [&](const StateSearch::Found &other) {
                                      return std::abs(other.state.amplitudes[0] - right) < 1e-9 &&
                                             std::abs(other.state.amplitudes[1] - left) < 1e-9;
                                  }) > 0,
            true);
    }
}

TEST(StateSearch, MoreStatesThanNewtonFromRandomStarts) {
    // From 3000 random starts Newton's method finds no state that the search has not.
    for (const double speed : {1.2, 2.0, 3.1}) {
        const model::Case scene = tests::rodrigues_rotor(speed, 0.0012, 0.0008);
        const StateSearch search(scene, speed, speed);
        bool undecided = false;
        const auto states = search.at(speed, undecided);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> angle(-pi, pi);
        int found_again = 0;
        for (int run = 0; run < 3000; ++run) {
            Eigen::VectorXd angles(4);
            for (double &one : angles)
                one = angle(random);
            Eigen::VectorXd x = search.equations().with_angles(angles, speed);
            if (search.equations().refine(x, speed, 0.001) > 1e-10)
                continue;
            ++found_again;
            const auto w = search.equations().deflections(x);
            const auto close = [](double a, double b) {
                return std::abs(std::remainder(a - b, 2 * pi)) < 1e-6;
            };
            EXPECT_TRUE(std::ranges::any_of(states,
                                            [&](const StateSearch::Found &state) {
                                                for (const Eigen::Index first : {0, 2}) {
                                                    const auto a = x.tail(4).segment<2>(first);
                                                    const auto b =
                                                        state.x.tail(4).segment<2>(first);
                                                    if (!(close(a(0), b(0)) && close(a(1), b(1))) &&
                                                        !(close(a(0), b(1)) && close(a(1), b(0))))
                                                        return false;
                                                }
                                                return true;
                                            }))
                << x.tail(4).transpose() << " deflections " << std::abs(w[0]) << " "
                << std::abs(w[1]);
        }
        EXPECT_GT(found_again, 100);
    }
}

// Far below the critical speed the balls of an undamped rotor leave the side opposite to the
// imbalance U as W^2 sqrt(U/(k r)), W the speed; those on its side swing. Nothing is decided by
// rounding, neither by that of the rotor's motions, which are 1e7 times as fast, nor by that of two
// equal roots.
TEST(StateSearch, SlowMotionsOfBallsGrowAsInClosedFormOrAreNotJudged) {
    PlanarJeffcott jeffcott;
    jeffcott.rotor.c = 0;
    jeffcott.drag = 0;
    const double slowness = std::sqrt(jeffcott.imbalance / (jeffcott.rotor.kx * jeffcott.radius));
    for (const double speed : {1e-5, 0.013, 0.1, 0.3}) {
        for (const StateSearch::Found &found : all_at(jeffcott.scene(), speed)) {
            const SteadyState &state = found.state;
            if (state.kind != Kind::coincident)
                continue;
            EXPECT_GT(state.growth_error, 0);
            if (speed < 1e-3 || state.stable != false) {
                EXPECT_EQ(state.stable, std::nullopt) << speed;
                EXPECT_EQ(state.growing, 0) << speed;
                EXPECT_LE(state.growth, state.growth_error) << speed;
                continue;
            }
            const double expected = speed * speed * slowness;
            EXPECT_EQ(state.growing, 1) << speed;
            EXPECT_NEAR(state.growth, expected, 1e-5 * expected) << speed; // (W/W0)^2
            EXPECT_LE(state.growth_error, 1e-3 * expected) << speed;
        }
        if (speed > 1e-3) {
            const auto found = all_at(jeffcott.scene(), speed);
            EXPECT_TRUE(std::ranges::any_of(found, [](const StateSearch::Found &one) {
                return one.state.kind == Kind::coincident && one.state.stable == false;
            })) << speed;
        }
    }
}

// Rings that turn about themselves without friction, on an undamped rotor: rounding makes a small
// root that grows of two that are zero, and its error is no less than it.
TEST(StateSearch, DoubleRootsAtZeroAreNotJudged) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/ring_jeffcott");
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c.setZero();
    auto &rings = std::get<model::Rings>(scene.rotor.balancers[0].parts);
    rings.damping = rings.drag = 0;
    for (const double speed : {1.0, 2.4131, 4.5291, 56.2055, 371.6224}) {
        int neutral = 0;
        for (const StateSearch::Found &found : all_at(scene, speed)) {
            EXPECT_NE(found.state.stable, true) << speed; // roots come in pairs, l and -l
            if (!found.state.stable) {
                ++neutral;
                EXPECT_LE(found.state.growth, found.state.growth_error) << speed;
            }
        }
        EXPECT_EQ(neutral, 1) << speed;
    }
}

TEST(StateSearch, RefusesWhatIsNotSteady) {
    model::Case scene = PlanarJeffcott{}.scene();
    scene.speeds = model::SpeedRange{300, 300, 1};
    std::vector<results::Sentence> notes;
    EXPECT_TRUE(analyses::steady_states_of(scene, notes));
    EXPECT_TRUE(notes.empty());
    model::Case anisotropic = scene;
    anisotropic.rotor.bearings[0].rows[0].k(0, 0) *= 2;
    EXPECT_FALSE(analyses::steady_states_of(anisotropic, notes));
    ASSERT_EQ(notes.size(), 1);
    EXPECT_NE(notes[0].text().find("bearings that are the same in x and y"), std::string::npos);
    model::Case many = scene;
    tests::row(many.rotor.balancers[0]).n = 7;
    EXPECT_THROW(StateSearch(many, 300, 300), model::AnalysisFailure);
    model::Case none = scene;
    none.rotor.balancers.clear();
    EXPECT_THROW((void)steady_states(none, {300}), model::AnalysisFailure);
    // Nothing marks a direction: with damping balanced positions alone are steady.
    model::Case even = scene;
    even.rotor.balancers[0].imbalance = 0;
    const auto states = all_at(even, 300);
    ASSERT_EQ(states.size(), 1);
    EXPECT_TRUE(states[0].state.family);
    EXPECT_LT(states[0].state.residual, 1e-15);
    EXPECT_TRUE(steady_states(scene, {0}).states.empty());
}

// Six balls at one angle have many equal roots, on which one of the eigensolvers fails.
TEST(StateSearch, EveryStateOfSixBallsHasItsEigenvalues) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/six_balls");
    const std::vector<double> speeds = model::SpeedRange{50 * pi / 30, 800 * pi, 31}.values();
    const results::SteadyStates states = steady_states(scene, speeds);
    EXPECT_GT(states.states.size(), 100);
    for (const SteadyState &state : states.states) {
        EXPECT_EQ(state.why, "");
        EXPECT_TRUE(std::isfinite(state.growth));
        EXPECT_GE(state.growing, 0);
    }
}

// Balls at one angle move against each other in n - 1 motions, each of a ball in the push m W^2 w
// of a deflection that stays, and together as one ball of n times the mass.
TEST(StateSearch, EqualRootsOfBallsAtOneAngleAreCountedEach) {
    const auto at_one_angle = [](const model::Case &scene, double speed) {
        std::vector<StateSearch::Found> out = all_at(scene, speed);
        std::erase_if(out, [](const auto &found) { return found.state.kind != Kind::coincident; });
        return out;
    };
    int compared = 0;
    for (const int n : {3, 5}) {
        PlanarJeffcott many;
        many.rotor.kx = many.rotor.ky = 1e5;
        many.rotor.c = 200;
        many.radius = 0.06;
        many.drag = 1;
        many.imbalance = 0.003;
        many.n = n;
        PlanarJeffcott one = many;
        one.n = 1;
        one.ball *= n;
        one.drag *= n;
        for (double speed = 130; speed <= 320; speed += 2.5) {
            const auto together = at_one_angle(one.scene(), speed);
            for (const StateSearch::Found &found : at_one_angle(many.scene(), speed)) {
                const double angle = found.state.angles[0][0];
                const std::complex<double> w =
                    speed * speed *
                    (many.imbalance + n * many.ball * many.radius * std::polar(1.0, angle)) /
                    many.dynamic(speed);
                const bool inwards = std::real(w * std::polar(1.0, -angle)) < 0;
                for (const StateSearch::Found &alone : together)
                    if (std::abs(std::remainder(alone.state.angles[0][0] - angle, 2 * pi)) < 1e-6) {
                        ++compared;
                        EXPECT_EQ(found.state.growing, alone.state.growing + (inwards ? n - 1 : 0))
                            << n << " at " << speed;
                    }
            }
        }
    }
    EXPECT_GT(compared, 200);
}

// Where the imbalance of a round rotor stands changes no branch: with one phase the line of the
// balls passes angle 0 between two speeds, W arg = phase - arg D.
TEST(StateSearch, BranchesAreTheSameWhereverTheImbalanceStands) {
    for (const int n : {2, 4}) {
        PlanarJeffcott jeffcott;
        jeffcott.n = n;
        jeffcott.ball = 0.1 / n;
        const std::vector<double> speeds = model::SpeedRange{280, 340, 5}.values();
        const auto of = [&](double phase) {
            model::Case scene = jeffcott.scene();
            scene.rotor.balancers[0].imbalance_phase = phase;
            return steady_states(scene, speeds);
        };
        const results::SteadyStates usual = of(0);
        for (const double at : {283.0, 301.0, 322.0})
            for (const double half : {0.0, pi}) {
                const results::SteadyStates turned = of(std::arg(jeffcott.dynamic(at)) + half);
                ASSERT_EQ(turned.borders.size(), usual.borders.size());
                for (std::size_t i = 0; i < usual.borders.size(); ++i) {
                    EXPECT_EQ(turned.borders[i].kind, usual.borders[i].kind);
                    EXPECT_NEAR(turned.borders[i].speed, usual.borders[i].speed, 1e-5);
                }
                const auto branch = [](const SteadyState &state) { return state.branch; };
                EXPECT_EQ(branch(std::ranges::max(turned.states, {}, branch)),
                          branch(std::ranges::max(usual.states, {}, branch)));
            }
    }
}

// A border of a family belongs to a branch that is listed.
TEST(StateSearch, BordersBelongToBranches) {
    PlanarJeffcott jeffcott;
    jeffcott.rotor.kx = jeffcott.rotor.ky = 1e5;
    jeffcott.rotor.c = 200;
    jeffcott.radius = 0.06;
    jeffcott.drag = 1;
    jeffcott.imbalance = 0.003;
    jeffcott.n = 5;
    const results::SteadyStates found = steady_states(jeffcott.scene(), {120, 125, 130, 135});
    int of_family = 0;
    for (const results::SteadyBorder &border : found.borders) {
        const auto own = std::ranges::find(found.states, border.branch, &SteadyState::branch);
        ASSERT_NE(own, found.states.end()) << border.speed;
        of_family += own->family;
    }
    EXPECT_GT(of_family, 0);
}

// What lies between two states that could not be followed to each other is not known.
TEST(StateSearch, NoBorderIsFoundWhereAStateIsLost) {
    StateSearch::Found low;
    low.place = 1;
    StateSearch::Found high = low;
    high.place = 2;
    high.state.growing = 1;
    std::vector<results::SteadyBorder> borders;
    find_crossings(
        low, high, [](const auto &, const auto &, double) { return std::nullopt; }, borders);
    ASSERT_EQ(borders.size(), 1);
    EXPECT_EQ(borders[0].kind, results::SteadyBorder::Kind::undecided);
}

} // namespace
} // namespace whirl::states

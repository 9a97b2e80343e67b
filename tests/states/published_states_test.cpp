// Published diagrams of a two-plane balancer with four balls, with the states beside the balanced
// one: D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson, Automatic two-plane
// balancing for rigid rotors, Int. J. Non-Linear Mech. 43 (2008) 527, figures 5 and 9. Over the
// mass of a ball, m, at one speed; lengths in radii of the race, masses in rotor masses, time in
// 1/Omega_1. Read from the vector graphics of the authors' preprint: markers stand within 0.01 of a
// point of print where they were computed, that is within the digits given here. In print the
// balls' own equations leave out what the slope phi of their plane does to their tilting, beside
// its deflection w a share of phi^2 R/w: nothing where a plane stands still, up to 0.8 % of the
// masses at the Hopf points of tilted states.

#include "analyses/simulate.h"
#include "input/case_file.h"
#include "states/state_search.h"
#include "support/balancer_parts.h"
#include "verification/two_plane_rotor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace whirl::states::published {
namespace {

using results::SteadyBorder;
using results::SteadyState;
using results::SteadyStates;
using Kind = SteadyState::Kind;
using RotorWith = std::function<model::Case(double m)>;

/// In the print balls have moments of inertia against tilting too.
model::Case rotor(const tests::Imbalance &imbalance, double m) {
    model::Case scene = tests::rotor_with(imbalance, m, 0.01);
    double z = -2;
    for (model::Balancer &balancer : scene.rotor.balancers) {
        balancer.tilt_inertia = true;
        balancer.imbalance = 0;
        const std::complex<double> share = tests::share_of(imbalance, z);
        scene.rotor.imbalances.push_back(
            tests::imbalance_at(balancer.z, std::abs(share), std::arg(share)));
        z = 2;
    }
    return scene;
}

SteadyStates over_mass(const RotorWith &with, double speed, double from, double to, int count) {
    model::SweepAxis axis;
    for (int i = 0; i < count; ++i)
        axis.values.push_back(from + (to - from) * i / (count - 1));
    return steady_states_over(axis, speed, with);
}

/// The mean radius at a distance of one on either side of the centre of mass.
double mean_amplitude(const StateSearch &search, const StateSearch::Found &found) {
    const auto w = search.equations().deflections(found.x); // of the planes at -2 and 2
    const std::complex<double> middle = (w[0] + w[1]) / 2.0;
    const std::complex<double> slope = (w[1] - w[0]) / 4.0;
    return (std::abs(middle + slope) + std::abs(middle - slope)) / 2;
}

struct Mark {
    double m;
    SteadyBorder::Kind kind;
    double amplitude; ///< mean_amplitude of the state there; or of figure 5 the angle of a ball
};
constexpr auto hopf = SteadyBorder::Kind::pair;
constexpr auto reach = SteadyBorder::Kind::limit; // where a state with split balls begins
constexpr auto zero = SteadyBorder::Kind::zero;

/// @param share  of the mass, beside the digits of the print
void expect_border(const SteadyStates &states, const Mark &mark, double share) {
    constexpr double digits = 2e-6;
    const auto near = [&](const SteadyBorder &border) {
        return border.kind == mark.kind &&
               std::abs(border.value - mark.m) < digits + share * mark.m;
    };
    EXPECT_TRUE(std::ranges::any_of(states.borders, near))
        << results::steady_border_name(mark.kind) << " at m = " << mark.m << ", found " << [&] {
               std::string found;
               for (const SteadyBorder &border : states.borders)
                   found += results::steady_border_name(border.kind) + " " +
                            std::to_string(border.value) + ", ";
               return found;
           }();
}

// Figure 9b: eps = chi = 0.005, beta = 1, Omega = 3.
TEST(PublishedStates, DynamicImbalanceOverTheMassOfTheBalls) {
    const RotorWith with = [](double m) { return rotor({0.005, 0.005, 1}, m); };
    const SteadyStates states = over_mass(with, 3, 1e-4, 6e-3, 60);
    constexpr double second_order = 8.5e-3;
    const std::vector<Mark> marks{
        {1.6247e-3, zero, 2.958e-3}, // C2: here Ct3 branches off, one race's balls apart
        {1.6247e-3, reach, 2.958e-3}, {2.5083e-3, zero, 3.057e-3}, // C2: Cb3 likewise
        {2.5083e-3, reach, 3.057e-3}, {2.6142e-3, reach, 0},       // B out of Ct3: equation (22)
        {4.4243e-3, hopf, 5.336e-3},  {5.4758e-3, hopf, 11.711e-3},
        {5.0329e-3, hopf, 13.875e-3}, {5.2420e-3, hopf, 0},
    };
    for (const Mark &mark : marks) {
        const bool tilted = mark.kind == hopf && mark.amplitude > 0;
        expect_border(states, mark, tilted ? second_order : 1e-4);
        const StateSearch search(with(mark.m), 3, 3);
        bool undecided = false;
        const auto found = search.at(3, undecided);
        EXPECT_TRUE(std::ranges::any_of(found, [&](const StateSearch::Found &state) {
            return std::abs(mean_amplitude(search, state) - mark.amplitude) <
                   5e-6 + 2e-3 * mark.amplitude;
        })) << mark.m;
    }
    // Which are stable between them: C2 first, then Ct3, then B, and nothing else.
    const auto stable = [&](double m) {
        std::vector<Kind> kinds;
        for (const SteadyState &state : states.states)
            if (std::abs(state.value - m) < 1e-9 && state.stable == true)
                kinds.push_back(state.kind);
        return kinds;
    };
    EXPECT_EQ(stable(1e-3), std::vector{Kind::coincident});
    EXPECT_EQ(stable(2e-3), std::vector{Kind::partly_balanced});
    EXPECT_EQ(stable(4e-3), std::vector{Kind::balanced});
    EXPECT_TRUE(stable(5.5e-3).empty());
}

// Figure 5e: eps = 0.01 alone, Omega = 3.
TEST(PublishedStates, StaticImbalanceAboveTheResonances) {
    const RotorWith with = [](double m) { return rotor({0.01, 0, 0}, m); };
    const SteadyStates states = over_mass(with, 3, 1.05e-3, 9.95e-3, 90);
    constexpr double second_order = 2e-3;
    for (const Mark &mark :
         {Mark{2.4997e-3, reach, 0}, // B and C3 out of C1: eps/4
          Mark{3.3546e-3, hopf, 0},  // of B
          Mark{3.7938e-3, hopf, 0}, Mark{5.3623e-3, hopf, 0}, Mark{4.1070e-3, hopf, 0}, // of C1
          Mark{5.5319e-3, hopf, 0},                                                     // of C3
          Mark{8.8585e-3, hopf, 0}})
        expect_border(states, mark, second_order);
}

// Figures 5b and c: the same between the resonances, Omega = 1.5, with the angle of a ball.
TEST(PublishedStates, StaticImbalanceBetweenTheResonances) {
    const RotorWith with = [](double m) { return rotor({0.01, 0, 0}, m); };
    const SteadyStates states = over_mass(with, 1.5, 1e-4, 9.95e-3, 120);
    constexpr double second_order = 7e-3;
    const std::vector<Mark> marks{
        {0.8937e-3, zero, 3.157},                             // C1: C2 branches off
        {1.3754e-3, reach, 0.272},                            // C2: C3 branches off
        {1.3754e-3, zero, 3.220},  {2.4997e-3, reach, 3.147}, // C1, C3 and B
        {2.2304e-3, hopf, 3.961},                             // C2
        {2.2304e-3, hopf, 1.565},  {2.4083e-3, hopf, 3.550},  // C2
        {2.4083e-3, hopf, 0.816},  {7.5420e-3, hopf, 1.909},  // B
        {7.5420e-3, hopf, 4.375},
    };
    for (const Mark &mark : marks) {
        expect_border(states, mark, second_order);
        bool undecided = false;
        const auto found = StateSearch(with(mark.m), 1.5, 1.5).at(1.5, undecided);
        // Next to where two branches meet angles go with the root of the distance.
        const double near = mark.m > 5e-3 ? 2e-3 : 0.07;
        EXPECT_TRUE(std::ranges::any_of(
            found,
            [&](const StateSearch::Found &state) {
                return std::ranges::any_of(state.state.angles, [&](const auto &balls) {
                    return std::ranges::any_of(balls, [&](double angle) {
                        return std::abs(std::remainder(angle - mark.amplitude,
                                                       2 * std::numbers::pi)) < near;
                    });
                });
            }))
            << mark.m << " at " << mark.amplitude;
    }
}

// The rig of one plane, two washers: Rodrigues et al., J. Sound Vib. 330 (2011) 385, figure 14a,
// race damping 0.1, read from the vector graphics of the preprint: the mean of the largest
// amplitudes of both bearings, mm; balls start at the heavy side.
TEST(PublishedRig, AmplitudeOfTheBearings) {
    const std::vector<std::pair<double, double>> figure{
        {600, 0.00931},  {900, 0.02767},  {1200, 0.09059}, {3000, 0.01400},
        {3510, 0.01060}, {3990, 0.00920}, {5010, 0.00791}};
    for (const auto &[rpm, amplitude] : figure) {
        model::Case scene = input::load_case(WHIRL_ROOT "/cases/rodrigues_rig");
        const double speed = rpm * std::numbers::pi / 30;
        scene.speeds = model::SpeedRange{speed, speed, 1};
        const results::SimulateResult result = analyses::simulate(scene);
        double sum = 0;
        for (const auto &station : result.stations)
            if (station.z == scene.rotor.bearings[0].z || station.z == scene.rotor.bearings[1].z)
                sum += station.amplitude;
        EXPECT_NEAR(sum / 2 * 1e3, amplitude, 0.006 * amplitude) << rpm;
    }
}

} // namespace
} // namespace whirl::states::published

// Motion of a rotor without balancers: run-up, run-down, sudden imbalance, forces, a foundation
// that moves; against Duhamel's integral in long double and closed forms of the damped oscillator.

#include "analyses/simulate.h"
#include "model/errors.h"
#include "oracles/duhamel.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::simulation {
namespace {

using oracles::Duhamel;
using oracles::Ramp;
using tests::RigidJeffcott;
using Complex = Duhamel::Complex;
constexpr std::size_t disc = 1; ///< among the stations: left end, disc, right end
constexpr double moment = 1e-3; ///< kg m

/// Without imbalance: tests add what moves it.
model::Case still_scene(const RigidJeffcott &rotor, double time) {
    model::Case scene = rotor.scene();
    scene.simulate.time = time;
    scene.simulate.tolerance = 1e-11;
    scene.speeds = model::SpeedRange{0, 0, 1};
    return scene;
}

model::Case ramp_scene(const RigidJeffcott &rotor, const Ramp &ramp, double time) {
    model::Case scene = still_scene(rotor, time);
    scene.rotor.imbalances = {{"", 0.5, moment, 0}};
    scene.simulate.run_up = {{0, static_cast<double>(ramp.from)},
                             {static_cast<double>(ramp.duration), static_cast<double>(ramp.to)}};
    return scene;
}

Duhamel::Spring spring_of(const RigidJeffcott &rotor) { return {rotor.mass, rotor.c, rotor.kx}; }

/// Largest distance of the disc from what is expected at the output times, m.
template <class At> double largest_difference(const results::SimulateResult &result, At &&at) {
    double largest = 0;
    for (std::size_t k = 0; k < result.series.time.size(); ++k) {
        const Complex expected = at(result.series.time[k]);
        largest = std::max(
            largest, std::hypot(result.series.x[disc][k] - static_cast<double>(expected.real()),
                                result.series.y[disc][k] - static_cast<double>(expected.imag())));
    }
    return largest;
}

/// At a tolerance of 1e-11 a step, errors gather over some thousands of steps.
constexpr double gathered = 1e-7;

double energy_missing(const results::SimulateResult &result) {
    return std::abs(result.audit.energy_error) / result.audit.energy_scale;
}
double momentum_missing(const results::SimulateResult &result) {
    return std::abs(result.audit.momentum_error) / result.audit.momentum_scale;
}

// --- Run-up and run-down ------------------------------------------------------------------------

struct Passage {
    double from, to; ///< of the natural frequency
    double turns;    ///< of the natural motion that it takes
    double damping;  ///< ratio
};

class Passages : public testing::TestWithParam<Passage> {};

TEST_P(Passages, HaveTheTransientPeakOfDuhamelsIntegral) {
    RigidJeffcott rotor;
    const double natural = rotor.natural();
    rotor.c = 2 * GetParam().damping * std::sqrt(rotor.kx * rotor.mass);
    const double duration = GetParam().turns * 2 * std::numbers::pi / natural;
    const Ramp ramp{GetParam().from * natural, GetParam().to * natural, duration};
    model::Case scene = ramp_scene(rotor, ramp, duration);
    Duhamel::Motion start{0, 0};
    if (ramp.from > 0) {
        scene.simulate.steady_start = true;
        const Complex i(0, 1);
        start.w =
            moment * ramp.from * ramp.from /
            (Complex(rotor.kx - rotor.mass * ramp.from * ramp.from) + i * (rotor.c * ramp.from));
        start.v = i * ramp.from * start.w;
    }
    const auto force = [&](long double t) { return ramp.force(moment, t); };
    const long double panel = 0.2L / natural;
    const results::SimulateResult result = analyses::simulate(scene);
    const Duhamel::Peak peak = Duhamel::largest(spring_of(rotor), force, panel, duration, start);
    const results::PeakInTime &found = result.stations[disc].peak;
    const auto value = static_cast<double>(peak.value);
    EXPECT_NEAR(found.value, value, gathered * value);
    // Near its top the curve is flat: a relative error e of the value moves the place by sqrt(e).
    EXPECT_NEAR(found.time, static_cast<double>(peak.time), 1e-5 * duration);
    EXPECT_NEAR(found.speed, static_cast<double>(ramp.speed(found.time)), 1e-9 * natural);
    Duhamel motion(spring_of(rotor), force, panel, start);
    EXPECT_LT(largest_difference(result, [&](double t) { return motion.at(t).w; }),
              gathered * value);
    EXPECT_LT(energy_missing(result), 1e-7);
    EXPECT_LT(momentum_missing(result), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(UpAndDown, Passages,
                         testing::Values(Passage{0, 2, 30, 0.02}, Passage{0, 3, 200, 0.05},
                                         Passage{0, 2, 100, 0}, Passage{2, 0, 30, 0.02},
                                         Passage{1.8, 0.3, 120, 0.01}));

// The steady peak beside it: mr/m / (2 z sqrt(1 - z^2)) at natural/sqrt(1 - 2 z^2).
TEST(RunUp, StandsBesideTheSteadyPeak) {
    RigidJeffcott rotor;
    const double z = rotor.ratio();
    const model::Case scene = ramp_scene(rotor, {0, 2 * rotor.natural(), 0.5}, 0.5);
    const results::SimulateResult result = analyses::simulate(scene);
    const results::StationMotion &station = result.stations[disc];
    const double peak = moment / rotor.mass / (2 * z * std::sqrt(1 - z * z));
    EXPECT_NEAR(station.steady_peak.value(), peak, 1e-9 * peak);
    EXPECT_NEAR(station.steady_peak_speed.value(), rotor.natural() / std::sqrt(1 - 2 * z * z),
                1e-8 * rotor.natural());
    EXPECT_LT(station.peak.value, peak); // there is no time to reach it
    EXPECT_EQ(result.outcome, results::Outcome::transient);
}

// With q = acceleration/(decay rate)^2 a slow passage peaks later by 2 q decay rates, z q of the
// natural frequency twice: over that the force, as the speed squared, and with it the peak change
// by a share of the order of z q; what is of second order in q is smaller for q below z.
TEST(RunUp, BecomesTheSteadyResponseWhenSlow) {
    const RigidJeffcott rotor;
    for (const double turns : {320.0, 960.0}) {
        const double time = turns * 2 * std::numbers::pi / rotor.natural();
        const results::StationMotion station =
            analyses::simulate(ramp_scene(rotor, {0, 2 * rotor.natural(), time}, time))
                .stations[disc];
        const double decay = rotor.ratio() * rotor.natural();
        const double q = 2 * rotor.natural() / time / (decay * decay);
        EXPECT_NEAR(station.peak.value / station.steady_peak.value(), 1, 2 * rotor.ratio() * q);
    }
}

// --- Sudden imbalance ---------------------------------------------------------------------------

/// (l1, l2) with w = a exp(l1 t) + b exp(l2 t) free.
std::pair<Complex, Complex> free_roots(const RigidJeffcott &rotor) {
    const long double decay = rotor.c / (2 * rotor.mass);
    const Complex swing = std::sqrt(Complex(decay * decay - rotor.kx / rotor.mass));
    return {-decay + swing, -decay - swing};
}

TEST(BladeLoss, IsTheStepResponseOfADampedOscillator) {
    RigidJeffcott rotor;
    const double speed = 1.7 * rotor.natural();
    constexpr double loss = 0.05;
    model::Case scene = still_scene(rotor, 0.6);
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.imbalances = {{"blade", 0.5, loss, moment, 0.4}};
    const results::SimulateResult result = analyses::simulate(scene);
    const Complex i(0, 1);
    const Complex steady =
        Complex(moment * speed * speed) * std::exp(i * Complex(speed * loss + 0.4)) /
        (Complex(rotor.kx - rotor.mass * speed * speed) + i * Complex(rotor.c * speed));
    const auto [l1, l2] = free_roots(rotor);
    // At rest when it begins: steady + a + b = 0, i speed steady + l1 a + l2 b = 0.
    const Complex a = steady * (l2 - i * Complex(speed)) / (l1 - l2);
    const Complex b = -steady - a;
    const double size = static_cast<double>(std::abs(steady));
    EXPECT_LT(largest_difference(result,
                                 [&, l1 = l1, l2 = l2](double t) -> Complex {
                                     const Complex s = t - loss;
                                     return t <= loss
                                                ? Complex(0)
                                                : steady * std::exp(i * Complex(speed) * s) +
                                                      a * std::exp(l1 * s) + b * std::exp(l2 * s);
                                 }),
              gathered * size);
    EXPECT_NEAR(result.stations[disc].steady.value(), size, 1e-9 * size);
    EXPECT_GT(result.stations[disc].peak.value, 1.2 * size); // it overshoots
    EXPECT_LT(energy_missing(result), 1e-7);
    EXPECT_LT(momentum_missing(result), 1e-7);
}

// A rotor in its steady motion stays in it until a blade goes.
TEST(BladeLoss, LeavesTheSteadyMotionBefore) {
    RigidJeffcott rotor;
    const double speed = 0.8 * rotor.natural();
    model::Case scene = still_scene(rotor, 2);
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.rotor.imbalances = {{"", 0.5, moment, 0}};
    scene.simulate.steady_start = true;
    scene.simulate.imbalances = {{"", 0.5, 1, moment, 0}};
    const results::SimulateResult result = analyses::simulate(scene);
    const double before = result.series.amplitude[disc][5];
    for (std::size_t k = 0; k < 999; ++k)
        EXPECT_NEAR(result.series.amplitude[disc][k], before, 1e-8 * before);
    EXPECT_NEAR(result.stations[disc].amplitude, 2 * before, 1e-8 * before); // by exp(-0.1 * 316)
    EXPECT_EQ(result.outcome, results::Outcome::steady) << result.evidence;
}

// --- Forces
// ---------------------------------------------------------------------------------------

// Overshoot of a step: F/k (1 + exp(-pi z/sqrt(1 - z^2))) at pi/damped frequency.
void expect_overshoot_of(const RigidJeffcott &rotor, model::Case scene) {
    model::StationForce force;
    force.z = 0.5;
    force.x = 30;
    force.y = 40;
    force.from = 0.1;
    scene.simulate.forces = {force};
    const results::SimulateResult result = analyses::simulate(scene);
    const double z = rotor.ratio();
    const double damped = rotor.natural() * std::sqrt(1 - z * z);
    const double expected =
        50 / rotor.kx * (1 + std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z)));
    const results::PeakInTime &peak = result.stations[disc].peak;
    EXPECT_NEAR(peak.value, expected, 1e-8 * expected);
    EXPECT_NEAR(peak.time, 0.1 + std::numbers::pi / damped, 1e-6);
    EXPECT_LT(energy_missing(result), 1e-7);
}

TEST(StepForce, OvershootsAsTheClosedForm) {
    const RigidJeffcott rotor;
    expect_overshoot_of(rotor, still_scene(rotor, 0.5));
}

// Between two rows of a bearing table, stiffness and damping are both those of the line between
// them: of the overshoot the time tells one and the height the other.
TEST(StepForce, BetweenRowsOfATableIsThatOfTheLineBetweenThem) {
    RigidJeffcott low;
    low.kx = low.ky = 0.7e6;
    low.c = 300;
    RigidJeffcott high;
    high.kx = high.ky = 1.3e6;
    high.c = 900;
    RigidJeffcott between; // a quarter of the way
    between.kx = between.ky = 0.85e6;
    between.c = 450;
    model::Case scene = still_scene(low, 0.3);
    const model::Case other = high.scene();
    for (std::size_t b = 0; b < 2; ++b) {
        scene.rotor.bearings[b].rows.push_back(other.rotor.bearings[b].rows[0]);
        scene.rotor.bearings[b].speeds = {100, 300};
    }
    scene.speeds = model::SpeedRange{150, 150, 1};
    expect_overshoot_of(between, std::move(scene));
}

// |F/(k - m w^2 + i c w)| of either axis, at an angle between them, when the start has died out.
TEST(HarmonicForce, EndsInTheSteadyClosedForm) {
    RigidJeffcott rotor;
    const double speed = 0.5 * rotor.natural();
    for (const double frequency : {0.6 * rotor.natural(), 1.3 * rotor.natural()}) {
        model::Case scene = still_scene(rotor, 1.2);
        scene.speeds = model::SpeedRange{speed, speed, 1};
        model::StationForce force;
        force.z = 0.5;
        force.x = 30;
        force.frequency = frequency;
        force.phase = 0.3;
        scene.simulate.forces = {force};
        const results::SimulateResult result = analyses::simulate(scene);
        const double expected =
            30 / std::hypot(rotor.kx - rotor.mass * frequency * frequency, rotor.c * frequency);
        // By the end exp(-0.1 * 316 * 1.17) = 1e-16 of the start is left; maxima of polynomials.
        EXPECT_NEAR(result.stations[disc].amplitude, expected, 2e-5 * expected);
        const Complex i(0, 1);
        const Complex response = Complex(30) * std::exp(i * Complex(0.3)) /
                                 (Complex(rotor.kx - rotor.mass * frequency * frequency) +
                                  i * Complex(rotor.c * frequency));
        const double t = result.series.time.back();
        EXPECT_NEAR(result.series.x[disc].back(),
                    static_cast<double>((response * std::exp(i * Complex(frequency * t))).real()),
                    1e-8 * expected);
        EXPECT_NEAR(result.series.y[disc].back(), 0, 1e-12 * expected);
        EXPECT_LT(energy_missing(result), 1e-6);
    }
}

// --- A foundation that moves
// ----------------------------------------------------------------------

TEST(BaseMotion, ActsAsAFieldOnTheMass) {
    RigidJeffcott rotor;
    model::Case scene = still_scene(rotor, 0.4);
    model::BaseMotion base;
    base.table = {{0.02, 0, 0}, {0.05, 12, -3}, {0.09, -20, 6}, {0.15, 0, 1}};
    scene.simulate.base = base;
    const results::SimulateResult result = analyses::simulate(scene);
    const auto field = [&](long double t) -> Complex {
        for (std::size_t k = 0; k + 1 < base.table.size(); ++k) {
            const auto &[t0, x0, y0] = base.table[k];
            const auto &[t1, x1, y1] = base.table[k + 1];
            if (t >= t0 && t < t1) {
                const long double s = (t - t0) / (t1 - t0);
                return -Complex(rotor.mass) * Complex(x0 + s * (x1 - x0), y0 + s * (y1 - y0));
            }
        }
        return 0;
    };
    // Panels end where the table bends.
    Duhamel motion(spring_of(rotor), field, 0.01L / 64);
    const double size = result.stations[disc].peak.value;
    EXPECT_LT(largest_difference(result, [&](double t) { return motion.at(t).w; }),
              gathered * size);
    EXPECT_LT(energy_missing(result), 1e-7);
}

/// At rest, while the foundation shakes along y with 5 m/s2.
model::Case shaken_scene(const RigidJeffcott &rotor, double frequency) {
    model::Case scene = still_scene(rotor, 1.2);
    model::StationForce harmonic;
    harmonic.y = 5;
    harmonic.frequency = frequency;
    scene.simulate.base = model::BaseMotion{harmonic, {}};
    return scene;
}

// Relative to the foundation: -a/(natural^2 - w^2 + i c w/m).
TEST(BaseMotion, EndsInTheSteadyClosedForm) {
    RigidJeffcott rotor;
    const double frequency = 1.2 * rotor.natural();
    const results::SimulateResult result = analyses::simulate(shaken_scene(rotor, frequency));
    const double expected =
        5 * rotor.mass /
        std::hypot(rotor.kx - rotor.mass * frequency * frequency, rotor.c * frequency);
    EXPECT_NEAR(result.stations[disc].amplitude, expected, 2e-5 * expected);
    EXPECT_EQ(result.outcome, results::Outcome::steady) << result.evidence;
}

// Fluid in a bearing is held by the foundation: it takes part in the motion relative to it, and the
// foundation's acceleration does not pull at it. -m a/(k - (m + mf) w^2 + i c w).
TEST(BaseMotion, DoesNotPullAtTheFluidInBearings) {
    RigidJeffcott rotor;
    const double fluid = 4;
    const double frequency = 0.7 * rotor.natural();
    model::Case scene = shaken_scene(rotor, frequency);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].m = fluid / 2 * Eigen::Matrix2d::Identity();
    const results::SimulateResult result = analyses::simulate(scene);
    const double expected =
        5 * rotor.mass /
        std::hypot(rotor.kx - (rotor.mass + fluid) * frequency * frequency, rotor.c * frequency);
    EXPECT_NEAR(result.stations[disc].amplitude, expected, 2e-5 * expected);
    EXPECT_LT(energy_missing(result), 1e-7);
}

// The books of balls and pendulums close while all that this file is about happens at once.
TEST(EnergyAndMomentum, AreKeptUnderAllThatActsFromOutside) {
    for (const bool pendulums : {false, true}) {
        model::Case scene =
            pendulums ? tests::pendulum_rotor_scene(2, 0.3, 0.5, 0.1) : tests::flexible_rotor(300);
        const double speed = scene.speeds->from;
        const double turn = 2 * std::numbers::pi / speed;
        scene.simulate.time = 20 * turn;
        scene.simulate.tolerance = 1e-10;
        const double length = scene.rotor.shaft.length();
        model::StationForce force;
        force.z = 0.7 * length;
        force.x = 30;
        force.y = 20;
        force.phase_y = 1;
        force.frequency = 0.7 * speed;
        force.from = 3.3 * turn;
        force.to = 11.1 * turn;
        scene.simulate.forces = {force};
        model::StationForce base = force;
        base.x = 5;
        base.y = -4;
        base.from = turn;
        base.to = 15 * turn;
        scene.simulate.base = model::BaseMotion{base, {}};
        scene.simulate.imbalances = {{"", 0.4 * length, 8.2 * turn, 0.002, 2}};
        const results::SimulateResult result = analyses::simulate(scene);
        EXPECT_LT(energy_missing(result), 1e-6) << (pendulums ? "pendulums" : "balls");
        EXPECT_LT(momentum_missing(result), 1e-6) << (pendulums ? "pendulums" : "balls");
    }
}

// --- What is missing
// ------------------------------------------------------------------------------

TEST(WithoutBalancers, SomethingMustMoveTheRotor) {
    model::Case scene = still_scene(RigidJeffcott(), 1);
    scene.speeds = model::SpeedRange{100, 100, 1};
    try {
        (void)analyses::simulate(scene);
        FAIL() << "expected BadInput";
    } catch (const model::BadInput &error) {
        EXPECT_NE(std::string(error.what()).find("[[simulate.force]]"), std::string::npos)
            << error.what();
    }
}

TEST(SteadyStart, IsRefusedAtAResonanceWithoutDamping) {
    RigidJeffcott rotor;
    rotor.c = 0;
    model::Case scene = still_scene(rotor, 1);
    scene.rotor.imbalances = {{"", 0.5, moment, 0}};
    scene.speeds = model::SpeedRange{rotor.natural(), rotor.natural(), 1};
    scene.simulate.steady_start = true;
    EXPECT_THROW((void)analyses::simulate(scene), model::AnalysisFailure);
}

} // namespace
} // namespace whirl::simulation

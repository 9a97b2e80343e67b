// The equations of motion in time against independent formulations of the same mechanics.

#include "analyses/simulate.h"
#include "balancers/arrangement.h"
#include "closed_form/balanced_position.h"
#include "closed_form/composite_rotor_matrices.h"
#include "ends/growth.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "process/progress.h"
#include "report/restart_file.h"
#include "results/formulation.h"
#include "simulation/equations.h"
#include "simulation/motion.h"
#include "support/balancer_parts.h"
#include "support/balancer_scenes.h"
#include "support/looked_at.h"
#include "support/ring_scenes.h"
#include "support/rotating_rates.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace whirl::simulation {
namespace {

using tests::flexible_rotor;
using tests::rodrigues_rotor;
using tests::RotatingRates;
using Spectrum = std::vector<std::complex<double>>;

// --- Small motions about the balanced position -------------------------------------------------

/// A bare rigid rotor with balls and imbalance in one plane, and the same as a case.
struct Composite {
    closed_form::PhysicalParameters physical;
    model::Case scene;
};

/// Supports at z = -0.3 and 0.35 from the common centre of mass, as in the closed form.
Composite composite(const std::vector<double> &angles, double speed, bool point_mass) {
    const int n = static_cast<int>(angles.size());
    const closed_form::BallSet balls{n, 4.0 / n, 0.2, 0.9};
    const closed_form::PlaneImbalance imbalance{0.5, point_mass ? 2.0 : 0.0};
    const closed_form::BareRotor rotor{57.83, 1.413, 0.889, 0.1};
    const auto supports = closed_form::reduced_supports({3e4, 40, -0.3}, {5e4, 90, 0.35});
    Composite out;
    out.physical = closed_form::physical_parameters(
        rotor, balls, imbalance, closed_form::second_harmonic(angles), supports, speed);
    constexpr double plane = 0.5; // of the balancer on the shaft
    const double centre = plane - out.physical.balancer_position;
    model::Rotor &r = out.scene.rotor;
    r.shaft = tests::uniform_shaft(1, 0.01, tests::weightless_steel());
    r.shaft.rigid = true;
    r.discs = {tests::disc_at(plane - rotor.balancer_distance, rotor.mass, rotor.diametral_inertia,
                              rotor.polar_inertia)};
    r.bearings = {tests::isotropic_bearing(centre - 0.3, 3e4, 40),
                  tests::isotropic_bearing(centre + 0.35, 5e4, 90)};
    r.balancers = {
        tests::ball_balancer(plane, n, balls.mass, balls.radius, balls.damping, imbalance.moment)};
    if (point_mass)
        r.balancers.front().imbalance_radius = imbalance.moment / imbalance.mass;
    out.scene.speeds = model::SpeedRange{speed, speed, 1};
    out.scene.simulate.time = 1;
    out.scene.simulate.ball_angles = {angles};
    return out;
}

double distance_to(const Spectrum &values, std::complex<double> value) {
    double nearest = HUGE_VAL;
    for (const auto other : values)
        nearest = std::min(nearest, std::abs(other - value));
    return nearest;
}

struct Position {
    std::string name;
    std::vector<double> angles;
    bool point_mass;
};

class SmallMotions : public testing::TestWithParam<Position> {};

/// Three balls without symmetry that balance m0 R0 = 0.5 with n m R = 0.8: one at 2.6 rad.
std::vector<double> unsymmetric_position() {
    const std::complex<double> rest(-3.0 / 1.6 - std::cos(2.6), -std::sin(2.6));
    const double opening = std::acos(0.5 * std::abs(rest));
    return {2.6, std::arg(rest) + opening, std::arg(rest) - opening};
}

// The closed form is written in other unknowns, from the balls' mean displacement s: eigenvalues
// do not depend on that. Central differences with a step of 1e-5 leave 1e-10 of the curvature.
TEST_P(SmallMotions, HaveTheEigenvaluesOfTheRotatingFrame) {
    for (const double speed : {15.0, 41.0, 90.0}) {
        const Composite both = composite(GetParam().angles, speed, GetParam().point_mass);
        const RotatingRates rates(both.scene);
        const Eigen::VectorXd balanced = rates.at(Eigen::VectorXd::Zero(rates.size()));
        EXPECT_LT(balanced.cwiseAbs().maxCoeff(), 1e-9 * speed * speed);
        const Eigen::VectorXcd found = rates.jacobian().eigenvalues();
        const Spectrum values(found.begin(), found.end());
        const Spectrum exact = closed_form::eigenvalues(closed_form::rotating_frame_matrices(
            closed_form::rotating_coefficients(both.physical)));
        double size = 0;
        for (const auto value : exact)
            size = std::max(size, std::abs(value));
        for (const auto value : exact)
            EXPECT_LT(distance_to(values, value), 1e-6 * size) << value << " at " << speed;
        // Each ball beyond two adds a neutral pair 0, -h_s.
        const double h_s = both.physical.balls.damping / both.physical.balls.mass;
        for (const auto value : values)
            EXPECT_LT(std::min({distance_to(exact, value), std::abs(value), std::abs(value + h_s)}),
                      1e-6 * size)
                << value << " at " << speed;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Positions, SmallMotions,
    testing::Values(Position{"two", closed_form::symmetric_position(2, 1.6).value(), true},
                    Position{"three", closed_form::symmetric_position(3, 1.6).value(), true},
                    Position{"unsymmetric", unsymmetric_position(), true},
                    Position{"eccentric", closed_form::symmetric_position(2, 1.6).value(), false}),
    [](const auto &test) { return test.param.name; });

// Against the elements of the rotating frame: inertial anisotropies away from the balancer and in
// its plane, and an imbalance at an angle of its own.
TEST(SmallMotionsOfAnAsymmetricRotor, HaveTheEigenvaluesOfTheRotatingFrame) {
    for (const double speed : {15.0, 41.0, 90.0}) {
        model::Case scene =
            composite(closed_form::symmetric_position(2, 1.6).value(), speed, true).scene;
        model::Rotor &r = scene.rotor;
        r.balancers.front().imbalance_phase = 0.7;
        r.anisotropies = {{"", 0.4, 0.2, 1.1}, {"", 0.5, 0.1, -0.4}};
        const balancers::Arrangement balanced = balancers::arrangement_at_balance(r);
        scene.simulate.ball_angles = balanced;
        const RotatingRates rates(scene);
        const Eigen::VectorXd still = rates.at(Eigen::VectorXd::Zero(rates.size()));
        EXPECT_LT(still.cwiseAbs().maxCoeff(), 1e-9 * speed * speed);
        const Eigen::VectorXcd found = rates.jacobian().eigenvalues();
        const Spectrum values(found.begin(), found.end());
        const ends::Growth rotor(tests::looked_at(r, results::Form::rotating, 1), balanced, nullptr,
                                 {speed, speed});
        std::vector<ends::Root> motions = rotor.motions().at(speed).roots;
        std::erase_if(motions, [&rotor](const ends::Root &motion) {
            return !rotor.motions().within_reach(std::abs(motion.value));
        });
        EXPECT_GE(motions.size(), 8U);
        for (const ends::Root &motion : motions)
            EXPECT_LT(distance_to(values, motion.value), 1e-6 * std::max(90.0, speed))
                << motion.value << " at " << speed;
    }
}

// --- Energy and angular momentum ---------------------------------------------------------------

model::Case conservative(model::Case scene) {
    for (model::Bearing &bearing : scene.rotor.bearings)
        for (model::BearingCoefficients &row : bearing.rows)
            row.c.setZero();
    for (model::Balancer &balancer : scene.rotor.balancers)
        tests::set_damping(balancer, 0);
    return scene;
}

model::Case with_everything() {
    model::Case scene = flexible_rotor(260);
    scene.rotor.shaft.internal_damping = 2e-5;
    model::BearingCoefficients &row = scene.rotor.bearings[0].rows.front();
    row.k << 8e5, 1e5, -3e4, 5e5;
    row.c << 300, 20, -10, 500;
    scene.rotor.bearings[1].pedestal = model::Pedestal{3, 4e6, 100};
    scene.simulate.gravity = 9.81;
    return scene;
}

model::Case with_table() {
    model::Case scene = flexible_rotor(0);
    model::Bearing &bearing = scene.rotor.bearings[0];
    bearing.speeds = {100, 300};
    bearing.rows.push_back(bearing.rows.front());
    bearing.rows[1].k *= 1.5;
    bearing.rows[1].c *= 0.5;
    scene.simulate.run_up = {{0.0, 0.0}, {0.3, 200.0}, {0.4, 260.0}};
    return scene;
}

model::Case driven(model::Case scene) {
    scene.simulate.torque = 4;
    scene.simulate.torque_slope = 0.01;
    scene.simulate.inertia = 0.05;
    return scene;
}

/// Dampers so strong that the ends of the shaft creep: stiff.
model::Case nearly_clamped() {
    model::Case scene = flexible_rotor(60);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows.front().c *= 3e4;
    return scene;
}

/// Free of any torque from outside: a motor that gives none.
model::Case coasting(model::Case scene) {
    scene.simulate.torque = 0;
    return scene;
}

/// Of the discs' inertias much, differently directed.
model::Case with_anisotropy(model::Case scene) {
    scene.rotor.anisotropies = {{"", 0.3, 0.03, 0.4}, {"", 0.6, 0.002, -1.0}};
    scene.rotor.balancers[1].imbalance_phase = 2;
    return scene;
}

struct Audited {
    std::string name;
    model::Case scene;
};

class Balance : public testing::TestWithParam<Audited> {};

// The books are kept by the same integrator, to 1e-8 of each of their steps.
TEST_P(Balance, OfEnergyAndAngularMomentumIsClosed) {
    const results::SimulateResult result = analyses::simulate(GetParam().scene);
    const results::MotionAudit &audit = result.audit;
    EXPECT_GT(audit.energy_scale, 0);
    EXPECT_LT(std::abs(audit.energy_error), 1e-6 * audit.energy_scale);
    EXPECT_LT(std::abs(audit.momentum_error), 1e-6 * audit.momentum_scale);
    const bool stiff = result.integrator.find("stiff") != std::string::npos;
    EXPECT_EQ(stiff, GetParam().name == "stiff") << result.integrator;
}

model::Case heavy_pendulums(bool motor) {
    model::Case scene = tests::pendulum_rotor_scene(2, 0.3, 0.2, 0.05);
    scene.simulate.time = 0.5;
    scene.simulate.gravity = 9.81;
    scene.simulate.ball_angles = {{0.6, -0.4}};
    return motor ? driven(scene) : scene;
}

/// Rings away from the middle, two of different weight, and rows of balls in one balancer.
model::Case rings_and_rows() {
    model::Case scene = flexible_rotor(260);
    scene.rotor.balancers[0].parts = tests::ring_balancer(0, 2, 0).parts;
    model::Balls balls;
    balls.rows = {{2, 0.03, 0.07, 0.4}, {1, 0.05, 0.05, 0.1}};
    scene.rotor.balancers[1].parts = balls;
    scene.simulate.ball_angles = {{1, -0.6}, {1, -1, 2}};
    scene.simulate.gravity = 9.81;
    return scene;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Balance,
    testing::Values(Audited{"rings_and_rows", rings_and_rows()},
                    Audited{"rings_and_rows_driven", driven(rings_and_rows())},
                    Audited{"rings_and_rows_coasting", coasting(conservative(rings_and_rows()))},
                    Audited{"conservative", conservative(flexible_rotor(260))},
                    Audited{"coasting", coasting(conservative(flexible_rotor(260)))},
                    Audited{"everything", with_everything()},
                    Audited{"everything_driven", driven(with_everything())},
                    Audited{"run_up_on_table", with_table()}, Audited{"stiff", nearly_clamped()},
                    Audited{"anisotropic", with_anisotropy(with_everything())},
                    Audited{"anisotropic_coasting",
                            with_anisotropy(coasting(conservative(flexible_rotor(260))))},
                    Audited{"anisotropic_driven", driven(with_anisotropy(with_everything()))},
                    Audited{"pendulums", heavy_pendulums(false)},
                    Audited{"pendulums_driven", heavy_pendulums(true)}),
    [](const auto &test) { return test.param.name; });

// Nothing acts from outside and nothing is lost: energy itself stays.
TEST(Coasting, KeepsItsEnergy) {
    const model::Case scene = coasting(conservative(flexible_rotor(260)));
    MotionScene prepared = motion_scene(scene);
    const RotorMotion motion(prepared.parts);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(motion.size());
    for (Eigen::Index i = 0; i < motion.size(); ++i)
        state(i) = 1e-3 * std::sin(1.0 + 3.0 * static_cast<double>(i));
    state(2 * motion.coordinates() + 1) = 260;
    Eigen::VectorXd rates(motion.size());
    motion.rates(0, state.data(), rates.data());
    // dE/dt by a central difference along the motion.
    const double step = 1e-7;
    const double change = motion.totals(0, Eigen::VectorXd(state + step * rates).data()).energy -
                          motion.totals(0, Eigen::VectorXd(state - step * rates).data()).energy;
    const double vibration = rates.segment(motion.coordinates(), motion.first_angle()).norm() *
                             state.segment(motion.coordinates(), motion.first_angle()).norm();
    // What rounding of the energy leaves; the vibration alone exchanges far more with the spin.
    const double rounding = 1e-15 * motion.totals(0, state.data()).energy / step;
    EXPECT_LT(std::abs(change / (2 * step)), rounding);
    EXPECT_GT(vibration, 100 * rounding);
}

// --- Reduction of the shaft --------------------------------------------------------------------

/// Largest difference of the deflections of two motions over the largest deflection.
double difference(const results::SimulateResult &a, const results::SimulateResult &b) {
    double size = 0;
    double largest = 0;
    for (std::size_t plane = 0; plane < a.series.x.size(); ++plane)
        for (std::size_t i = 0; i < a.series.time.size(); ++i) {
            size = std::max(size, std::abs(a.series.x[plane][i]));
            largest = std::max(largest, std::abs(a.series.x[plane][i] - b.series.x[plane][i]));
        }
    return largest / size;
}

TEST(Reduction, GivesTheMotionOfTheWholeShaft) {
    model::Case scene = flexible_rotor(260);
    scene.rotor.shaft.segments.front().elements = 3;
    scene.rotor.shaft.order = 1;
    scene.simulate.time = 0.05;
    scene.simulate.output_points = 101;
    scene.simulate.reduction_tolerance = 1e-4;
    const results::SimulateResult reduced = analyses::simulate(scene);
    EXPECT_LE(reduced.response_error, scene.simulate.reduction_tolerance);
    EXPECT_LE(reduced.frequency_error, scene.simulate.reduction_tolerance);
    scene.simulate.modes = 10000; // all
    const results::SimulateResult whole = analyses::simulate(scene);
    EXPECT_GT(whole.shapes, reduced.shapes);
    EXPECT_LT(whole.response_error, 1e-8); // nothing is left out
    // The sudden start at full speed moves all modes, those that were left out as well: half a part
    // in a thousand.
    EXPECT_GT(difference(whole, reduced), 0);
    EXPECT_LT(difference(whole, reduced), 1e-3);
}

// --- Amplitudes between outputs ----------------------------------------------------------------

// The largest deflection between two output times, two radians of the spin apart, is the largest of
// fifty times as many of them. Within a step of a radian polynomials are wrong by 2e-5.
TEST(AmplitudesBetweenOutputs, AreTheLargestThere) {
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 200;
    scene.simulate.output_points = 401;
    const results::SimulateResult coarse = analyses::simulate(scene);
    constexpr std::size_t parts = 50;
    scene.simulate.output_points = 400 * parts + 1;
    const results::SimulateResult fine = analyses::simulate(scene);
    for (std::size_t plane = 0; plane < 2; ++plane) {
        const std::vector<double> &all = fine.series.amplitude[plane];
        const double size = *std::ranges::max_element(all);
        for (std::size_t i = 1; i < coarse.series.time.size(); ++i) {
            const auto first = all.begin() + static_cast<std::ptrdiff_t>((i - 1) * parts + 1);
            const double largest = *std::max_element(first, first + parts);
            ASSERT_NEAR(coarse.series.amplitude[plane][i], largest, 1e-4 * size) << i;
        }
    }
}

// Rings that go round with the rotor are followed in steps of up to three radians of the spin, in
// axes that turn with it; a hundred times as many outputs leave steps of half a radian. Amplitudes
// are the same to what some 1e4 steps to 1e-8 each add up to, as a random walk 1e-6; polynomials in
// axes that stand still would miss 2e-2 of the deflections within such steps, 1e-4 of the
// amplitude.
TEST(AmplitudesBetweenOutputs, AreThoseOfSmallStepsInLargeOnes) {
    const auto with = [](int points) {
        return analyses::simulate(input::load_case(
            std::filesystem::path(WHIRL_ROOT) / "cases" / "ring_jeffcott",
            {"speeds.count=1", "speeds.from=250", "simulate.time=100", "balancer[0].imbalance=0.05",
             "simulate.output_points=" + std::to_string(points)}));
    };
    const results::SimulateResult large = with(400);
    const results::SimulateResult small = with(40000);
    EXPECT_GT(large.revolutions * 2 * std::numbers::pi, 1.5 * static_cast<double>(large.steps));
    ASSERT_EQ(large.stations.size(), small.stations.size());
    for (std::size_t i = 0; i < small.stations.size(); ++i)
        EXPECT_NEAR(large.stations[i].amplitude / small.stations[i].amplitude, 1, 5e-6);
    ASSERT_TRUE(large.waterfall && small.waterfall);
    ASSERT_EQ(large.waterfall->amplitude.size(), small.waterfall->amplitude.size());
    for (std::size_t k = 0; k < small.waterfall->amplitude.size(); ++k) {
        const auto &a = large.waterfall->amplitude[k];
        const auto &b = small.waterfall->amplitude[k];
        for (std::size_t i = 0; i < b.size(); ++i)
            ASSERT_NEAR(a[i], b[i], 5e-6 * *std::ranges::max_element(b)) << k << " " << i;
    }
}

// --- Interruption ------------------------------------------------------------------------------

TEST(Interruption, LeavesARestartThatGivesTheSameEnd) {
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 200;
    const results::SimulateResult whole = analyses::simulate(scene);
    process::on_progress([](double share, const std::string &) {
        if (share > 0.4 && share < 0.5)
            process::request_interruption();
    });
    const results::SimulateResult part = analyses::simulate(scene);
    process::on_progress(nullptr);
    (void)process::take_interruption();
    ASSERT_TRUE(part.restart);
    EXPECT_LT(part.restart->time, 0.5 * scene.simulate.time);
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "whirl_restart" / "restart.json";
    report::write_restart(file, *part.restart);
    const model::Restart read = report::read_restart(file);
    std::filesystem::remove_all(file.parent_path());
    const results::SimulateResult rest = analyses::simulate(scene, &read);
    ASSERT_FALSE(rest.restart);
    ASSERT_EQ(rest.series.time, whole.series.time);
    // Another row of steps: the integrator's tolerance, 1e-8 a step, grown over some 3000 steps.
    for (std::size_t i = 0; i < whole.series.time.size(); ++i)
        for (std::size_t ball = 0; ball < 4; ++ball)
            ASSERT_NEAR(rest.series.angles[ball][i], whole.series.angles[ball][i], 1e-5);
    EXPECT_NEAR(rest.balancers[0].amplitude, whole.balancers[0].amplitude,
                1e-5 * whole.balancers[0].amplitude);
    EXPECT_NEAR(rest.audit.energy_error, 0, 1e-6 * rest.audit.energy_scale);

    scene.rotor.balancers.pop_back();
    scene.simulate.ball_angles.pop_back();
    EXPECT_THROW((void)analyses::simulate(scene, &read), model::BadInput); // of another scene
    EXPECT_THROW((void)report::read_restart(file), model::BadInput);
}

} // namespace
} // namespace whirl::simulation

#include "operation/level1.h"

#include "model/errors.h"
#include "operation/level1_verdict.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <tuple>

namespace {

using namespace whirl;
using Complex = std::complex<double>;

/// The rotor of a test at 500 rad/s with coupling at mid-span.
model::Case coupled(const tests::RigidJeffcott &rotor) {
    model::Case scene = rotor.scene();
    scene.operation = model::Operation{300, 500, {}};
    scene.level1 = model::Level1Settings{0.5, {}, 13, {}, {}, {}};
    return scene;
}

results::Level1 level1(const model::Case &scene, std::vector<results::Sentence> &notes) {
    const model::Shaft &shaft = scene.rotor.shaft;
    return operation::level1(scene, shaft.rigid ? 1 : shaft.order, notes);
}

results::Level1 level1(const model::Case &scene) {
    std::vector<results::Sentence> notes;
    const results::Level1 out = level1(scene, notes);
    EXPECT_TRUE(notes.empty()) << notes.front();
    return out;
}

/// m l^2 + c l + k - i q = 0 for w = x + i y: on the border l = i w_n, c w_n = q.
TEST(Level1, JeffcottRotor) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    const double threshold = rotor.c * rotor.natural();
    scene.level1->anticipated = 0.4 * threshold;
    const results::Level1 found = level1(scene);
    ASSERT_TRUE(found.critical_cross_coupling.has_value());
    // Rounding of an eigenvalue problem of two unknowns.
    EXPECT_NEAR(*found.critical_cross_coupling / threshold, 1, 1e-10);
    EXPECT_NEAR(*found.critical_frequency / rotor.natural(), 1, 1e-10);
    EXPECT_EQ(found.speed, 500);
    const auto log_dec = [&](double q) {
        const Complex root =
            std::sqrt(Complex(rotor.c * rotor.c, 0) - 4 * rotor.mass * Complex(rotor.kx, -q));
        const Complex l = (-rotor.c + (root.imag() > 0 ? root : -root)) / (2 * rotor.mass);
        return -2 * std::numbers::pi * l.real() / l.imag();
    };
    ASSERT_EQ(found.q.size(), 13U);
    EXPECT_EQ(found.q.front(), 0);
    EXPECT_NEAR(found.q.back() / threshold, 1.5, 1e-9);
    for (std::size_t i = 0; i < found.q.size(); ++i)
        EXPECT_NEAR(found.log_dec[i], log_dec(found.q[i]), 1e-9) << found.q[i];
    EXPECT_NEAR(*found.anticipated_log_dec, log_dec(0.4 * threshold), 1e-9);
}

/// (m l^2 + c l + kx)(m l^2 + c l + ky) + q^2 = 0. Below q = |kx - ky|/2 both motions are damped
/// alike and their frequencies meet there; beyond it one is forward, on the border at
/// l^2 = -(kx + ky)/(2 m), q^2 = c^2 (kx + ky)/(2 m) + (kx - ky)^2/4.
TEST(Level1, BearingsThatDifferBetweenTheirDirections) {
    tests::RigidJeffcott rotor;
    rotor.kx = 0.8e6;
    rotor.ky = 1.2e6;
    model::Case scene = coupled(rotor);
    scene.level1->to = 0.4e6;
    scene.level1->count = 9;
    const results::Level1 found = level1(scene);
    const double border = std::hypot(rotor.c * rotor.natural(), 0.2e6);
    EXPECT_NEAR(*found.critical_cross_coupling / border, 1, 1e-10);
    EXPECT_NEAR(*found.critical_frequency / rotor.natural(), 1, 1e-10);
    for (std::size_t i = 0; i < found.q.size(); ++i) {
        const Complex p = -1e6 + std::sqrt(Complex(0.04e12 - found.q[i] * found.q[i]));
        double nearest = 1e9; // of the roots of both branches
        for (const Complex k : {-p, -std::conj(p), 2e6 + p})
            for (const double sign : {-1.0, 1.0}) {
                const Complex l =
                    (-rotor.c + sign * std::sqrt(rotor.c * rotor.c - 4 * rotor.mass * k)) /
                    (2 * rotor.mass);
                if (l.imag() > 0)
                    nearest =
                        std::min(nearest, std::abs(found.log_dec[i] +
                                                   2 * std::numbers::pi * l.real() / l.imag()));
            }
        // At q = |kx - ky|/2 the root is double: known to the root of rounding.
        EXPECT_LT(nearest, i == 4 ? 1e-6 : 1e-9) << found.q[i];
    }
    EXPECT_GT(found.log_dec[4], 0.5); // still as damped as without
    EXPECT_LT(found.log_dec[8], 0);
}

TEST(Level1, WithoutDampingAnyCouplingDrives) {
    tests::RigidJeffcott rotor;
    rotor.c = 0;
    const results::Level1 found = level1(coupled(rotor));
    EXPECT_EQ(found.critical_cross_coupling, 0);
    EXPECT_EQ(found.log_dec.front(), 0);
    EXPECT_LT(found.log_dec.back(), 0);
}

TEST(Level1, SaysThatARotorGrowsWithoutAddedCoupling) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    model::Bearing seal;
    seal.seal = true;
    seal.z = 0.5;
    const double q = 1.1 * rotor.c * rotor.natural();
    seal.rows.emplace_back().k << 0, q, -q, 0;
    scene.rotor.bearings.push_back(seal);
    std::vector<results::Sentence> notes;
    const results::Level1 found = level1(scene, notes);
    EXPECT_FALSE(found.critical_cross_coupling.has_value());
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("without any added cross coupling"), std::string::npos);
    EXPECT_NE(found.no_critical.find("without any added cross coupling"), std::string::npos);
    scene.level1->anticipated = 1e3;
    notes.clear();
    EXPECT_EQ(level1(scene, notes).level_two, true);
}

TEST(Level1, EstimatesItsError) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 2e7, 0, 3e4);
    scene.operation = model::Operation{100, 300, {}};
    scene.level1 = model::Level1Settings{0.75, {}, 2, {}, {}, {}};
    const auto of_order = [&](int order) {
        scene.rotor.shaft.order = order;
        // Of order 2: its fastest motion grows before, at 1e5 rad/s.
        std::vector<results::Sentence> notes;
        return level1(scene, notes);
    };
    const results::Level1 exact = of_order(12);
    for (const int order : {1, 2, 3}) {
        const results::Level1 found = of_order(order);
        const double error =
            std::abs(*found.critical_cross_coupling / *exact.critical_cross_coupling - 1);
        EXPECT_GT(error, 1e-9) << order; // there is something to estimate
        EXPECT_LT(error, found.error) << order;
        EXPECT_LT(found.error, 3 * error) << order;
    }
}

/// 20 kg on a shaft whose supports hardly damp its bending modes of high order: on elements that
/// resolve them one grows with a tenth of the coupling, at 26 times the spin speed. What is judged
/// is the first forward mode on every mesh, to what its elements leave; order 3 has no such mode.
TEST(Level1, JudgesTheFirstForwardModeOnEveryMesh) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 1e7, 0, 1500);
    scene.rotor.shaft.segments = {
        {1.2, 0.08, 0.08, 0, 0, {"steel", 2.05e11, 2.05e11 / 2.58, 7850}}};
    scene.rotor.discs = {tests::disc(0.35, 20, 0.1, 0.19)};
    scene.rotor.bearings[0].z = 0.1;
    scene.rotor.bearings[1].z = 1.1;
    scene.operation = model::Operation{300, 400, {}};
    scene.level1 = model::Level1Settings{0.62, {}, 2, {}, {}, {}};
    scene.level1->anticipated = 1e4;
    const auto of_order = [&](int order) {
        scene.rotor.shaft.order = order;
        std::vector<results::Sentence> notes;
        results::Level1 found = level1(scene, notes);
        EXPECT_EQ(notes.empty(), !found.judged) << order;
        return found;
    };
    const results::Level1 slow = of_order(3);
    ASSERT_FALSE(slow.judged);
    for (const int order : {4, 6, 8}) {
        const results::Level1 found = of_order(order);
        ASSERT_TRUE(found.judged) << order;
        EXPECT_GT(*found.critical_frequency, 20 * found.speed) << order;
        EXPECT_LT(*found.critical_cross_coupling, 0.2 * *slow.critical_cross_coupling) << order;
        EXPECT_NEAR(*found.judged->critical_cross_coupling / *slow.critical_cross_coupling, 1,
                    1e-5);
        EXPECT_NEAR(*found.judged->critical_frequency / *slow.critical_frequency, 1, 1e-5);
        EXPECT_NEAR(*found.judged->anticipated_log_dec / *slow.anticipated_log_dec, 1, 1e-5);
        EXPECT_EQ(found.level_two, std::optional(false)) << order;
    }
}

/// A long shaft held at its middle by a damper alone, with a seal that drives a bending mode at 674
/// rad/s, eleven times the spin speed: what grows without added coupling is the verdict.
TEST(Level1, JudgesWhatGrowsByItselfHoweverFast) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e8, 1e8, 0, 2e4);
    scene.rotor.shaft.segments = {{2, 0.06, 0.06, 0, 0, {"steel", 2.05e11, 2.05e11 / 2.58, 7850}}};
    scene.rotor.shaft.order = 6;
    scene.rotor.discs = {tests::disc(1, 60, 0.5, 1)};
    scene.rotor.bearings[0].z = 0;
    scene.rotor.bearings[1].z = 2;
    for (const auto &[z, c, kxy] : {std::tuple(1.0, 2e4, 0.0), std::tuple(0.5, 0.0, 3e5)}) {
        model::Bearing seal;
        seal.seal = true;
        seal.z = z;
        seal.rows.emplace_back();
        seal.rows.back().c.diagonal().setConstant(c);
        seal.rows.back().k << 0, kxy, -kxy, 0;
        scene.rotor.bearings.push_back(seal);
    }
    scene.operation = model::Operation{30, 60, {}};
    scene.level1 = model::Level1Settings{1, {}, 2, {}, {}, {}};
    scene.level1->anticipated = 1e4;
    std::vector<results::Sentence> notes;
    const results::Level1 found = level1(scene, notes);
    EXPECT_LT(found.log_dec.front(), 0);
    EXPECT_GT(found.frequency.front(), 10 * found.speed);
    EXPECT_FALSE(found.judged);
    EXPECT_EQ(found.level_two, std::optional(true));
}

constexpr double rpm = std::numbers::pi / 30;

/// By hand: 900 kW at 12000 rpm are 716.197 N m; 3 x 716.197/(0.42 x 0.014) x 1.25 = 456758 N/m.
/// Of blades 1.5 x 716.197/(0.42 x 0.014) = 182703 N/m.
TEST(Level1, CrossCouplingOfAStage) {
    model::Stage stage{"", false, 900e3, {}, 0.42, 0.014, 1.25};
    EXPECT_NEAR(operation::stage_of(stage, 12000 * rpm).cross_coupling, 456758, 1);
    stage.speed = 6000 * rpm; // twice the torque
    EXPECT_NEAR(operation::stage_of(stage, 12000 * rpm).cross_coupling, 2 * 456758, 2);
    EXPECT_EQ(operation::stage_of(stage, 12000 * rpm).speed, 6000 * rpm);
    stage = {"", true, 900e3, {}, 0.42, 0.014, 1};
    EXPECT_NEAR(operation::stage_of(stage, 12000 * rpm).cross_coupling, 182703, 1);
    EXPECT_FALSE(operation::stage_of(stage, 12000 * rpm).density_ratio.has_value());
}

/// The standard's own constants, rounded to two digits and three: 63 with hp, inches and rpm is
/// kips/in, 9.55 with kW, mm and rpm is MN/mm.
TEST(Level1, CrossCouplingInTheUnitsOfTheStandard) {
    constexpr double horsepower = 745.69987;
    constexpr double inch = 0.0254;
    constexpr double kips_per_inch = 4448.2216 / inch;
    const model::Stage stage{"", false, 1200 * horsepower, {}, 16 * inch, 0.5 * inch, 1.3};
    const double imperial = 1200 * 3 * 63 / (16 * 0.5 * 11000) * 1.3 * kips_per_inch;
    EXPECT_NEAR(operation::stage_of(stage, 11000 * rpm).cross_coupling / imperial, 1, 1e-3);
    const double metric =
        1200 * horsepower / 1e3 * 3 * 9.55 / (16 * 25.4 * 0.5 * 25.4 * 11000) * 1.3 * 1e9;
    EXPECT_NEAR(operation::stage_of(stage, 11000 * rpm).cross_coupling / metric, 1, 1e-4);
}

/// Q0 = c w_n = 2e5 N/m; with the coupling Q the decrement is pi c/sqrt(k m) (1 - Q/Q0) but for the
/// square of the damping ratio.
TEST(Level1, SaysWhetherLevelTwoIsRequired) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    EXPECT_FALSE(level1(scene).level_two.has_value());
    EXPECT_TRUE(level1(scene).checks.empty());
    EXPECT_TRUE(level1(scene).verdict.starts_with("level II not judged"));
    const auto with = [&](double ratio) {
        scene.level1->anticipated = rotor.c * rotor.natural() / ratio;
        return level1(scene);
    };
    EXPECT_EQ(with(1.9).level_two, true);
    EXPECT_EQ(with(1.9).checks[0].passes, true); // 0.6 (1 - 1/1.9) = 0.3
    EXPECT_EQ(with(1.9).checks[1].passes, false);
    EXPECT_EQ(with(1.1).checks[0].passes, false); // 0.06
    EXPECT_TRUE(with(1.1).verdict.starts_with("level II required"));
    EXPECT_FALSE(with(2.1).level_two.has_value()); // the gas decides
    EXPECT_EQ(with(10.1).level_two, false);
    EXPECT_TRUE(with(10.1).verdict.starts_with("level II not required"));
    scene.level1->gas_density = 50;
    EXPECT_EQ(with(2.1).level_two, false); // a rigid shaft has no critical speed: region A
    scene.level1->gas_density = 61;
    EXPECT_EQ(with(2.1).level_two, true);
}

/// The same from a stage: 3 P/(omega D H) with omega = 500 rad/s.
TEST(Level1, AnticipatesWhatItsStagesHave) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    const double half = rotor.c * rotor.natural() / 4;
    const double power = half * 500 * 0.4 * 0.01 / 3;
    const model::Stage impeller{"", false, power, {}, 0.4, 0.01, 1};
    scene.level1->stages = {impeller, impeller};
    const results::Level1 found = level1(scene);
    EXPECT_NEAR(*found.anticipated / (2 * half), 1, 1e-12);
    EXPECT_NEAR(*found.checks[1].value, 2, 1e-9);
    scene.level1->anticipated = 2 * half;
    scene.level1->stages.clear();
    EXPECT_NEAR(*level1(scene).anticipated_log_dec, *found.anticipated_log_dec, 1e-12);
}

/// Of blades alone only the decrement is asked for.
TEST(Level1, AxialStagesAreJudgedByTheDecrement) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    const double power = rotor.c * rotor.natural() / 1.5 * 500 * 0.4 * 0.01 / 1.5;
    scene.level1->stages = {{"", true, power, {}, 0.4, 0.01, 1}}; // Q0/QA = 1.5
    const results::Level1 found = level1(scene);
    EXPECT_EQ(found.checks.size(), 1U);
    EXPECT_EQ(found.level_two, false);
}

/// A thin, nearly weightless shaft on two bearings at its ends: sqrt(48 EI/(L^3 m)) on rigid ones,
/// however soft they are.
TEST(Level1, CriticalSpeedRatioIsThatOnRigidSupports) {
    model::Case scene;
    model::Rotor &rotor = scene.rotor;
    rotor = tests::uniform_shaft(1, 0.02, 4);
    rotor.shaft.segments[0].material.rho = 10; // 3 g; lighter ones have motions lost in rounding
    rotor.discs = {tests::disc(0.5, 20, 0.1, 0.2)};
    rotor.bearings = {tests::bearing(0, 1e5, 2e5, 0, 1e3), tests::bearing(1, 1e5, 2e5, 0, 1e3)};
    const double I = std::numbers::pi / 64 * std::pow(0.02, 4);
    const double critical = std::sqrt(48 * 211e9 * I / 20);
    scene.operation = model::Operation{100, 500, {}};
    scene.level1 = model::Level1Settings{0.5, {}, 2, 100, {}, {}};
    scene.level1->gas_density = 30;
    // Shear: (d/L)^2 of the deflection.
    EXPECT_NEAR(*level1(scene).critical_speed_ratio * critical / 500, 1, 1e-3);
    scene.level1->gas_density.reset();
    EXPECT_FALSE(level1(scene).critical_speed_ratio.has_value());
}

/// The corners of the figure, on both sides of its line, and a coupling that must be high enough.
TEST(Level1, RegionsOfTheStandard) {
    const auto required = [](double density, double speed_ratio) {
        results::Level1 numbers;
        numbers.anticipated = 1;
        numbers.anticipated_log_dec = 0.5;
        numbers.critical_cross_coupling = 3;
        numbers.error = 1e-6;
        numbers.gas_density = density;
        numbers.critical_speed_ratio = speed_ratio;
        operation::add_verdict(numbers, {});
        return numbers.level_two;
    };
    EXPECT_EQ(required(1, 2.49), false);
    EXPECT_EQ(required(1, 2.51), true);
    EXPECT_EQ(required(16, 2.49), false);
    EXPECT_EQ(required(59.9, 1.99), false);
    EXPECT_EQ(required(59.9, 2.02), true);
    EXPECT_EQ(required(38, 2.24), false); // half way down: 2.25
    EXPECT_EQ(required(38, 2.27), true);
    EXPECT_EQ(required(61, 0.5), true);
}

TEST(Level1, WhatIsNotKnownIsNotJudged) {
    results::Level1 numbers;
    numbers.anticipated = 1;
    numbers.critical_cross_coupling = 30;
    numbers.error = 1e-6;
    operation::add_verdict(numbers, {}); // no decrement
    EXPECT_FALSE(numbers.level_two.has_value());
    EXPECT_FALSE(numbers.checks[0].passes.has_value());
    EXPECT_FALSE(numbers.checks[0].why.empty());
    numbers = {};
    numbers.anticipated = 1;
    numbers.anticipated_log_dec = 0.5;
    numbers.critical_cross_coupling = 30;
    numbers.error = 1e-6;
    operation::add_verdict(numbers, {0, 20}); // a motion that was not followed grows
    EXPECT_FALSE(numbers.level_two.has_value());
    numbers.checks.clear();
    operation::add_verdict(numbers, {0, 1.5});
    EXPECT_EQ(numbers.level_two, true);
    numbers.checks.clear();
    numbers.critical_cross_coupling.reset();
    numbers.no_critical = "none makes a motion grow";
    operation::add_verdict(numbers, {100, {}});
    EXPECT_EQ(numbers.level_two, false);
    EXPECT_FALSE(numbers.checks[1].value.has_value());
}

TEST(Level1, IsForAxisymmetricRotors) {
    model::Case scene = coupled({});
    scene.rotor.anisotropies.push_back({"", 0.5, 0.001, 0});
    std::vector<results::Sentence> notes;
    EXPECT_THROW((void)level1(scene, notes), model::BadInput);
}

} // namespace

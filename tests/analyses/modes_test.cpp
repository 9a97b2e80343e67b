#include "analyses/critical.h"
#include "analyses/modes.h"
#include "model/errors.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "results/whirl.h"
#include "support/balancer_parts.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace {

using namespace whirl;

model::Case pinned_shaft(double speed) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    scene.rotor.shaft.order = 12;
    scene.rotor.shaft.segments[0].elements = 4;
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e15), tests::isotropic_bearing(1, 1e15)};
    scene.speeds = model::SpeedRange{speed, 0, 1};
    scene.campbell.modes = 6;
    return scene;
}

/// A pinned uniform Timoshenko beam bends as sin(n pi z / L) whatever its shear and rotary
/// inertia; the springs are 1e15 / (48 EI / L^3) = 3e8 times stiffer than the shaft.
TEST(ModeShapes, pinned_uniform_shaft_bends_in_sines) {
    const results::ModesResult result = analyses::mode_shapes(pinned_shaft(500));
    ASSERT_EQ(result.modes.size(), 6U);
    ASSERT_GE(result.z.size(), 60U);
    ASSERT_LE(result.z.size(), 200U);
    for (std::size_t mode = 0; mode < 6; ++mode) {
        const auto n = static_cast<double>(mode / 2 + 1);
        const results::ModeShape &shape = result.modes[mode];
        double largest = 0;
        for (std::size_t i = 0; i < result.z.size(); ++i) {
            const double sine = std::sin(n * std::numbers::pi * result.z[i]);
            // Up to a common factor of modulus 1.
            EXPECT_NEAR(std::abs(shape.x[i]), std::abs(sine), 1e-6) << shape.label;
            const std::complex<double> turn(0, shape.whirl == results::Whirl::forward ? -1 : 1);
            EXPECT_NEAR(std::abs(shape.y[i] - turn * shape.x[i]), 0, 1e-12) << shape.label;
            largest = std::max(largest, std::abs(shape.x[i]));
        }
        EXPECT_NEAR(largest, 1, 1e-12);
    }
}

TEST(ModeShapes, labels_count_each_sense) {
    const results::ModesResult result = analyses::mode_shapes(pinned_shaft(500));
    std::vector<std::string> labels;
    for (const results::ModeShape &shape : result.modes)
        labels.push_back(shape.label);
    EXPECT_EQ(labels, (std::vector<std::string>{"1B", "1F", "2B", "2F", "3B", "3F"}));
    EXPECT_LT(result.modes[0].eigenvalue.imag(), result.modes[1].eigenvalue.imag());
}

/// At rest the modes lie in the principal planes of bearings whose stiffness and damping have them
/// turned from x towards y; on equal bearings, turning, they are circles in no plane.
TEST(ModeShapes, lie_in_the_principal_planes_of_the_bearings) {
    for (const double turned : {0.0, 0.5, -0.3, std::numbers::pi / 2}) {
        Eigen::Matrix2d axes;
        axes << std::cos(turned), -std::sin(turned), std::sin(turned), std::cos(turned);
        model::Case scene = pinned_shaft(0);
        for (model::Bearing &bearing : scene.rotor.bearings) {
            bearing.rows[0].k = axes * Eigen::Vector2d(1e6, 2e6).asDiagonal() * axes.transpose();
            bearing.rows[0].c = 1e-5 * bearing.rows[0].k;
        }
        const results::ModesResult result = analyses::mode_shapes(scene);
        ASSERT_EQ(result.modes.size(), 6U);
        int along = 0;
        for (const results::ModeShape &shape : result.modes) {
            ASSERT_TRUE(shape.plane.has_value()) << turned << " " << shape.label;
            EXPECT_GT(*shape.plane, -4 * std::numbers::pi / 9);
            EXPECT_LE(*shape.plane, 5 * std::numbers::pi / 9);
            const double off = std::remainder(*shape.plane - turned, std::numbers::pi / 2);
            EXPECT_NEAR(off, 0, 1e-7) << turned << " " << shape.label; // vectors: to some 1e-9
            along += std::abs(std::remainder(*shape.plane - turned, std::numbers::pi)) < 1e-3;
        }
        EXPECT_EQ(along, 3);
    }
    for (const results::ModeShape &shape : analyses::mode_shapes(pinned_shaft(500)).modes)
        EXPECT_FALSE(shape.plane.has_value());
}

TEST(ModeShapes, damped_shapes_are_scaled_to_one) {
    model::Case scene = pinned_shaft(500);
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e7, 3e3),
                            tests::isotropic_bearing(1, 2e7, 1e3)};
    scene.rotor.bearings[0].rows[0].k(0, 1) = 1e6;
    const results::ModesResult result = analyses::mode_shapes(scene);
    EXPECT_EQ(result.model.formulation.form, results::Form::general);
    for (const results::ModeShape &shape : result.modes) {
        double largest = 0;
        for (std::size_t i = 0; i < result.z.size(); ++i)
            largest = std::max({largest, std::abs(shape.x[i]), std::abs(shape.y[i])});
        EXPECT_NEAR(largest, 1, 1e-12);
        EXPECT_LT(shape.eigenvalue.real(), 0);
    }
}

/// Over a range of speeds every critical speed has its shape: of a pinned uniform shaft a sine with
/// one more half wave each, forward and backward. The mode there turns as fast as the shaft.
TEST(ModeShapes, at_each_critical_speed) {
    model::Case scene = pinned_shaft(0);
    scene.speeds = model::SpeedRange{0, 5000, 3};
    const results::ModesResult result = analyses::mode_shapes(scene);
    const std::vector<results::CriticalSpeed> critical =
        analyses::critical_speeds(scene).critical_speeds;
    ASSERT_EQ(result.critical.size(), critical.size());
    ASSERT_EQ(critical.size(), 6U);
    std::map<results::Whirl, int> half_waves;
    for (std::size_t i = 0; i < critical.size(); ++i) {
        const results::ModeShape &shape = result.critical[i];
        EXPECT_EQ(shape.at, critical[i].speed);
        EXPECT_EQ(shape.whirl, critical[i].whirl);
        EXPECT_NEAR(shape.eigenvalue.imag() / shape.at, 1, 1e-9); // without damping
        const int n = ++half_waves[shape.whirl];
        EXPECT_EQ(shape.label.substr(0, 1), std::to_string(n));
        for (std::size_t k = 0; k < result.z.size(); ++k)
            EXPECT_NEAR(std::abs(shape.x[k]),
                        std::abs(std::sin(n * std::numbers::pi * result.z[k])), 1e-6);
    }
    EXPECT_TRUE(analyses::mode_shapes(pinned_shaft(500)).critical.empty()) << "one speed asked for";
}

/// Two dampers alone: the shares are those of c |w|^2 at their places, w as it is drawn.
TEST(ModeShapes, dissipate_where_they_move_against_dampers) {
    model::Case scene = pinned_shaft(300);
    scene.rotor.bearings.push_back(tests::isotropic_bearing(0.25, 0, 30));
    scene.rotor.bearings.push_back(tests::isotropic_bearing(0.5, 0, 50));
    const auto at = [](const results::ModesResult &result, const results::ModeShape &shape,
                       double z) {
        std::size_t best = 0;
        for (std::size_t i = 0; i < result.z.size(); ++i)
            if (std::abs(result.z[i] - z) < std::abs(result.z[best] - z))
                best = i;
        EXPECT_NEAR(result.z[best], z, 1e-12);
        return std::norm(shape.x[best]) + std::norm(shape.y[best]);
    };
    const results::ModesResult result = analyses::mode_shapes(scene);
    for (const results::ModeShape &shape : result.modes) {
        ASSERT_EQ(shape.dissipation.size(), 2U) << shape.label;
        const double first = 30 * at(result, shape, 0.25);
        const double second = 50 * at(result, shape, 0.5);
        EXPECT_EQ(shape.dissipation[0].of, "bearing");
        EXPECT_NEAR(*shape.dissipation[0].share, first / (first + second), 1e-9);
        EXPECT_NEAR(*shape.dissipation[0].share + *shape.dissipation[1].share, 1, 1e-12);
    }
}

/// With a balancer: the shaft stands still in the axes that turn with it, bent by the centrifugal
/// forces alone. Of a light pinned shaft with a point mass M at the middle on which a ball stands
/// on either side, W^2 (M + 2 m) = 48 EI/L^3, and it bends as under a load at the middle.
TEST(ModeShapes, with_balls_held_at_critical_speeds) {
    model::Case scene = pinned_shaft(0);
    model::Segment &segment = scene.rotor.shaft.segments.front();
    segment.material.rho = 1e-6;                          // no mass beside that of the disc
    scene.rotor.shaft.shear = model::ShearFormula::given; // nor shear
    scene.rotor.shaft.shear_coefficient = 1e9;
    scene.rotor.shaft.order = 4;
    segment.elements = 1;
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e12), tests::isotropic_bearing(1, 1e12)};
    scene.rotor.discs = {tests::disc(0.5, 2, 0, 0)};
    model::Balancer balancer;
    balancer.z = 0.5;
    model::Balls balls;
    balls.rows = {{2, 0.1, 0.05, 0.1}};
    balancer.parts = balls;
    scene.rotor.balancers = {balancer};
    scene.speeds = model::SpeedRange{0, 500, 3};
    scene.campbell.modes = 2;
    const results::ModesResult result = analyses::mode_shapes(scene);
    ASSERT_FALSE(result.critical.empty());
    const double stiffness =
        48 * segment.material.E * std::numbers::pi / 64 * std::pow(segment.outer_start, 4);
    const results::ModeShape &shape = result.critical.front();
    EXPECT_NEAR(shape.at / std::sqrt(stiffness / 2.2), 1, 1e-5); // springs 3e5 times as stiff
    EXPECT_EQ(shape.whirl, results::Whirl::forward);
    EXPECT_EQ(shape.eigenvalue, std::complex<double>(0, shape.at));
    for (std::size_t k = 0; k < result.z.size(); ++k) {
        const double z = std::min(result.z[k], 1 - result.z[k]);
        EXPECT_NEAR(std::abs(shape.x[k]), 3 * z - 4 * z * z * z, 1e-5);
        EXPECT_NEAR(std::abs(shape.y[k] + std::complex<double>(0, 1) * shape.x[k]), 0, 1e-12);
    }
}

TEST(ModeShapes, need_a_speed) {
    model::Case scene = pinned_shaft(0);
    scene.speeds.reset();
    EXPECT_THROW((void)analyses::mode_shapes(scene), model::BadInput);
    scene.modes.speed = 100;
    EXPECT_EQ(analyses::mode_shapes(scene).modes.front().at, 100);
}

} // namespace

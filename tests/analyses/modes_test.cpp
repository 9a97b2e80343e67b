#include "analyses/modes.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "results/whirl.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(ModeShapes, need_a_speed) {
    model::Case scene = pinned_shaft(0);
    scene.speeds.reset();
    EXPECT_THROW((void)analyses::mode_shapes(scene), model::BadInput);
}

} // namespace

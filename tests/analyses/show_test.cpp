#include "analyses/show.h"
#include "results/formulation.h"
#include "results/show.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace show_test {

using namespace whirl;
using std::numbers::pi;

// Sums of a few products in double precision.
constexpr double rounding = 1e-13;

/// Solid cone from its apex: mass, first and second moments over the apex, polar inertia.
struct Cone {
    double mass, first, second, polar;
    Cone(double rho, double radius, double height)
        : mass(rho * pi * radius * radius * height / 3), first(mass * height * 3 / 4),
          second(mass * 3 / 80 * (4 * radius * radius + height * height) +
                 mass * height * height * 9 / 16),
          polar(0.3 * mass * radius * radius) {}
};

TEST(Show, uniform_shaft_with_a_disc) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.1, tests::steel());
    scene.rotor.shaft.segments[0].elements = 7;
    scene.rotor.discs = {tests::disc_at(0.9, 20, 0.3, 0.5)};
    const results::ShowResult result = analyses::show(scene);
    const double m = 7800 * pi * 0.05 * 0.05 * 1.2;
    const double center = (m * 0.6 + 20 * 0.9) / (m + 20);
    const double Id = m * (3 * 0.05 * 0.05 + 1.2 * 1.2) / 12 + m * (0.6 - center) * (0.6 - center) +
                      0.3 + 20 * (0.9 - center) * (0.9 - center);
    EXPECT_NEAR(result.shaft_mass / m, 1, rounding);
    EXPECT_NEAR(result.mass / (m + 20), 1, rounding);
    EXPECT_NEAR(result.center_of_mass / center, 1, rounding);
    EXPECT_NEAR(result.Id / Id, 1, rounding);
    EXPECT_NEAR(result.Ip / (m * 0.05 * 0.05 / 2 + 0.5), 1, rounding);
    EXPECT_EQ(result.type, "long");
    EXPECT_DOUBLE_EQ(result.length, 1.2);
}

TEST(Show, hollow_cone_is_a_difference_of_cones) {
    model::Case scene;
    // Outer radius 0.04 to 0.08 over 0.5 m: cones of heights 0.5 and 1.0; bore 0.01 to 0.02.
    scene.rotor.shaft.segments.push_back({0.5, 0.08, 0.16, 0.02, 0.04, tests::steel(), 3});
    const results::ShowResult result = analyses::show(scene);
    const double rho = 7800;
    const Cone parts[] = {{rho, 0.08, 1.0}, {rho, 0.04, 0.5}, {rho, 0.02, 1.0}, {rho, 0.01, 0.5}};
    const double sign[] = {1, -1, -1, 1};
    double mass = 0;
    double first = 0;
    double second = 0;
    double polar = 0;
    for (int i = 0; i < 4; ++i) {
        mass += sign[i] * parts[i].mass;
        first += sign[i] * parts[i].first;
        second += sign[i] * parts[i].second;
        polar += sign[i] * parts[i].polar;
    }
    EXPECT_NEAR(result.mass / mass, 1, rounding);
    EXPECT_NEAR(result.center_of_mass / (first / mass - 0.5), 1, 10 * rounding);
    EXPECT_NEAR(result.Id / (second - first * first / mass), 1, 100 * rounding);
    EXPECT_NEAR(result.Ip / polar, 1, rounding);
}

TEST(Show, rigid_type_turns_at_equal_inertias) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.2, 0.1, tests::steel());
    const double m = 7800 * pi * 0.05 * 0.05 * 0.2;
    const double Id = m * (3 * 0.05 * 0.05 + 0.2 * 0.2) / 12 + 0.5;
    const double Ip = m * 0.05 * 0.05 / 2;
    for (const auto &[excess, type] :
         {std::pair(1e-12, "spherical"), std::pair(-1e-7, "long"), std::pair(1e-7, "short")}) {
        scene.rotor.discs = {tests::disc_at(0.1, 10, 0.5, (Id - Ip) * (1 + excess))};
        EXPECT_EQ(analyses::show(scene).type, type);
    }
}

TEST(Show, names_the_form_of_each_command) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.1, tests::steel());
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e7, 10), tests::isotropic_bearing(1, 1e7)};
    const results::ShowResult result = analyses::show(scene);
    // Damped, and the same from every direction.
    for (const auto &[command, formulation] : result.formulations)
        EXPECT_EQ(formulation.form, command == "response" ? results::Form::planar
                                    : command == "critical" || command == "stability"
                                        ? results::Form::general
                                        : results::Form::planar_damped)
            << command;
    EXPECT_EQ(result.formulations.size(), 6U);
}

} // namespace show_test

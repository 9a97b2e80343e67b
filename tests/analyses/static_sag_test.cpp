// A rotor at rest under its weight, against statics and the closed forms of beams.

#include "analyses/show.h"
#include "results/show.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace static_sag_test {

using namespace whirl;
using std::numbers::pi;

constexpr double g = 9.81;
constexpr double kappa = 0.9;
// Polynomials of order 6 contain the bending line (of fourth order); what is left is rounding, of a
// stiffness matrix whose condition is some 1e6.
constexpr double rounding = 1e-9;

struct Shaft {
    double length = 2, diameter = 0.1;
    model::Material material = tests::steel();

    [[nodiscard]] double area() const { return pi * diameter * diameter / 4; }
    [[nodiscard]] double EI() const { return material.E * area() * diameter * diameter / 16; }
    [[nodiscard]] double shear() const { return kappa * material.G * area(); }
    [[nodiscard]] double load() const { return g * material.rho * area(); } ///< N/m

    [[nodiscard]] model::Case scene() const {
        model::Case out;
        out.rotor.shaft = tests::uniform_shaft(length, diameter, material);
        out.rotor.shaft.order = 6;
        out.rotor.shaft.shear = model::ShearFormula::given;
        out.rotor.shaft.shear_coefficient = kappa;
        out.response.gravity = g;
        return out;
    }
};

const results::SagStation &at(const results::StaticSag &sag, double z) {
    for (const auto &station : sag.stations)
        if (std::abs(station.z - z) < 1e-12)
            return station;
    throw std::runtime_error("no station there");
}

// Timoshenko beam on two springs: w/k of the springs, 5 q L^4/(384 EI) + q L^2/(8 kappa G A) in the
// middle, sections turned by q L^3/(24 EI) at the ends.
TEST(StaticSag, UniformShaftOnTwoSprings) {
    const Shaft shaft;
    const double L = shaft.length;
    const double q = shaft.load();
    const double k = 1e7;
    model::Case scene = shaft.scene();
    scene.rotor.bearings = {tests::isotropic_bearing(0, k), tests::isotropic_bearing(L, k)};
    scene.rotor.planes.push_back({"middle", L / 2});
    const auto sag = analyses::show(scene).sag;
    ASSERT_TRUE(sag);
    const double settled = q * L / 2 / k;
    const double middle =
        settled + 5 * q * std::pow(L, 4) / (384 * shaft.EI()) + q * L * L / (8 * shaft.shear());
    EXPECT_NEAR(at(*sag, 0).y / -settled, 1, rounding);
    EXPECT_NEAR(at(*sag, L / 2).y / -middle, 1, rounding);
    const double slope = q * std::pow(L, 3) / (24 * shaft.EI());
    EXPECT_NEAR(at(*sag, 0).slope_y / -slope, 1, rounding) << "downwards from the first bearing";
    EXPECT_NEAR(at(*sag, L).slope_y / slope, 1, rounding);
    for (const auto &bearing : sag->bearings)
        EXPECT_NEAR(bearing.load / (q * L / 2), 1, rounding);
    for (const auto &station : sag->stations) {
        EXPECT_EQ(station.x, 0) << "nothing pushes sideways";
        EXPECT_LT(station.error, rounding);
    }
}

// An overhung disc lifts the shaft out of the far bearing: moments about either one.
TEST(StaticSag, OverhungDiscPullsTheFarBearingUp) {
    const Shaft shaft;
    const double L = shaft.length;
    const double b = 0.5 * L; // of the second bearing
    const double M = 200;
    model::Case scene = shaft.scene();
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e8), tests::isotropic_bearing(b, 3e7)};
    scene.rotor.discs = {tests::disc_at(L, M, 1, 2)};
    const auto sag = analyses::show(scene).sag;
    ASSERT_TRUE(sag);
    const double weight = shaft.load() * L;
    const double second = (weight * L / 2 + M * g * L) / b;
    EXPECT_NEAR(sag->bearings[1].load / second, 1, rounding);
    EXPECT_NEAR(sag->bearings[0].load / (weight + M * g - second), 1, rounding);
    EXPECT_LT(sag->bearings[0].load, 0);
}

// Three supports in a line on a shaft that is stiff in shear: 3 q l/8 at the ends, 5 q l/4 in the
// middle (two equal spans l). Springs of 1e6 times the bending stiffness stand for rigid ones.
TEST(StaticSag, ThreeSupportsInALine) {
    Shaft shaft;
    shaft.material.G = 1e9 * shaft.material.G;
    const double l = shaft.length / 2;
    const double k = 1e6 * 48 * shaft.EI() / std::pow(shaft.length, 3);
    model::Case scene = shaft.scene();
    scene.rotor.shaft.segments[0].elements = 2;
    for (const double z : {0.0, l, 2 * l})
        scene.rotor.bearings.push_back(tests::isotropic_bearing(z, k));
    const auto sag = analyses::show(scene).sag;
    ASSERT_TRUE(sag);
    const double share = shaft.load() * l;
    // What the springs yield beside the shaft: 1e-6, some times over.
    EXPECT_NEAR(sag->bearings[0].load / (3 * share / 8), 1, 2e-5);
    EXPECT_NEAR(sag->bearings[1].load / (5 * share / 4), 1, 2e-5);
    EXPECT_NEAR(sag->bearings[2].load / (3 * share / 8), 1, 2e-5);
}

// Cross coupling pushes the journal sideways: K u = f in each of two equal bearings.
TEST(StaticSag, CrossCouplingMovesItSideways) {
    const Shaft shaft;
    model::Case scene = shaft.scene();
    model::Bearing bearing = tests::isotropic_bearing(0, 1e7);
    bearing.rows[0].k(0, 1) = 4e6;
    bearing.rows[0].k(1, 0) = -4e6;
    scene.rotor.bearings = {bearing, bearing};
    scene.rotor.bearings[1].z = shaft.length;
    const auto sag = analyses::show(scene).sag;
    ASSERT_TRUE(sag);
    const double load = shaft.load() * shaft.length / 2;
    // [k c; -c k] (x, y) = (0, -load)
    const double square = 1e14 + 1.6e13;
    EXPECT_NEAR(at(*sag, 0).x / (4e6 * load / square), 1, rounding);
    EXPECT_NEAR(at(*sag, 0).y / (-1e7 * load / square), 1, rounding);
    EXPECT_NEAR(sag->bearings[0].load / load, 1, rounding);
    EXPECT_NEAR(sag->bearings[0].side / load, 0, rounding);
}

TEST(StaticSag, NothingCarriesAFreeRotor) {
    const Shaft shaft;
    model::Case scene = shaft.scene();
    EXPECT_FALSE(analyses::show(scene).sag);
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e7)};
    EXPECT_FALSE(analyses::show(scene).sag) << "it tips over";
}

} // namespace static_sag_test

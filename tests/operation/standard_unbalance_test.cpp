// Imbalances as API 617 places them, for shapes in closed form and amounts by hand.

#include "operation/standard_unbalance.h"

#include "model/rpm.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace standard_unbalance_test {
namespace {

using namespace whirl;
using operation::api617_unbalance;
using operation::PlacedUnbalance;
using operation::PlaneShape;

constexpr double pi = std::numbers::pi;
constexpr double fastest = 6000 / model::rpm;

/// Stations every 1/n of a length, which need not be where a shape is largest.
PlaneShape shape_of(const std::function<double(double)> &w, double speed, double length = 2,
                    int stations = 73) {
    PlaneShape shape{speed, {}, {}};
    for (int i = 0; i <= stations; ++i) {
        const double z = length * i / stations;
        shape.z.push_back(z);
        shape.w.push_back(w(z));
    }
    return shape;
}

/// 2 m long, 60 mm thick, on its ends. Mass: 7800 * pi/4 * 0.06^2 * 2 = 44.1079 kg.
model::Rotor shaft_on_its_ends() {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(2, 0.06, tests::steel());
    rotor.bearings = {tests::isotropic_bearing(0, 1e9), tests::isotropic_bearing(2, 1e9)};
    return rotor;
}
constexpr double shaft_mass = 44.1079; // to six digits

PlaneShape sine(int loops, double speed, double size = 1) {
    return shape_of([=](double z) { return size * std::sin(loops * pi * z / 2); }, speed);
}

TEST(StandardUnbalance, AmountIsFourWOverNInOunceInches) {
    // 100 lb at 4000 rpm: 0.1 oz in = 0.1 * 28.349523 g * 25.4 mm = 72.0078 g mm.
    EXPECT_NEAR(operation::api617_residual(45.359237, 4000 / model::rpm), 72.0078e-6, 1e-10);
    // 6350 W/N g mm.
    EXPECT_NEAR(operation::api617_residual(60, 3000 / model::rpm), 6350e-6 * 60 / 3000, 1e-15);
}

TEST(StandardUnbalance, OfAUniformShaftAtMidSpanAndQuarterPoints) {
    const auto all =
        api617_unbalance(shaft_on_its_ends(), fastest, {sine(2, 400), sine(1, 100, -3)});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "first bending");
    EXPECT_EQ(all[0].critical_speeds, std::vector<double>{100});
    ASSERT_EQ(all[0].imbalances.size(), 1U);
    // Parabolas through stations: fourth powers of their distance, some (pi/73)^4.
    constexpr double of_parabola = 1e-3;
    EXPECT_NEAR(all[0].imbalances[0].z, 1, of_parabola);
    EXPECT_NEAR(all[0].imbalances[0].mr, 2 * 6.35e-3 * shaft_mass / 6000, 1e-9);
    EXPECT_EQ(all[1].name, "second bending");
    ASSERT_EQ(all[1].imbalances.size(), 2U);
    for (std::size_t i : {0U, 1U}) {
        const model::Imbalance &one = all[1].imbalances[i];
        EXPECT_NEAR(one.z, i == 0 ? 0.5 : 1.5, of_parabola);
        EXPECT_NEAR(one.mr, 6.35e-3 * shaft_mass / 6000, 1e-9); // half the mass each, twice
        EXPECT_EQ(one.phase, i == 0 ? 0 : pi);
        EXPECT_EQ(one.name, "second bending");
    }
    const auto third = api617_unbalance(shaft_on_its_ends(), fastest, {sine(3, 900)});
    ASSERT_EQ(third.at(0).imbalances.size(), 3U);
    EXPECT_EQ(third[0].name, "third bending");
    EXPECT_EQ(third[0].imbalances[1].phase, pi);
    EXPECT_EQ(third[0].imbalances[2].phase, 0);
    EXPECT_NEAR(third[0].imbalances[2].z, 5.0 / 3, of_parabola);
}

TEST(StandardUnbalance, LoadsOfJournalsByMoments) {
    model::Rotor rotor = shaft_on_its_ends();
    rotor.discs = {tests::disc_at(0.5, 40, 1, 2)};
    const auto all = api617_unbalance(rotor, fastest, {sine(2, 400)});
    // 40 kg: three quarters on the left; half of the shaft on each. The disc is at the weight.
    EXPECT_EQ(all.at(0).imbalances.at(0).z, 0.5);
    EXPECT_NEAR(all[0].imbalances[0].mr, 2 * 6.35e-3 * (30 + shaft_mass / 2) / 6000, 1e-9);
    EXPECT_NEAR(all[0].imbalances[1].mr, 2 * 6.35e-3 * (10 + shaft_mass / 2) / 6000, 1e-9);
}

TEST(StandardUnbalance, OverhungMassAtItsEnd) {
    model::Rotor rotor = shaft_on_its_ends();
    rotor.bearings[0].z = 0.25;
    rotor.bearings[1].z = 1.5;
    rotor.discs = {tests::disc_at(1.9, 25, 1, 2)};
    // Straight outside, a shallow arc between: largest at the end.
    const auto w = [](double z) {
        return z < 1.5 ? 0.4 * std::sin(pi * (z - 0.25) / 1.25) : -2 * (z - 1.5);
    };
    const auto all = api617_unbalance(rotor, fastest, {shape_of(w, 200)});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "first bending"); // the span moves two fifths of it
    EXPECT_EQ(all[1].name, "overhung right");
    ASSERT_EQ(all[1].imbalances.size(), 1U);
    EXPECT_EQ(all[1].imbalances[0].z, 2);
    // A quarter of the shaft and the disc.
    EXPECT_NEAR(all[1].imbalances[0].mr, 2 * 6.35e-3 * (25 + shaft_mass / 4) / 6000, 1e-9);
    const auto still = [&w](double z) { return z < 1.5 ? w(z) / 10 : w(z); };
    const auto alone = api617_unbalance(rotor, fastest, {shape_of(still, 200)});
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone[0].name, "overhung right");
    const auto mirrored = [](double z) { return z < 0.25 ? 4 * (0.25 - z) : 0.0; };
    const auto left = api617_unbalance(rotor, fastest, {shape_of(mirrored, 200)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].name, "overhung left");
    EXPECT_EQ(left[0].imbalances[0].z, 0);
    EXPECT_NEAR(left[0].imbalances[0].mr, 2 * 6.35e-3 * shaft_mass / 8 / 6000, 1e-9);
}

TEST(StandardUnbalance, RigidMotionsHaveNoWeightsInJournals) {
    const auto conical = api617_unbalance(shaft_on_its_ends(), fastest,
                                          {shape_of([](double z) { return z - 1; }, 300)});
    ASSERT_EQ(conical.at(0).imbalances.size(), 2U);
    EXPECT_EQ(conical[0].name, "second bending");
    EXPECT_DOUBLE_EQ(conical[0].imbalances[0].z, 0.5);
    EXPECT_DOUBLE_EQ(conical[0].imbalances[1].z, 1.5);
    const auto tilted = api617_unbalance(shaft_on_its_ends(), fastest,
                                         {shape_of([](double z) { return 2 + z; }, 300)});
    EXPECT_EQ(tilted.at(0).name, "first bending");
    EXPECT_DOUBLE_EQ(tilted[0].imbalances.at(0).z, 1);
}

TEST(StandardUnbalance, ModesThatPlaceTheSameShareARun) {
    const auto skew = [](double z) { return std::sin(pi * std::pow(z / 2, 1.5)); };
    const auto all = api617_unbalance(shaft_on_its_ends(), fastest,
                                      {sine(1, 100), sine(1, 120), shape_of(skew, 150)});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].critical_speeds, (std::vector<double>{100, 120}));
    EXPECT_EQ(all[1].name, "first bending 2");
    EXPECT_NEAR(all[1].imbalances[0].z, 2 * std::pow(0.5, 2.0 / 3), 2e-3);
    EXPECT_TRUE(api617_unbalance(shaft_on_its_ends(), fastest, {}).empty());
    // A shape that does not move places nothing.
    EXPECT_TRUE(api617_unbalance(shaft_on_its_ends(), fastest, {sine(1, 100, 0)}).empty());
}

TEST(StandardUnbalance, MassOfConesBetweenTwoPlaces) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.1, tests::steel());
    rotor.shaft.segments[0].outer_end = 0;
    // A cone with its tip at 1: rho pi/12 d^2 h; that between 0.5 and 1 an eighth of it, with its
    // centre a quarter of its height from the base.
    const double whole = 7800 * pi / 12 * 0.01;
    rotor.bearings = {tests::isotropic_bearing(0, 1e9), tests::isotropic_bearing(0.5, 1e9)};
    const auto tip = [](double z) { return z > 0.5 ? z - 0.5 : 0.0; };
    const auto all = api617_unbalance(rotor, fastest, {shape_of(tip, 100, 1)});
    EXPECT_NEAR(all.at(0).imbalances.at(0).mr, 2 * 6.35e-3 * whole / 8 / 6000, 1e-15);
    // The centre of mass is at 1/4 of the height: half of it on each bearing.
    const auto two = [](double z) { return z < 0.5 ? std::sin(4 * pi * z) : 0.0; };
    const auto loops = api617_unbalance(rotor, fastest, {shape_of(two, 100, 1)});
    for (const model::Imbalance &one : loops.at(0).imbalances)
        EXPECT_NEAR(one.mr, 6.35e-3 * whole / 6000, 1e-15);
}

} // namespace
} // namespace standard_unbalance_test

#include "model/case.h"
#include "model/mass.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace whirl;

/// Two rows: at 100 and at 300 rad/s.
model::Bearing table() {
    model::Bearing out = tests::bearing(0, 1e6, 2e6, 1e5, 10);
    out.speeds = {100, 300};
    out.rows.push_back(out.rows[0]);
    out.rows[1].k *= 3;
    out.rows[1].c(0, 1) = 8;
    return out;
}

TEST(Bearing, TableIsLinearBetweenRowsAndConstantOutside) {
    const model::Bearing b = table();
    EXPECT_TRUE(b.depends_on_speed());
    EXPECT_DOUBLE_EQ(b.at(0).k(0, 0), 1e6);
    EXPECT_DOUBLE_EQ(b.at(100).k(1, 1), 2e6);
    EXPECT_DOUBLE_EQ(b.at(150).k(0, 0), 1.5e6);
    EXPECT_DOUBLE_EQ(b.at(250).k(1, 0), 2.5e5);
    EXPECT_DOUBLE_EQ(b.at(200).c(0, 1), 4);
    EXPECT_DOUBLE_EQ(b.at(300).k(0, 0), 3e6);
    EXPECT_DOUBLE_EQ(b.at(1e5).c(0, 1), 8);
}

TEST(Bearing, OfOneRowIsTheSameAtEverySpeed) {
    const model::Bearing b = tests::bearing(0, 1e6, 2e6);
    EXPECT_FALSE(b.depends_on_speed());
    EXPECT_DOUBLE_EQ(b.at(0).k(1, 1), 2e6);
    EXPECT_DOUBLE_EQ(b.at(1e3).k(1, 1), 2e6);
}

TEST(Rotor, KnowsWhatItsBearingsAre) {
    EXPECT_TRUE(tests::two_disc_rotor(1e6, 1e6).bearings_isotropic());
    EXPECT_TRUE(tests::two_disc_rotor(1e6, 1e6).bearings_orthotropic());
    EXPECT_FALSE(tests::two_disc_rotor(1e6, 2e6).bearings_isotropic());
    EXPECT_TRUE(tests::two_disc_rotor(1e6, 2e6).bearings_orthotropic());
    EXPECT_FALSE(tests::two_disc_rotor(1e6, 1e6, 1).bearings_isotropic());
    EXPECT_FALSE(tests::two_disc_rotor(1e6, 1e6, 1).bearings_orthotropic());
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    rotor.bearings[0].rows[0].kt(1, 1) = 5; // tilt coefficients count as well
    EXPECT_FALSE(rotor.bearings_isotropic());
    rotor.bearings[0].rows[0].kt(1, 0) = 5;
    EXPECT_FALSE(rotor.bearings_orthotropic());
}

TEST(Rotor, KnowsWhetherAnythingIsDamped) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    EXPECT_FALSE(rotor.damped());
    EXPECT_TRUE(tests::two_disc_rotor(1e6, 1e6, 0, 1).damped());
    rotor.shaft.internal_damping = 1e-6;
    EXPECT_TRUE(rotor.damped());
    rotor.shaft.internal_damping = 0;
    rotor.bearings[1].pedestal = model::Pedestal{1, 1, 0};
    EXPECT_FALSE(rotor.damped());
    rotor.bearings[1].pedestal->c.setConstant(2);
    EXPECT_TRUE(rotor.damped());
    rotor.bearings[1].pedestal.reset();
    rotor.bearings[0] = table();
    rotor.bearings[0].rows[0].c.setZero();
    EXPECT_TRUE(rotor.damped()); // at a speed of the table
    EXPECT_TRUE(rotor.bearings_depend_on_speed());
}

TEST(Rotor, RotatingAnisotropyIsAnAnisotropyOrABalancer) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    EXPECT_FALSE(rotor.rotating_anisotropy());
    rotor.balancers.emplace_back();
    EXPECT_TRUE(rotor.rotating_anisotropy());
}

// Hollow cylinders m (Ro^2 + Ri^2)/2, a cone to a point 3 m R^2/10.
TEST(Mass, PolarInertiaIsThatOfCylindersAndCones) {
    const double pi = std::numbers::pi;
    const model::Material steel{"steel", 2e11, 8e10, 7800};
    const model::Material lead{"lead", 1, 1, 11340};
    const auto cylinder = [pi](double rho, double outer, double inner) { // per length
        const double mass = rho * pi * (outer * outer - inner * inner) / 4;
        return mass * (outer * outer + inner * inner) / 8;
    };
    model::Shaft shaft;
    shaft.segments = {{0.5, 0.1, 0.1, 0.04, 0.04, steel}, {0.3, 0.06, 0, 0, 0, steel}};
    shaft.segments[0].layers = {{0.14, 0.1, lead}};
    const double cone = 7800 * pi / 12 * 0.06 * 0.06 * 0.3;
    const double sum =
        0.5 * (cylinder(7800, 0.1, 0.04) + cylinder(11340, 0.14, 0.1)) + 0.3 * cone * 0.03 * 0.03;
    EXPECT_NEAR(model::polar_inertia_of(shaft), sum, 1e-14 * sum);
    shaft.segments[0].mass_outer = 0.12; // what has mass is another
    shaft.segments[0].mass_inner = 0.02;
    const double heavier = sum + 0.5 * (cylinder(7800, 0.12, 0.02) - cylinder(7800, 0.1, 0.04));
    EXPECT_NEAR(model::polar_inertia_of(shaft), heavier, 1e-14 * heavier);
    shaft.rotary_inertia = false;
    EXPECT_EQ(model::polar_inertia_of(shaft), 0);
}

TEST(SpeedRange, IsEvenAndEndsExactly) {
    const model::SpeedRange range{10, 1000.0 / 3, 7};
    const std::vector<double> values = range.values();
    ASSERT_EQ(values.size(), 7U);
    EXPECT_EQ(values.front(), 10);
    EXPECT_EQ(values.back(), 1000.0 / 3);
    EXPECT_NEAR(values[3], (10 + 1000.0 / 3) / 2, 1e-12);
    EXPECT_EQ((model::SpeedRange{42, 0, 1}).values(), std::vector<double>{42});
}

TEST(Disc, FromItsGeometry) {
    // Friswell et al. (2010), section 5.9: 280 mm x 70 mm, bore 50 mm, 7810 kg/m3.
    const model::Disc disc = model::disc_from_geometry(0.5, 0.28, 0.05, 0.07, 7810);
    EXPECT_NEAR(disc.mass, 32.58972765, 5e-9);
    EXPECT_NEAR(disc.Id, 0.178089283, 5e-10);
    EXPECT_NEAR(disc.Ip, 0.329563621, 5e-10);
}

TEST(Material, PoissonRatioOfItsModuli) {
    EXPECT_NEAR((model::Material{"", 2.6e11, 1e11, 1}).poisson_ratio(), 0.3, 1e-15);
}

} // namespace

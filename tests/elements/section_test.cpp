#include "elements/section.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace whirl;
using elements::shear_coefficient;
using model::ShearFormula;

TEST(ShearCoefficient, CowperAtNuThreeTenths) {
    // Solid: 6 * 1.3 / 8.8. Bore half the diameter: 12.1875 / 19.65. Thin wall: 2.6 / 4.9.
    EXPECT_NEAR(shear_coefficient(ShearFormula::cowper, 0.3, 0), 7.8 / 8.8, 1e-15);
    EXPECT_NEAR(shear_coefficient(ShearFormula::cowper, 0.3, 0.5), 12.1875 / 19.65, 1e-15);
    EXPECT_NEAR(shear_coefficient(ShearFormula::cowper, 0.3, 1), 2.6 / 4.9, 1e-15);
}

TEST(ShearCoefficient, CowperAtNuZeroIsSixSeventhsForASolidCircle) {
    EXPECT_NEAR(shear_coefficient(ShearFormula::cowper, 0, 0), 6.0 / 7, 1e-15);
}

TEST(ShearCoefficient, HutchinsonAtNuThreeTenths) {
    // 6 (a2 + b2)^2 (1 + nu)^2 over 7a4 + 34a2b2 + 7b4 + nu(12a4 + 48a2b2 + 12b4) + nu2(4a4 +
    // 16a2b2 + 4b4), a = 2, b = 1: 253.5 / 385.68. Solid: 10.14 / 10.96. Thin wall: 1.3 / 2.3.
    EXPECT_NEAR(shear_coefficient(ShearFormula::hutchinson, 0.3, 0), 10.14 / 10.96, 1e-15);
    EXPECT_NEAR(shear_coefficient(ShearFormula::hutchinson, 0.3, 0.5), 253.5 / 385.68, 1e-15);
    EXPECT_NEAR(shear_coefficient(ShearFormula::hutchinson, 0.3, 1), 1.3 / 2.3, 1e-15);
}

TEST(Section, OfAHollowConeAtMidLength) {
    elements::Beam beam;
    beam.span = {0, 1, 0.10, 0.06, 0.02, 0.04, 0}; // at mid-length 80 mm outside, 30 mm inside
    beam.material = {"m", 2e11, 8e10, 8000};
    beam.shear = ShearFormula::given;
    beam.given_shear_coefficient = 0.9;
    const elements::Section s = beam.at(0.5);
    const double pi = std::numbers::pi;
    EXPECT_NEAR(s.rhoA, 8000 * pi * (0.08 * 0.08 - 0.03 * 0.03) / 4, 1e-12);
    EXPECT_NEAR(s.EI, 2e11 * pi * (4.096e-5 - 8.1e-7) / 64, 1e-8);
    EXPECT_NEAR(s.rhoI, 8000 * pi * (4.096e-5 - 8.1e-7) / 64, 1e-14);
    EXPECT_NEAR(s.kappaGA, 0.9 * 8e10 * pi * 0.0055 / 4, 1e-5);
    EXPECT_FALSE(beam.uniform());
}

/// Steel of 20 mm in aluminium of 40 mm.
elements::Beam layered_beam() {
    elements::Beam beam;
    beam.span = {0, 1, 0.02, 0.02, 0, 0, 0};
    beam.material = {"steel", 2e11, 8e10, 7800};
    beam.shear = ShearFormula::given;
    beam.given_shear_coefficient = 0.9;
    beam.layers = {{0.04, 0.02, {"aluminium", 7e10, 2.6e10, 2700}}};
    return beam;
}

TEST(Section, StiffnessAndMassOfALayerAddUp) {
    const elements::Section s = layered_beam().at(0.3);
    const double pi = std::numbers::pi;
    const double core = pi * 1e-4;        // m2
    const double tube = pi * 3e-4;        // m2
    const double I_core = pi * 1e-8 / 4;  // m4
    const double I_tube = pi * 15e-8 / 4; // m4
    EXPECT_NEAR(s.EI, 2e11 * I_core + 7e10 * I_tube, 1e-12 * s.EI);
    EXPECT_NEAR(s.rhoA, 7800 * core + 2700 * tube, 1e-12 * s.rhoA);
    EXPECT_NEAR(s.rhoI, 7800 * I_core + 2700 * I_tube, 1e-12 * s.rhoI);
    EXPECT_NEAR(s.kappaGA, 0.9 * (8e10 * core + 2.6e10 * tube), 1e-12 * s.kappaGA);
}

/// The rotary inertia alone goes; next to nothing of it is left so that masses stay positive.
TEST(Section, WithoutRotaryInertiaKeepsAllElse) {
    elements::Beam beam = layered_beam();
    const elements::Section with = beam.at(0.3);
    beam.rotary_inertia = false;
    const elements::Section without = beam.at(0.3);
    EXPECT_EQ(without.EI, with.EI);
    EXPECT_EQ(without.kappaGA, with.kappaGA);
    EXPECT_EQ(without.rhoA, with.rhoA);
    EXPECT_GT(without.rhoI, 0);
    EXPECT_LT(without.rhoI, 1e-8 * with.rhoI);
}

} // namespace

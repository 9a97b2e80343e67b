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

} // namespace

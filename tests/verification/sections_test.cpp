// Sections of other make: layers, mass that carries no load, shear coefficients of their own, no
// rotary inertia.

#include "results/formulation.h"
#include "results/whirl.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sections_test {

using namespace whirl;
using results::Form;

constexpr std::array forms{Form::planar, Form::hyperbolic, Form::general};

/// A shaft on two stiff bearings, its shear coefficient a number so that it does not depend on the
/// section.
model::Rotor supported() {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05);
    rotor.shaft.shear = model::ShearFormula::given;
    rotor.shaft.shear_coefficient = 0.9;
    rotor.bearings = {tests::bearing(0, 1e9, 1e9), tests::bearing(1, 1e9, 1e9)};
    return rotor;
}

std::vector<double> frequencies(const model::Rotor &rotor, Form form, double speed = 300) {
    std::vector<double> out;
    for (const auto &mode : tests::spectrum_of(rotor, form, 8, speed, 6).modes)
        out.push_back(mode.eigenvalue.imag());
    return out;
}

/// In every form.
void expect_same_frequencies(const model::Rotor &a, const model::Rotor &b) {
    for (const Form form : forms) {
        const auto of_a = frequencies(a, form);
        const auto of_b = frequencies(b, form);
        ASSERT_EQ(of_a.size(), of_b.size());
        ASSERT_FALSE(of_a.empty());
        // Rounding of sums in another order, in stiff matrices.
        for (std::size_t i = 0; i < of_a.size(); ++i)
            EXPECT_NEAR(of_a[i] / of_b[i], 1, 1e-9) << results::form_name(form) << ' ' << i;
    }
}

TEST(Sections, TubesOfOneMaterialAreTheWholeSection) {
    model::Rotor layered = supported();
    model::Segment &segment = layered.shaft.segments.front();
    segment.outer_start = segment.outer_end = 0.03;
    segment.layers = {{0.04, 0.03, segment.material}, {0.05, 0.04, segment.material}};
    expect_same_frequencies(layered, supported());
}

TEST(Sections, MassThatCarriesNoLoadIsALayerWithoutStiffness) {
    model::Rotor heavy = supported();
    heavy.shaft.segments.front().mass_outer = 0.08;
    model::Rotor wrapped = supported();
    model::Segment &segment = wrapped.shaft.segments.front();
    // Soft as nothing beside steel: 1e-13 of it.
    segment.layers = {{0.08, 0.05, {"lead", 2e-2, 8e-3, segment.material.rho}}};
    expect_same_frequencies(heavy, wrapped);
}

TEST(Sections, AShearCoefficientOfTheSegmentReplacesThatOfTheShaft) {
    model::Rotor own = supported();
    own.shaft.shear_coefficient = 0.2;
    own.shaft.segments.front().shear_coefficient = 0.9;
    expect_same_frequencies(own, supported());
}

TEST(Sections, WithoutRotaryInertiaAndShearTheBeamIsEulers) {
    // On springs far stiffer than itself: w = (n pi / L)^2 sqrt(EI / rho A), whatever the speed.
    model::Rotor rotor = supported();
    rotor.shaft.rotary_inertia = false;
    rotor.shaft.segments.front().elements = 4;
    rotor.shaft.shear_coefficient = 1e4;
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows.front().k *= 1e4;
    const model::Material &m = rotor.shaft.segments.front().material;
    const double first = std::pow(std::numbers::pi, 2) * std::sqrt(m.E / m.rho) * 0.05 / 4;
    for (const Form form : forms) {
        const auto found = frequencies(rotor, form);
        ASSERT_GE(found.size(), 6U) << results::form_name(form);
        for (std::size_t i = 0; i < 6; ++i) {
            const double n = static_cast<double>(i / 2 + 1);
            // Lower by shear, E r^2 (n pi / L)^2 / (8 kappa G) = 2e-6 at n = 3, and by the
            // springs, some EI (n pi / L)^3 / k L = 2e-6.
            EXPECT_NEAR(found[i] / (n * n * first), 1, 5e-6)
                << results::form_name(form) << ' ' << i;
        }
    }
}

} // namespace sections_test

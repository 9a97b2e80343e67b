// The continuum solution against tables of an independent program and closed forms.

#include "oracles/continuum_roots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl::oracles;

constexpr double rpm_4000 = 4000 * std::numbers::pi / 30;

Cylinder steel(double length, double outer, double inner = 0) {
    return {length, outer, inner, 211e9, 81.2e9, 7810, 0};
}

Support support(double z, double kxx, double kyy, double kxy = 0, double c = 0) {
    Support out;
    out.z = z;
    out.k = {{{kxx, kxy}, {kxy, kyy}}};
    out.c = {{{c, 0}, {0, c}}};
    return out;
}

/// Hollow steel disc 70 mm wide on the shaft of 50 mm: what the tables were computed with, of which
/// they print nine digits.
RigidDisc disc(double z, double outer) {
    const double width = 0.07;
    const double ro2 = outer * outer / 4;
    const double ri2 = 0.05 * 0.05 / 4;
    const double mass = 7810 * std::numbers::pi * (ro2 - ri2) * width;
    return {z, mass, mass * (3 * (ro2 + ri2) + width * width) / 12, mass * (ro2 + ri2) / 2};
}

/// Friswell et al. (2010), section 5.9: two discs.
SteppedRotor friswell(double kxx, double kyy, double kxy = 0, double c = 0) {
    SteppedRotor rotor;
    rotor.shaft = {steel(1.5, 0.05)};
    rotor.discs = {disc(0.5, 0.28), disc(1.0, 0.35)};
    rotor.supports = {support(0, kxx, kyy, kxy, c), support(1.5, kxx, kyy, kxy, c)};
    return rotor;
}

/// Nine decimals of at least two digits before the point.
constexpr double table_digits = 1e-11;

void expect_frequencies(const SteppedRotor &rotor, double speed,
                        const std::vector<double> &expected) {
    const auto found = frequencies(Continuum(rotor), {Motion::both, speed, false},
                                   static_cast<int>(expected.size()), 1e6);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(static_cast<double>(found[i]), expected[i], table_digits * expected[i]);
}

TEST(Continuum, isotropic_two_disc_rotor_at_rest) {
    expect_frequencies(friswell(1e6, 1e6), 0,
                       {86.658012966, 86.658012966, 274.307101616, 274.307101616, 716.563496678,
                        716.563496678, 1065.441759970, 1065.441759970, 1681.792116588,
                        1681.792116588, 2370.084476467, 2370.084476467});
}

TEST(Continuum, isotropic_two_disc_rotor_at_speed) {
    expect_frequencies(friswell(1e6, 1e6), rpm_4000,
                       {85.389371234, 87.795757223, 251.780522966, 294.705832592, 600.081288407,
                        826.656769092, 1038.404205182, 1087.370266371, 1506.532678585,
                        1961.833105133});
}

TEST(Continuum, orthotropic_two_disc_rotor) {
    expect_frequencies(friswell(1e6, 0.8e6), rpm_4000,
                       {82.325386021, 86.863596420, 239.638609059, 287.242525983, 583.395771128,
                        806.498905095, 1017.968249296, 1074.485832445, 1495.347187987,
                        1957.205562876});
}

TEST(Continuum, cross_coupled_two_disc_rotor) {
    expect_frequencies(friswell(1e6, 1e6, 5e5), rpm_4000,
                       {73.209787782, 92.915592723, 208.316360311, 312.188177352, 561.721073757,
                        840.193619676, 975.802970361, 1142.607470699});
}

void expect_eigenvalue(const SteppedRotor &rotor, const Question &question, Complex expected,
                       double tolerance) {
    const auto found =
        eigenvalue_near(Continuum(rotor), question, expected * Complex(1.01L, 0.01L));
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(static_cast<double>(std::abs(*found - expected)),
              tolerance * static_cast<double>(std::abs(expected)));
}

TEST(Continuum, damped_two_disc_rotor) {
    for (const Complex expected :
         {Complex(-4.423815931L, 87.257832295L), Complex(-78.234444267L, 292.415405960L),
          Complex(-566.247445993L, 649.495679085L), Complex(-657.041125857L, 836.263249145L)})
        expect_eigenvalue(friswell(1e6, 1e6, 0, 3e3), {Motion::forward, 0, false}, expected,
                          2 * table_digits);
}

TEST(Continuum, overhung_rotor) {
    SteppedRotor rotor;
    rotor.shaft = {steel(1.5, 0.05)};
    rotor.discs = {disc(1.5, 0.35)};
    rotor.supports = {support(0, 1e7, 1e7), support(1.0, 1e7, 1e7)};
    expect_frequencies(rotor, 0,
                       {90.143011079, 90.143011079, 630.501650602, 630.501650602, 830.311450402,
                        830.311450402, 1628.010635058, 1628.010635058, 2541.735624286,
                        2541.735624286});
}

TEST(Continuum, overhung_rotor_with_one_damped_orthotropic_bearing) {
    SteppedRotor rotor;
    rotor.shaft = {{1.5, 0.025, 0, 211e9, 211e9 / 2.6, 7810, 0}};
    rotor.discs = {{1.5, 15.3, 0.062, 0.120}};
    rotor.supports = {support(0, 1e7, 2e7), support(1.0, 1e7, 2e7, 0, 6e4)};
    for (const Complex expected :
         {Complex(-0.020340403L, 42.292103490L), Complex(-0.028243441L, 46.459606122L),
          Complex(-0.617589769L, 391.753748903L), Complex(-1.357336104L, 406.427970678L)}) {
        const auto found = eigenvalue_near(
            Continuum(rotor), {Motion::both, 1000 * std::numbers::pi / 30, false}, expected);
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(static_cast<double>(found->imag()), static_cast<double>(expected.imag()), 1e-7);
        EXPECT_NEAR(static_cast<double>(found->real()), static_cast<double>(expected.real()), 2e-9);
    }
}

/// Pinned uniform shaft: w = sin(k z), phi = cos(k z) with k = n pi/L leaves a quartic in omega,
/// (S k^2 - rho A w^2)(B k^2 + S - rho I (w^2 - 2 Omega w)) = S^2 k^2.
long double pinned_residual(const Cylinder &c, int n, Real omega, Real speed) {
    const Real r = static_cast<Real>(c.outer) / 2;
    const Real A = std::numbers::pi_v<Real> * r * r;
    const Real I = A * r * r / 4;
    const Real nu = static_cast<Real>(c.E) / (2 * static_cast<Real>(c.G)) - 1;
    const Real S = 6 * (1 + nu) / (7 + 6 * nu) * c.G * A;
    const Real B = c.E * I;
    const Real k = n * std::numbers::pi_v<Real> / c.length;
    const Real m = c.rho * A * omega * omega;
    const Real J = c.rho * I * omega * (omega - 2 * speed);
    // S^2 k^2 taken out: what is left of equal numbers would be rounding.
    const Real value = B * k * k * (S * k * k - m) - S * k * k * J - m * (S - J);
    return value / (B * S * k * k * k * k);
}

TEST(Continuum, pinned_shaft_closed_form) {
    SteppedRotor rotor;
    rotor.shaft = {steel(1, 0.1)};
    // Springs so stiff that their give does not show: deflection at the ends 1e-18 of the rest.
    rotor.supports = {support(0, 1e28, 1e28), support(1, 1e28, 1e28)};
    for (const double speed : {0.0, 700.0}) {
        const auto found = frequencies(Continuum(rotor), {Motion::forward, speed, false}, 8, 1e9);
        ASSERT_EQ(found.size(), 8U);
        for (int n = 1; n <= 8; ++n)
            EXPECT_LT(std::abs(static_cast<double>(pinned_residual(
                          rotor.shaft[0], n, found[static_cast<std::size_t>(n) - 1], speed))),
                      1e-15)
                << n;
    }
}

TEST(Continuum, splitting_a_cylinder_changes_nothing) {
    SteppedRotor whole = friswell(1e6, 3e5);
    SteppedRotor split = whole;
    split.shaft = {steel(0.4, 0.05), steel(1e-9, 0.05), steel(1.1 - 1e-9, 0.05)};
    const Question question{Motion::both, 300, false};
    const auto a = frequencies(Continuum(whole), question, 12, 1e6);
    const auto b = frequencies(Continuum(split), question, 12, 1e6);
    ASSERT_EQ(a.size(), b.size());
    // Positions and lengths in double: a length of 1.1 - 1e-9 is known to 1e-16.
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(static_cast<double>(a[i] / b[i]), 1, 1e-15);
}

TEST(Continuum, a_gap_of_a_billionth_moves_frequencies_by_no_more) {
    SteppedRotor here = friswell(1e6, 1e6);
    SteppedRotor there = here;
    there.discs[0].z += 1.5e-9;
    const Question question{Motion::forward, 300, false};
    const auto a = frequencies(Continuum(here), question, 8, 1e6);
    const auto b = frequencies(Continuum(there), question, 8, 1e6);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(a[i] / b[i]), 1, 2e-8);
        EXPECT_NE(a[i], b[i]);
    }
}

/// A pedestal twice as heavy as nothing: its two springs in series, and its own frequency.
TEST(Continuum, pedestal) {
    SteppedRotor rotor = friswell(1e6, 1e6);
    SteppedRotor series = friswell(1e6 * 3e6 / 4e6, 1e6 * 3e6 / 4e6);
    for (Support &s : rotor.supports) {
        s.pedestal = true;
        s.pedestal_k = 3e6;
    }
    const Question question{Motion::both, 300, false};
    const auto a = frequencies(Continuum(rotor), question, 8, 1e6);
    const auto b = frequencies(Continuum(series), question, 8, 1e6);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(static_cast<double>(a[i] / b[i]), 1, 1e-15);
    for (Support &s : rotor.supports)
        s.pedestal_mass = 1e3; // sqrt(4e6/1e3) = 63 rad/s on the held shaft: two more, twice
    int before = 0;
    int after = 0;
    (void)Continuum(series).determinant_at(200, question, &before);
    (void)Continuum(rotor).determinant_at(200, question, &after);
    EXPECT_EQ(after, before + 4);
}

} // namespace

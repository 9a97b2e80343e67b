// Stations as near to each other as one likes, and meshes as fine as one likes: the same digits as
// the exact solution of the continuum, until the error bar says otherwise.

#include "oracles/continuum_roots.h"
#include "results/formulation.h"
#include "results/whirl.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using modes::Spectrum;
using results::Form;

constexpr double E = 2.1e11;
constexpr double nu = 0.3;
constexpr double G = E / (2 * (1 + nu));
constexpr double rho = 7850;

/// Two halves on soft bearings with a disc beside the station between them.
model::Rotor gap_rotor(double gap, double kyy_over_kxx = 1, double c = 0) {
    model::Rotor rotor;
    model::Segment half = tests::cylinder(0.5, 0.1);
    half.material = {"steel", E, G, rho};
    rotor.shaft.segments = {half, half};
    rotor.shaft.order = 4;
    rotor.discs = {tests::disc(0.5 + gap, 5, 0.01, 0.02)};
    const double k = 1e5;
    rotor.bearings = {tests::bearing(0, k, kyy_over_kxx * k, 0, c),
                      tests::bearing(1, k, kyy_over_kxx * k, 0, c)};
    return rotor;
}

oracles::SteppedRotor gap_continuum(double gap, double kyy_over_kxx = 1, double c = 0) {
    oracles::SteppedRotor rotor;
    rotor.shaft = {{1, 0.1, 0, E, G, rho, 0}};
    rotor.discs = {{0.5 + gap, 5, 0.01, 0.02}};
    const double k = 1e5;
    for (const double z : {0.0, 1.0})
        rotor.supports.push_back(
            {z, {{{k, 0}, {0, kyy_over_kxx * k}}}, {{{c, 0}, {0, c}}}, {}, {}});
    return rotor;
}

constexpr double speed = 50;

class Gap : public ::testing::TestWithParam<double> {};

// Rounding of bearing stiffnesses against those of the shaft, some 1e6 times larger, leaves 1e-11;
// the bending modes carry the error of order 4.
TEST_P(Gap, IsotropicInEveryForm) {
    const oracles::Continuum exact(gap_continuum(GetParam()));
    for (const Form form : {Form::planar, Form::hyperbolic, Form::general, Form::rotating}) {
        const Spectrum found = tests::spectrum_of(gap_rotor(GetParam()), form, 8, speed, 8);
        for (const auto motion : {oracles::Motion::forward, oracles::Motion::backward}) {
            for (const oracles::Real frequency :
                 oracles::frequencies(exact, {motion, speed}, 3, 1e4)) {
                const auto w = static_cast<double>(frequency);
                double nearest = 1e300;
                for (const double other : tests::frequencies(found))
                    nearest = std::min(nearest, std::abs(other - w));
                EXPECT_LT(nearest, 1e-9 * w) << results::form_name(form) << " " << w;
            }
        }
    }
}

TEST_P(Gap, DampedOrthotropic) {
    const oracles::Continuum exact(gap_continuum(GetParam(), 0.8, 200));
    const Spectrum found =
        tests::spectrum_of(gap_rotor(GetParam(), 0.8, 200), Form::general, 8, speed, 6);
    ASSERT_GE(found.modes.size(), 6U);
    for (const auto &mode : found.modes) {
        const std::complex<double> l = mode.eigenvalue;
        const auto root =
            oracles::eigenvalue_near(exact, {oracles::Motion::both, speed}, {l.real(), l.imag()});
        ASSERT_TRUE(root.has_value());
        const std::complex<double> truth(static_cast<double>(root->real()),
                                         static_cast<double>(root->imag()));
        EXPECT_LT(std::abs(l - truth), 1e-9 * std::abs(truth)) << l;
    }
}

INSTANTIATE_TEST_SUITE_P(Distances, Gap,
                         ::testing::Values(1e-1, 1e-2, 1e-3, 2e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8,
                                           2e-9));

/// A pump-like row of short spans, then a cluster of stations within a thousandth of the length.
TEST(ShortSpans, RowOfStationsInACluster) {
    model::Rotor rotor = gap_rotor(0);
    oracles::SteppedRotor same = gap_continuum(0);
    for (int i = 1; i <= 6; ++i) {
        const double z = 0.5 + 1e-4 * i * i;
        rotor.discs.push_back(tests::disc(z, 0.5, 1e-3, 2e-3));
        same.discs.push_back({z, 0.5, 1e-3, 2e-3});
    }
    const oracles::Continuum exact(same);
    const Spectrum found = tests::spectrum_of(rotor, Form::planar, 8, speed, 6);
    const auto truth = oracles::frequencies(exact, {oracles::Motion::forward, speed}, 3, 1e4);
    std::size_t next = 0;
    for (const auto &mode : found.modes) {
        if (mode.whirl != results::Whirl::forward || next == truth.size())
            continue;
        const auto w = static_cast<double>(truth[next++]);
        EXPECT_NEAR(mode.eigenvalue.imag() / w, 1, 1e-9);
    }
    EXPECT_EQ(next, truth.size());
}

/// Largest relative distance of the modes found from the continuum's eigenvalues next to them.
double worst_distance(const Spectrum &found, const oracles::Continuum &exact, double spin) {
    double worst = 0;
    for (const auto &mode : found.modes) {
        const std::complex<double> l = mode.eigenvalue;
        const auto root =
            oracles::eigenvalue_near(exact, {oracles::Motion::both, spin}, {l.real(), l.imag()});
        if (!root)
            return 1;
        const std::complex<double> truth(static_cast<double>(root->real()),
                                         static_cast<double>(root->imag()));
        worst = std::max(worst, std::abs(l - truth) / std::abs(truth));
    }
    return worst;
}

/// One segment of 0.4 mm at the end of three metres, damped.
TEST(ShortSpans, TinyLastSegment) {
    model::Rotor rotor;
    rotor.shaft.segments = {tests::cylinder(3, 0.1, 10), tests::cylinder(0.0004, 0.1)};
    rotor.bearings = {tests::bearing(0.3, 1e8, 1e8, 0, 1e4), tests::bearing(2.7, 1e8, 1e8, 0, 1e4)};
    oracles::SteppedRotor same;
    same.shaft = {{3.0004, 0.1, 0, 211e9, 81.2e9, 7810, 0}};
    for (const double z : {0.3, 2.7})
        same.supports.push_back({z, {{{1e8, 0}, {0, 1e8}}}, {{{1e4, 0}, {0, 1e4}}}, {}, {}});
    for (const int order : {4, 8}) {
        const Spectrum found = tests::spectrum_of(rotor, Form::general, order, 300, 8);
        ASSERT_GE(found.modes.size(), 8U);
        // Ten elements of order 4 leave 4e-9 in the fourth pair.
        EXPECT_LT(worst_distance(found, oracles::Continuum(same), 300), order == 4 ? 1e-8 : 1e-9);
    }
}

/// Like a multistage pump: 123 steps of diameter, the shortest of them 0.5 mm, damped bearings.
TEST(ShortSpans, HundredAndTwentyThreeSteps) {
    model::Rotor rotor;
    oracles::SteppedRotor same;
    double length = 0;
    for (int i = 0; i < 123; ++i) {
        const double h = 0.0005 + 0.02 * ((i * 37) % 101) / 101;
        const double d = 0.08 + 0.06 * ((i * 53) % 97) / 97;
        rotor.shaft.segments.push_back(tests::cylinder(h, d));
        same.shaft.push_back({h, d, 0, 211e9, 81.2e9, 7810, 0});
        length += h;
    }
    for (const double z : {0.1 * length, 0.9 * length}) {
        rotor.bearings.push_back(tests::bearing(z, 5e7, 8e7, 0, 2e4));
        same.supports.push_back({z, {{{5e7, 0}, {0, 8e7}}}, {{{2e4, 0}, {0, 2e4}}}, {}, {}});
    }
    const Spectrum found = tests::spectrum_of(rotor, Form::general, 4, 300, 8);
    ASSERT_GE(found.modes.size(), 8U);
    // 125 elements as stiff as short against supports leave rounding of 1e-9 at most.
    EXPECT_LT(worst_distance(found, oracles::Continuum(same), 300), 1e-8);
}

/// The error printed with a mode covers what rounding leaves at every mesh.
TEST(FineMesh, SameDigitsUntilTheErrorBarSaysOtherwise) {
    const oracles::Continuum exact(gap_continuum(0));
    const auto truth = oracles::frequencies(exact, {oracles::Motion::forward, speed}, 2, 1e4);
    ASSERT_EQ(truth.size(), 2U);
    for (const int elements : {1, 25, 250, 2500}) {
        model::Rotor rotor = gap_rotor(0);
        for (model::Segment &segment : rotor.shaft.segments)
            segment.elements = elements;
        for (const Form form : {Form::planar, Form::general}) {
            if (form == Form::general && elements > 250)
                continue; // ten seconds
            const Spectrum found = tests::spectrum_of(rotor, form, 6, speed, 4);
            for (const oracles::Real frequency : truth) {
                const auto w = static_cast<double>(frequency);
                double nearest = 1e300;
                double bar = 0;
                for (const auto &mode : found.modes)
                    if (std::abs(mode.eigenvalue.imag() - w) < nearest) {
                        nearest = std::abs(mode.eigenvalue.imag() - w);
                        bar = mode.rounding + mode.residual;
                    }
                // Order 6 leaves less than rounding; 1e-3 at most even with 5,000 elements.
                EXPECT_LT(nearest, (bar + 1e-12) * w) << elements;
                EXPECT_LT(bar, 1e-3);
            }
        }
    }
}

/// One bearing: a top. Its slow precession beside the zero of the tilt that nothing resists.
TEST(FreeMotions, SlowPrecessionOfATopAtEveryOrder) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05);
    rotor.discs = {tests::disc(0.25, 10, 0.2, 0.1), tests::disc(1, 5, 0.1, 0.05)};
    rotor.bearings = {tests::bearing(0, 1e6, 1e6)};
    oracles::SteppedRotor same;
    same.shaft = {{1, 0.05, 0, 211e9, 81.2e9, 7810, 0}};
    same.discs = {{0.25, 10, 0.2, 0.1}, {1, 5, 0.1, 0.05}};
    same.supports = {{0, {{{1e6, 0}, {0, 1e6}}}, {}, {}, {}}};
    const oracles::Continuum exact(same);
    const double spin = 360;
    for (const int order : {4, 7, 8, 10, 12, 16}) {
        const Spectrum found = tests::spectrum_of(rotor, Form::planar, order, spin, 6);
        ASSERT_GE(found.modes.size(), 6U);
        EXPECT_EQ(found.modes[0].eigenvalue.imag(), 0);
        for (std::size_t i = 1; i < 4; ++i) {
            const double w = found.modes[i].eigenvalue.imag();
            const bool forward = found.modes[i].whirl == results::Whirl::forward;
            const auto root = oracles::eigenvalue_near(
                exact, {forward ? oracles::Motion::forward : oracles::Motion::backward, spin},
                {0, w});
            ASSERT_TRUE(root.has_value());
            // Order 4: 2e-7 in the second pair.
            EXPECT_NEAR(w / static_cast<double>(root->imag()), 1, order == 4 ? 1e-6 : 1e-8);
        }
        EXPECT_NEAR(found.modes[1].eigenvalue.imag(), 5.0446, 5e-5);
    }
}

/// A soft support in one direction is a support: two motions of one plane are free, not four.
TEST(FreeMotions, DecidedByTheSpringsThereAreNotByTheirSize) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.1, 100);
    rotor.bearings = {tests::bearing(0, 1e3, 0), tests::bearing(1, 1e3, 0)};
    const Spectrum found = tests::spectrum_of(rotor, Form::general, 2, 0, 4);
    int zeros = 0;
    for (const auto &mode : found.modes)
        zeros += mode.eigenvalue == std::complex<double>(0, 0) ? 1 : 0;
    EXPECT_EQ(zeros, 2);
}

} // namespace

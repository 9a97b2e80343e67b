// Scenes on which eigensolvers stumble: huge springs, tiny elements, systems of which a large part
// is wanted, overdamped bearings, great slenderness.

#include "analyses/critical.h"
#include "closed_form/beam_frequencies.h"
#include "elements/section.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "support/random.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using modes::Spectrum;
using results::Form;

/// Exact bending frequencies (rad/s, ascending moduli) of a uniform solid shaft between pins.
std::vector<double> pinned_exact(double length, double diameter, double speed, int waves) {
    closed_form::UniformShaft shaft =
        closed_form::circular_shaft(length, diameter / 2, 0, 211e9, 7810);
    shaft.shear_modulus = 81.2e9;
    const double nu = 211 / (2 * 81.2) - 1;
    shaft.shear_coefficient = 6 * (1 + nu) / (7 + 6 * nu);
    std::vector<double> out;
    for (int n = 1; n <= waves; ++n) {
        std::vector<double> roots;
        for (const double w : closed_form::timoshenko_whirl(shaft, n, speed))
            roots.push_back(std::abs(w));
        std::sort(roots.begin(), roots.end());
        out.push_back(roots[0]);
        out.push_back(roots[1]);
    }
    return out;
}

model::Rotor sprung_shaft(double k, double c, int elements) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.04, elements);
    rotor.bearings = {tests::bearing(0, k, k, 0, c), tests::bearing(1, k, k, 0, c)};
    return rotor;
}

TEST(StiffSprings, AreThePinsOfTheClosedForm) {
    // A spring k below a beam of modal stiffness k1 lowers the frequency by about k1/k: k1 is some
    // 1e7 N/m in the first and 2e8 in the second mode.
    const double speed = 500;
    const std::vector<double> exact = pinned_exact(1, 0.04, speed, 2);
    for (const double k : {1e14, 1e15, 1e16}) {
        for (const Form form : {Form::planar, Form::hyperbolic, Form::general}) {
            const auto found =
                tests::frequencies(tests::spectrum_of(sprung_shaft(k, 0, 1), form, 10, speed, 4));
            ASSERT_GE(found.size(), 4U);
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(found[i] / exact[i], 1, 1e9 / k + 1e-8)
                    << k << " " << results::form_name(form) << " " << i;
        }
    }
}

/// A soft shaft, almost rigid in shear, between pins 1e4 to 1e9 times as stiff as an element,
/// beside which counts of inertia drown.
model::Case between_pins(double E, double diameter, double shear, double spring, double other,
                         int elements) {
    model::Case scene;
    scene.rotor = tests::uniform_shaft(0.9, diameter, elements);
    scene.rotor.shaft.order = 1;
    scene.rotor.shaft.shear = model::ShearFormula::given;
    scene.rotor.shaft.shear_coefficient = shear;
    scene.rotor.shaft.segments[0].material = {"soft", E, E / 2.6, 7800};
    scene.rotor.bearings = {tests::bearing(0, spring, spring), tests::bearing(0.9, other, other)};
    scene.campbell.modes = 6;
    return scene;
}

/// (rho A + rho I k^2 -+ 2 rho I k^2) w^2 = E I k^4 with k = n pi/L, forward and backward.
std::vector<double> critical_of_pins(double E, double diameter, int waves) {
    const double r = diameter / 4; // of gyration
    std::vector<double> exact;
    for (int n = 1; n <= waves; ++n)
        for (const double sign : {1.0, -1.0}) {
            const double k = n * std::numbers::pi / 0.9;
            const double inertia = 1 + r * r * k * k * (1 - 2 * sign);
            if (inertia > 0) // no forward one where the gyroscopic moment outweighs it
                exact.push_back(std::sqrt(E / 7800) * r * k * k / std::sqrt(inertia));
        }
    std::sort(exact.begin(), exact.end());
    return exact;
}

void expect_critical_of_pins(const results::CriticalResult &found, double E, double diameter,
                             int elements) {
    const std::vector<double> exact = critical_of_pins(E, diameter, 4);
    ASSERT_GE(found.critical_speeds.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        const results::CriticalSpeed &one = found.critical_speeds[i];
        const double off = std::abs(one.speed / exact[i] - 1);
        // Two-node elements are off by (k h)^4/720, h their length, of which half is the speed's.
        const double kh = std::ceil((static_cast<double>(i) + 1) / 2) * std::numbers::pi / elements;
        EXPECT_LT(off, std::pow(kh, 4) / 720 + 1e-6) << i;
        EXPECT_LT(off, one.error + 1e-6) << i;
    }
}

TEST(StiffSprings, critical_speeds_of_soft_shafts_between_pins) {
    tests::Random random(3217);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(i);
        const double diameter = random(0.02, 0.06);
        const double E = std::pow(10, random(8.5, 10));
        const double spring = std::pow(10, random(12, 15));
        const int elements = 12 + static_cast<int>(random(0, 20));
        // Shear takes (r k)^2 E/(shear G), 1e-6 at the most, of the stiffness.
        const auto found = analyses::critical_speeds(
            between_pins(E, diameter, 1e6, spring, std::pow(10, random(12, 15)), elements));
        expect_critical_of_pins(found, E, diameter, elements);
        for (const results::CriticalSpeed &one : found.critical_speeds)
            EXPECT_LT(one.error, 1e-2);
    }
}

// Elements of higher order, which tell errors, hold the shear by its stiffness, a billion times
// that of bending: eigenvalues of the whole finer model are rounding, roots of it refined are not.
TEST(StiffSprings, errors_hold_where_shear_hides_the_finer_spectrum) {
    model::Case scene = between_pins(1e9, 0.05, 1e9, 1e14, 1e13, 96);
    scene.speeds = model::SpeedRange{0, 1e4, 3}; // fast ones too, which are lost first
    const auto found = analyses::critical_speeds(scene);
    expect_critical_of_pins(found, 1e9, 0.05, 96);
    const std::vector<double> exact = critical_of_pins(1e9, 0.05, 29);
    ASSERT_EQ(std::count_if(exact.begin(), exact.end(), [](double w) { return w < 1e4; }),
              std::ssize(found.critical_speeds));
    for (std::size_t i = 0; i < found.critical_speeds.size(); ++i) {
        const results::CriticalSpeed &one = found.critical_speeds[i];
        EXPECT_LT(std::abs(one.speed / exact[i] - 1), one.error) << i;
        EXPECT_LT(one.error, 1e-4) << i; // half of (k h)^4/720 of the last is 7e-5
    }
}

TEST(TinyElements, FiveThousandAreRightWithinTheirOwnRoundingEstimate) {
    const std::vector<double> exact = pinned_exact(1, 0.04, 300, 2);
    const Spectrum found = tests::spectrum_of(sprung_shaft(1e14, 0, 5000), Form::planar, 1, 300, 4);
    ASSERT_GE(found.modes.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto &mode = found.modes[i];
        const double error = std::abs(mode.eigenvalue.imag() / exact[i] - 1);
        // The estimate assumes the worst signs; 1e-6: springs and h^2.
        EXPECT_LT(error, mode.rounding + mode.residual + 1e-6) << i;
        EXPECT_LT(error, 1e-3) << i;
    }
}

TEST(LargePartWanted, TwentyFourPairsOfFiftyTwoUnknownsAtRest) {
    // Twelve classical elements; SLEPc 3.18's TOAR fails here in LAPACK, or returns nonsense.
    model::Rotor rotor = sprung_shaft(1e6, 0, 12);
    const auto general = tests::spectrum_of(rotor, Form::general, 1, 0, 24);
    const auto planar = tests::spectrum_of(rotor, Form::planar, 1, 0, 24);
    ASSERT_GE(general.modes.size(), 24U);
    ASSERT_GE(planar.modes.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i) {
        const double w = planar.modes[i].eigenvalue.imag();
        EXPECT_NEAR(general.modes[i].eigenvalue.imag(), w, 1e-9 * w) << i;
    }
}

TEST(Overdamped, BearingsLeaveNoGhostFrequencies) {
    // A rigid shaft bouncing on two springs and dampers: m l^2 + 2 c l + 2 k = 0 in translation,
    // and I/4 l^2 likewise in tilt; above critical damping all of its eigenvalues are real.
    model::Rotor rotor = sprung_shaft(1e6, 5e4, 1);
    rotor.shaft.rigid = true;
    const double m = 7810 * std::numbers::pi * 0.0004 * 1;
    ASSERT_GT(4e4 * 4e4, 2e6 * m); // c_total^2 / 4 > k_total m, with margin
    const Spectrum found = tests::spectrum_of(rotor, Form::general, 1, 0, 4);
    EXPECT_TRUE(found.modes.empty());
    ASSERT_EQ(found.overdamped.size(), 8U);
    const double root = std::sqrt(5e4 * 5e4 * 4 - 4 * m * 2e6);
    for (const double slow : {-4e6 / (1e5 + root), (-1e5 - root) / (2 * m)}) {
        const auto near = std::count_if(found.overdamped.begin(), found.overdamped.end(),
                                        [slow](double l) { return std::abs(l / slow - 1) < 1e-9; });
        EXPECT_EQ(near, 2) << slow; // one a plane
    }
}

TEST(Overdamped, LowModesBetweenClosedDampersApproachPins) {
    // Strong dampers hold the ends like pins: a damper c beside a modal mass m and frequency w
    // leaves a damping ratio of some m w / c and moves the frequency by its square, the weak spring
    // nothing. Rigid motions creep at -k/c; nothing else may appear.
    const std::vector<double> exact = pinned_exact(1, 0.04, 200, 2);
    for (const double c : {1e6, 1e7, 1e8, 1e9}) {
        const Spectrum found =
            tests::spectrum_of(sprung_shaft(1e3, c, 2), Form::general, 8, 200, 4);
        std::vector<std::complex<double>> fast;
        for (const auto &mode : found.modes)
            if (std::abs(mode.eigenvalue) > 0.1) // not the creeping ones, 1e-3 and below
                fast.push_back(mode.eigenvalue);
        ASSERT_GE(fast.size(), 4U) << c;
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(fast[i].imag() / exact[i], 1, 1e-5) << c << " " << i;
            EXPECT_LT(fast[i].real(), 1e-7 * exact[i]) << c << " " << i;
            EXPECT_GT(fast[i].real(), -10 * exact[i] * exact[i] / c) << c << " " << i;
        }
    }
}

/// At rest, the frequency with n half waves: lower root of a w^4 - b w^2 + c = 0 without loss of
/// digits.
double timoshenko_at_rest(double diameter, int n) {
    model::Rotor rotor = tests::uniform_shaft(1, diameter);
    const mesh::ShaftMesh made = mesh::make_mesh(rotor);
    const elements::Section s = elements::beam_of(rotor.shaft, made.spans[0]).at(0);
    const double k2 = std::pow(n * std::numbers::pi, 2);
    const double a = s.rhoA * s.rhoI;
    const double b = s.rhoA * (s.EI * k2 + s.kappaGA) + s.rhoI * s.kappaGA * k2;
    const double c = s.kappaGA * s.EI * k2 * k2;
    return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c)));
}

class Slenderness : public testing::TestWithParam<double> {};

TEST_P(Slenderness, OfAPinnedShaftIsMetFromStubToWire) {
    // length / diameter; springs in the scale of the shaft, so that they are pins to 1e-8.
    const double d = 1 / GetParam();
    const double EI = 211e9 * std::numbers::pi * std::pow(d, 4) / 64;
    const double k = 1e10 * std::min(EI, 81.2e9 * d * d);
    model::Rotor rotor = tests::uniform_shaft(1, d, 1);
    rotor.bearings = {tests::bearing(0, k, k), tests::bearing(1, k, k)};
    // In a stub of length = diameter the sections shear alike, w = 0, below two half waves.
    const std::size_t modes = GetParam() < 5 ? 2 : 4;
    for (const Form form : {Form::planar, Form::general}) {
        const auto found = tests::frequencies(tests::spectrum_of(rotor, form, 10, 0, 4));
        ASSERT_GE(found.size(), 4U);
        for (std::size_t i = 0; i < modes; ++i)
            EXPECT_NEAR(found[i] / timoshenko_at_rest(d, i < 2 ? 1 : 2), 1, 1e-6)
                << results::form_name(form) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(HardScenes, Slenderness, testing::Values(1, 10, 1e2, 1e4, 1e6));

TEST(SphericalDisc, WithoutGyroscopicDifferenceStillHasItsPairs) {
    // Ip = Id: at any speed every whirl pair splits, and the three forms agree.
    model::Rotor rotor = sprung_shaft(1e6, 0, 2);
    rotor.discs = {tests::disc(0.3, 10, 0.05, 0.05)};
    const auto planar = tests::spectrum_of(rotor, Form::planar, 8, 1000, 6);
    const auto general = tests::spectrum_of(rotor, Form::general, 8, 1000, 6);
    for (std::size_t i = 0; i < 6; ++i) {
        const double w = planar.modes[i].eigenvalue.imag();
        EXPECT_NEAR(general.modes[i].eigenvalue.imag(), w, 1e-10 * w);
        EXPECT_EQ(general.modes[i].whirl, planar.modes[i].whirl);
    }
}

} // namespace

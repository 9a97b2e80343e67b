// Motions that no support resists: how many there are of known constraints, counted by hand, and
// that they are what they should be.

#include "assembly/frequency_scales.h"
#include "modes/zero_modes.h"

#include "assembly/assemble.h"
#include "assembly/system.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::modes {

namespace {

using results::Form;

/// A uniform shaft of 1 m with a disc off its middle, so that the centre of mass is at neither.
model::Rotor free_rotor(bool rigid = false) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    rotor.shaft.segments[0].elements = 3;
    rotor.shaft.rigid = rigid;
    rotor.discs = {tests::disc_at(0.3, 12, 0.06, 0.1)};
    return rotor;
}

/// Spring on the deflection and on the slope, damper on the deflection.
model::Bearing support(double z, double k, double kt = 0, double c = 0) {
    model::Bearing bearing = tests::isotropic_bearing(z, k, c);
    bearing.rows[0].kt = kt * Eigen::Matrix2d::Identity();
    return bearing;
}

model::Bearing on_pedestal(model::Bearing bearing, double k) {
    bearing.pedestal = model::Pedestal{5, k, 0};
    return bearing;
}

/// Free motions of one plane, and zero eigenvalues of both planes at rest and at speed.
struct Expected {
    const char *what;
    model::Rotor rotor;
    int motions, at_rest, turning;
};

/// In each plane a free motion makes a double zero at rest. Turning, the tilts in the two planes
/// are coupled by the gyroscopic moment: of their four zeros two leave (precession).
std::vector<Expected> undamped() {
    std::vector<Expected> out;
    const auto add = [&](const char *what, std::vector<model::Bearing> bearings, int motions,
                         int at_rest, int turning) {
        for (const bool rigid : {false, true}) {
            model::Rotor rotor = free_rotor(rigid);
            rotor.bearings = bearings;
            out.push_back({what, rotor, motions, at_rest, turning});
        }
    };
    add("free: translation and tilt", {}, 2, 8, 6);
    add("one bearing: tilt about it", {support(0, 1e6)}, 1, 4, 2);
    add("the softest bearing is one", {support(0, 1e-9)}, 1, 4, 2);
    add("two bearings", {support(0, 1e6), support(1, 1e6)}, 0, 0, 0);
    add("two bearings a millimetre apart", {support(0.4, 1e6), support(0.401, 1e6)}, 0, 0, 0);
    add("two at one place", {support(0.4, 1e6), support(0.4, 3e6)}, 1, 4, 2);
    add("one that holds the slope too", {support(0, 1e6, 1e3)}, 0, 0, 0);
    add("slope alone: translation", {support(0.5, 0, 1e3)}, 1, 4, 4);
    add("forces that cancel at one place", {support(0, 1e6), support(1, -1e6)}, 0, 0, 0);
    add("pedestals that stand on nothing go with the rotor",
        {on_pedestal(support(0, 1e6), 0), on_pedestal(support(1, 1e6), 0)}, 2, 8, 6);
    add("one that does, one bearing on the ground",
        {on_pedestal(support(0, 1e6), 0), support(1, 1e6)}, 1, 4, 2);
    add("pedestals on springs",
        {on_pedestal(support(0, 1e6), 1e7), on_pedestal(support(1, 1e6), 1e7)}, 0, 0, 0);
    add("film without stiffness over a pedestal with it",
        {on_pedestal(support(0, 0), 1e7), support(1, 1e6)}, 1, 4, 2);
    return out;
}

double deflection(const assembly::Combination &at, const Eigen::VectorXd &motion) {
    double out = 0;
    for (const auto &[unknown, coefficient] : at)
        out += coefficient * motion(unknown);
    return out;
}

} // namespace

TEST(ZeroModes, AreCountedByTheConstraintsThereAre) {
    for (const Expected &one : undamped()) {
        const assembly::Discretization d(one.rotor, 4);
        for (const double speed : {0.0, 300.0}) {
            const int both = speed == 0 ? one.at_rest : one.turning;
            const ZeroModes planar = zero_modes(d, Form::planar, speed, speed);
            EXPECT_EQ(planar.motions.cols(), one.motions) << one.what;
            EXPECT_EQ(planar.eigenvalues, both / 2) << one.what << " at " << speed;
            EXPECT_EQ(std::ssize(planar.modes), both / 2) << one.what << " at " << speed;
            for (const Form form : {Form::hyperbolic, Form::general}) {
                const ZeroModes real = zero_modes(d, form, speed, speed);
                EXPECT_EQ(real.motions.cols(), 2 * one.motions) << one.what;
                EXPECT_EQ(real.eigenvalues, both) << one.what << " at " << speed;
                EXPECT_EQ(std::ssize(real.modes), both / 2) << one.what << " at " << speed;
            }
        }
    }
}

/// A circle that turns as x + i y = exp(i w t) has y = -i x; in the hyperbolic form y stands for
/// -i y.
TEST(ZeroModes, CirclesTurnAsTheyAreNamed) {
    const std::complex<double> i(0, 1);
    const assembly::Discretization d(free_rotor(), 4);
    for (const Form form : {Form::hyperbolic, Form::general}) {
        int forward = 0;
        const ZeroModes found = zero_modes(d, form, 300, 300);
        ASSERT_EQ(found.modes.size(), 3U);
        for (const WhirlMode &mode : found.modes) {
            ASSERT_TRUE(mode.whirl == results::Whirl::forward ||
                        mode.whirl == results::Whirl::backward);
            const double sense = mode.whirl == results::Whirl::forward ? 1 : -1;
            forward += sense > 0 ? 1 : 0;
            const Eigen::VectorXcd x = mode.shape(Eigen::seqN(0, d.planar_size(), 2));
            Eigen::VectorXcd y = mode.shape(Eigen::seqN(1, d.planar_size(), 2));
            if (form == Form::hyperbolic)
                y *= i;
            EXPECT_GT(x.norm(), 0);
            EXPECT_LE((y + sense * i * x).norm(), 1e-12 * x.norm());
        }
        // Of the translation both; the forward tilt gets a frequency by the spin.
        EXPECT_EQ(forward, 1);
    }
}

TEST(ZeroModes, StrainNothing) {
    for (const Expected &one : undamped()) {
        const assembly::Discretization d(one.rotor, 4);
        const auto planar = assembly::assemble_planar(d, 0);
        const auto fixed = assembly::assemble_fixed(d, 0);
        for (const auto &[K, motions] : {std::pair(Eigen::MatrixXd(planar.K.view()),
                                                   zero_modes(d, Form::planar, 0, 0).motions),
                                         std::pair(Eigen::MatrixXd(fixed.K.view()),
                                                   zero_modes(d, Form::general, 0, 0).motions)})
            for (Eigen::Index i = 0; i < motions.cols(); ++i) {
                // Rounding of the largest products that cancel.
                const Eigen::VectorXd u = motions.col(i);
                const double size = (K.cwiseAbs() * u.cwiseAbs()).maxCoeff();
                EXPECT_GT(u.norm(), 0) << one.what;
                EXPECT_LE((K * u).cwiseAbs().maxCoeff(), 1e-11 * size) << one.what;
            }
    }
}

TEST(ZeroModes, TranslationStandsFirstAndTheTiltIsAboutTheCentreOfMass) {
    const model::Rotor rotor = free_rotor();
    const assembly::Discretization d(rotor, 4);
    const Eigen::MatrixXd motions = zero_modes(d, Form::planar, 0, 0).motions;
    ASSERT_EQ(motions.cols(), 2);
    const double shaft = 7800 * std::numbers::pi / 4 * 0.05 * 0.05;
    const double centre = (shaft * 0.5 + 12 * 0.3) / (shaft + 12);
    const double left = deflection(d.deflection_at(0), motions.col(0));
    EXPECT_NE(left, 0);
    EXPECT_NEAR(deflection(d.deflection_at(1), motions.col(0)) / left, 1, 1e-12);
    const double start = deflection(d.deflection_at(0), motions.col(1));
    const double end = deflection(d.deflection_at(1), motions.col(1));
    EXPECT_NEAR(-start / (end - start), centre, 1e-12); // where the line between them is zero
}

TEST(ZeroModes, TheTiltOfAPinnedRotorIsAboutItsPin) {
    model::Rotor rotor = free_rotor();
    rotor.bearings = {support(0.8, 1e6)};
    const assembly::Discretization d(rotor, 4);
    const Eigen::MatrixXd motions = zero_modes(d, Form::planar, 0, 0).motions;
    ASSERT_EQ(motions.cols(), 1);
    const double start = deflection(d.deflection_at(0), motions.col(0));
    EXPECT_NEAR(deflection(d.deflection_at(0.8), motions.col(0)) / start, 0, 1e-12);
    EXPECT_NEAR(deflection(d.deflection_at(1), motions.col(0)) / start, -0.25, 1e-12);
}

/// l (l M + D) q = 0: each free motion that D resists keeps one of its two zeros.
TEST(ZeroModes, DampersTakeOneOfTheTwoZerosEach) {
    struct Damped {
        const char *what;
        std::vector<model::Bearing> bearings;
        int motions, eigenvalues;
    };
    const double shaft = 7800 * std::numbers::pi / 4 * 0.05 * 0.05;
    const double centre = (shaft * 0.5 + 12 * 0.3) / (shaft + 12);
    for (const Damped &one :
         {Damped{"two dampers", {support(0, 0, 0, 50), support(1, 0, 0, 50)}, 4, 4},
          Damped{"one at the end: a combination", {support(0, 0, 0, 50)}, 4, 6},
          Damped{"one at the centre of mass: translation", {support(centre, 0, 0, 50)}, 4, 6},
          Damped{"beside a pin", {support(0, 1e6), support(1, 0, 0, 50)}, 2, 2},
          Damped{"in a pin, where nothing moves", {support(0, 1e6, 0, 50)}, 2, 4}}) {
        model::Rotor rotor = free_rotor();
        rotor.bearings = one.bearings;
        const assembly::Discretization d(rotor, 4);
        const ZeroModes found = zero_modes(d, Form::general, 0, 0);
        EXPECT_EQ(found.motions.cols(), one.motions) << one.what;
        EXPECT_EQ(found.eigenvalues, one.eigenvalues) << one.what;
        // At rest a damped motion creeps; a free one is half of a whirl.
        EXPECT_EQ(std::ssize(found.modes), one.eigenvalues - one.motions) << one.what;
    }
}

TEST(ZeroModes, OfOnePlaneAlone) {
    model::Rotor rotor = free_rotor();
    rotor.bearings = {support(0, 1e6), support(1, 1e6)};
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows[0].k(1, 1) = 0;
    const assembly::Discretization d(rotor, 4);
    for (const double speed : {0.0, 300.0}) {
        // Held tilts in x leave the gyroscopic moment nothing to turn: both zeros stay double.
        const ZeroModes found = zero_modes(d, Form::general, speed, speed);
        ASSERT_EQ(found.motions.cols(), 2);
        EXPECT_EQ(found.eigenvalues, 4) << speed;
        for (const double z : {0.0, 0.4, 1.0})
            for (const auto &[unknown, coefficient] : d.deflection_at(z))
                EXPECT_EQ(found.motions.row(2 * unknown).norm(), 0) << "x moves at " << z;
        EXPECT_GT(found.motions.norm(), 0);
    }
}

/// A spring along one direction, written in axes turned by any angle.
TEST(ZeroModes, ASpringThatHoldsOneDirectionLeavesTheOther) {
    for (const double angle : {0.0, 0.3, std::numbers::pi / 4, 2.0}) {
        model::Rotor rotor = free_rotor();
        const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
        rotor.bearings = {support(0, 0), support(1, 0)};
        for (model::Bearing &bearing : rotor.bearings)
            bearing.rows[0].k = 1e6 * along * along.transpose();
        const assembly::Discretization d(rotor, 4);
        const ZeroModes found = zero_modes(d, Form::general, 0, 0);
        ASSERT_EQ(found.motions.cols(), 2) << angle;
        EXPECT_EQ(found.eigenvalues, 4) << angle;
        for (Eigen::Index i = 0; i < 2; ++i)
            for (const auto &[unknown, coefficient] : d.deflection_at(0)) {
                const Eigen::Vector2d u = found.motions.block(2 * unknown, i, 2, 1);
                EXPECT_NEAR(along.dot(u), 0, 1e-12) << angle;
            }
    }
}

TEST(ZeroModes, WhirlsOfAFreeRotorAreCirclesOfBothSenses) {
    const assembly::Discretization d(free_rotor(), 4);
    for (const Form form : {Form::planar, Form::hyperbolic, Form::general}) {
        for (const double speed : {0.0, 300.0}) {
            int forward = 0;
            int backward = 0;
            for (const WhirlMode &mode : zero_modes(d, form, speed, speed).modes) {
                forward += mode.whirl == results::Whirl::forward ? 1 : 0;
                backward += mode.whirl == results::Whirl::backward ? 1 : 0;
                EXPECT_EQ(mode.eigenvalue, 0.0);
            }
            // The forward tilt is the one that spin gives a frequency.
            EXPECT_EQ(forward, speed == 0 ? 2 : 1);
            EXPECT_EQ(backward, 2);
        }
    }
}

TEST(Scales, OfTheRigidRotorOnItsSupportsAndOfTheShaft) {
    model::Rotor rotor = free_rotor();
    rotor.bearings = {support(0, 1e3), support(1, 3e3)};
    const double shaft = 7800 * std::numbers::pi / 4 * 0.05 * 0.05;
    const double I = std::numbers::pi / 64 * std::pow(0.05, 4);
    const double bending = std::pow(std::numbers::pi, 2) * std::sqrt(2e11 * I / (shaft + 12));
    EXPECT_NEAR(assembly::elastic_scale(assembly::Discretization(rotor, 4)) / bending, 1, 1e-12);
    EXPECT_NEAR(assembly::support_scale(assembly::Discretization(rotor, 4)) /
                    std::sqrt(4e3 / (shaft + 12)),
                1, 1e-12);
    rotor.bearings.clear();
    EXPECT_NEAR(assembly::support_scale(assembly::Discretization(rotor, 4)) / bending, 1, 1e-12);
    rotor.bearings = {support(0, 1e12), support(1, 1e12)}; // rigid supports say nothing
    EXPECT_NEAR(assembly::support_scale(assembly::Discretization(rotor, 4)) / bending, 1, 1e-12);
}

} // namespace whirl::modes

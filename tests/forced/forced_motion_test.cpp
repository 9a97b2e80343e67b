// Steady motion of a point mass on springs and dampers: phases, probes, weight and bearing tables
// in closed form, in every form of the equations.

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace forced_motion_test {

using namespace whirl;
using Complex = std::complex<double>;
using forced::ForcedMotion;
using forced::Phasor;
using results::Form;
using tests::RigidJeffcott;

constexpr Complex i_unit(0, 1);
constexpr double moment = 1e-3; ///< kg m
constexpr double phase = 0.7;
constexpr double gravity = 9.81;
constexpr double rounding = 1e-12; ///< of solutions of a handful of unknowns, relative

RigidJeffcott springs(double k, double c) {
    RigidJeffcott out;
    out.kx = out.ky = k;
    out.c = c;
    return out;
}

model::Rotor out_of_balance(const RigidJeffcott &jeffcott) {
    model::Rotor rotor = jeffcott.scene().rotor;
    rotor.imbalances = {tests::imbalance_at(0.5, moment, phase)};
    return rotor;
}

/// x = Re(a exp(i s t)) under mr s^2 cos(s t + phase).
Complex along(const RigidJeffcott &jeffcott, double k, double s) {
    return moment * s * s * std::polar(1.0, phase) /
           (k - jeffcott.mass * s * s + i_unit * s * jeffcott.c);
}

void expect_near(Complex found, Complex expected, const char *what, double s) {
    EXPECT_LT(std::abs(found - expected), rounding * std::abs(expected)) << what << " at " << s;
}

/// Of a mass on springs k in x and y, its rotor in this form.
void expect_motion(const model::Rotor &rotor, Form form, const RigidJeffcott &jeffcott, double s) {
    const assembly::Discretization d(rotor, 1);
    ForcedMotion motion(d, form);
    motion.solve(s);
    const Phasor found = motion.motion(d.deflection_at(0.5));
    // mr s^2 sin(s t + phase) acts in y.
    expect_near(found.x, along(jeffcott, jeffcott.kx, s), "x", s);
    expect_near(found.y, -i_unit * along(jeffcott, jeffcott.ky, s), "y", s);
}

TEST(ForcedMotionOfAPointMass, HasThePhaseOfTheImbalance) {
    const RigidJeffcott round;
    for (const double ratio : {-1.7, 0.4, 1.0, 1.7}) {
        const double s = ratio * round.natural();
        for (const Form form : {Form::planar, Form::general, Form::rotating})
            expect_motion(out_of_balance(round), form, round, s);
        RigidJeffcott unequal;
        unequal.ky = 1.6e6;
        expect_motion(out_of_balance(unequal), Form::general, unequal, s);
    }
}

/// A circle r exp(i (s t + a)) is read by a probe at the angle b as r cos(s t + a - b).
TEST(Probes, ReadACircleLaterByTheirAngle) {
    const double r = 3e-4;
    for (const double a : {0.0, 0.7, -2.0})
        for (const double b : {0.0, 0.5, 1.5707963267948966, 2.8, -1.0}) {
            const Phasor circle{std::polar(r, a), -i_unit * std::polar(r, a)};
            EXPECT_LT(std::abs(forced::reading(circle, b) - std::polar(r, a - b)), 1e-15 * r)
                << a << ' ' << b;
        }
}

/// The mass hangs mg/k below its place, whatever the axes that its equations are written in.
TEST(WeightOfAPointMass, HangsBelowInEveryForm) {
    const RigidJeffcott jeffcott;
    const model::Rotor rotor = jeffcott.scene().rotor;
    const assembly::Discretization d(rotor, 1);
    for (const Form form : {Form::general, Form::rotating})
        for (const double s : {40.0, 250.0, -410.0}) {
            ForcedMotion motion(d, form, {gravity});
            motion.solve(s);
            expect_near(motion.at_rest(d.deflection_at(0.5)),
                        -i_unit * jeffcott.mass * gravity / jeffcott.kx, "sag", s);
            EXPECT_LT(std::abs(motion.motion(d.deflection_at(0.5)).x),
                      rounding * jeffcott.mass * gravity / jeffcott.kx);
            // Either bearing is pressed down by half of the weight.
            expect_near(motion.bearing_force_at_rest(0), -i_unit * jeffcott.mass * gravity / 2.0,
                        "force", s);
        }
}

/// Between two rows stiffness and damping are those of the straight lines; none of the terms that
/// this adds to the equations may be missing, in any form.
TEST(RowsOfATable, AreJoinedByStraightLines) {
    const double from = 100;
    const double to = 500;
    const RigidJeffcott low = springs(0.7e6, 300);
    const RigidJeffcott high = springs(1.3e6, 900);
    model::Rotor rotor = out_of_balance(low);
    const model::Rotor other = out_of_balance(high);
    for (std::size_t b = 0; b < 2; ++b) {
        rotor.bearings[b].rows.push_back(other.bearings[b].rows[0]);
        rotor.bearings[b].speeds = {from, to};
    }
    for (const double s : {180.0, 320.0, 440.0}) {
        const double t = (s - from) / (to - from);
        const RigidJeffcott between = springs((0.7 + 0.6 * t) * 1e6, 300 + 600 * t);
        for (const Form form : {Form::planar, Form::general, Form::rotating})
            expect_motion(rotor, form, between, s);
        const assembly::Discretization d(rotor, 1);
        ForcedMotion weighed(d, Form::rotating, {gravity});
        weighed.solve(s);
        expect_near(weighed.at_rest(d.deflection_at(0.5)),
                    -i_unit * between.mass * gravity / between.kx, "sag", s);
    }
}

} // namespace forced_motion_test

// Response of asymmetric rotors on bearings that differ between their directions: the limits in
// which one of the two is symmetric, the equations of a rigid rotor written down in the fixed
// frame, and the ends of unstable ranges.

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "forced/periodic_motion.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/weighed_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace periodic_motion_test {

using namespace whirl;
using Complex = std::complex<double>;
using results::Form;
using tests::Random;

constexpr Complex i_unit(0, 1);

/// Differences of two responses relative to the largest amplitude at each speed.
void expect_same(const results::ResponseResult &series, const results::ResponseResult &usual) {
    ASSERT_EQ(series.nodes.size(), usual.nodes.size());
    for (std::size_t n = 0; n < usual.nodes.size(); ++n)
        for (std::size_t k = 0; k < usual.speeds.size(); ++k) {
            const results::ResponseNode &a = series.nodes[n];
            const results::ResponseNode &b = usual.nodes[n];
            if (b.amplitude[k] == 0)
                continue;
            // Beside resonances a relative 1e-12 of the stiffness weighs a thousand times more.
            const double near = 1e-9 * b.amplitude[k];
            EXPECT_NEAR(a.amplitude[k], b.amplitude[k], near);
            EXPECT_NEAR(a.minor[k], b.minor[k], near);
            EXPECT_LT(std::abs(std::polar(a.x[k], a.x_phase[k]) - std::polar(b.x[k], b.x_phase[k])),
                      near);
            EXPECT_LT(std::abs(std::polar(a.y[k], a.y_phase[k]) - std::polar(b.y[k], b.y_phase[k])),
                      near);
        }
    for (std::size_t n = 0; n < usual.bearings.size(); ++n)
        for (std::size_t k = 0; k < usual.speeds.size(); ++k)
            EXPECT_NEAR(series.bearings[n].force[k], usual.bearings[n].force[k],
                        1e-9 * usual.bearings[n].force[k]);
    for (const results::ResponseNode &node : series.nodes)
        EXPECT_TRUE(node.harmonics.empty());
    for (const results::ResponsePeak &peak : usual.peaks) {
        const auto same = std::ranges::find_if(series.peaks, [&](const auto &other) {
            return other.of == peak.of && other.place == peak.place &&
                   std::abs(other.speed / peak.speed - 1) <
                       1e-9; // misfit of slopes over the curvature
        });
        ASSERT_NE(same, series.peaks.end()) << peak.of << " " << peak.z << " " << peak.speed;
        EXPECT_EQ(std::isinf(same->value), std::isinf(peak.value));
        if (!std::isinf(peak.value)) {
            EXPECT_NEAR(same->value / peak.value, 1, 1e-8);
        }
    }
}

TEST(PeriodicResponse, AxisymmetricRotorOnUnlikeBearings) {
    Random random(41);
    for (int i = 0; i < 2; ++i) {
        model::Case scene = tests::weighed_rotor(random);
        scene.rotor.anisotropies.clear();
        scene.rotor.shaft.segments[0].asymmetry = 0;
        for (model::Bearing &bearing : scene.rotor.bearings) {
            bearing.rows[0].k(1, 1) *= random(1.1, 3);
            bearing.rows[0].c(1, 1) *= random(0.5, 2);
            bearing.pedestal.reset();
        }
        scene.rotor.imbalances = {tests::imbalance_at(0.4, 1e-3, 0.3),
                                  tests::imbalance_at(0.9, 5e-4, 2)};
        scene.speeds->from = 100;
        const auto usual = analyses::unbalance_response(scene);
        ASSERT_EQ(usual.model.formulation.form, Form::general);
        scene.formulation = model::FormChoice::hill;
        const auto series = analyses::unbalance_response(scene);
        ASSERT_EQ(series.model.formulation.form, Form::hill);
        expect_same(series, usual);
        for (std::size_t n = 0; n < usual.gravity->stations.size(); ++n)
            for (std::size_t k = 0; k < usual.speeds.size(); ++k) {
                const results::GravityStation &a = series.gravity->stations[n];
                const results::GravityStation &b = usual.gravity->stations[n];
                EXPECT_NEAR(a.sag_x[k], b.sag_x[k], 1e-9 * b.sag[k]);
                EXPECT_NEAR(a.sag_y[k], b.sag_y[k], 1e-9 * b.sag[k]);
                EXPECT_EQ(a.twice[k], 0);
            }
        EXPECT_TRUE(series.gravity->peaks.empty());
    }
}

TEST(PeriodicResponse, AsymmetricRotorOnEqualBearings) {
    Random random(42);
    for (int i = 0; i < 2; ++i) {
        model::Case scene = tests::weighed_rotor(random);
        for (model::Bearing &bearing : scene.rotor.bearings)
            bearing.pedestal.reset();
        scene.rotor.imbalances = {tests::imbalance_at(0.4, 1e-3, 0.3),
                                  tests::imbalance_at(0.9, 5e-4, 2)};
        scene.speeds->from = 100;
        const auto usual = analyses::unbalance_response(scene);
        ASSERT_EQ(usual.model.formulation.form, Form::rotating);
        scene.formulation = model::FormChoice::hill;
        const auto series = analyses::unbalance_response(scene);
        expect_same(series, usual);
        for (std::size_t n = 0; n < usual.gravity->stations.size(); ++n)
            for (std::size_t k = 0; k < usual.speeds.size(); ++k) {
                const results::GravityStation &a = series.gravity->stations[n];
                const results::GravityStation &b = usual.gravity->stations[n];
                const double near = 1e-9 * (b.sag[k] + b.twice[k]);
                EXPECT_NEAR(a.sag_x[k], b.sag_x[k], near);
                EXPECT_NEAR(a.sag_y[k], b.sag_y[k], near);
                EXPECT_NEAR(a.twice[k], b.twice[k], near);
                if (b.twice[k] > 1e-3 * b.sag[k]) {
                    EXPECT_LT(std::abs(std::polar(a.twice[k], a.phase[k]) -
                                       std::polar(b.twice[k], b.phase[k])),
                              near);
                }
            }
    }
}

/// A rigid rotor of unequal diametral inertias in the middle between two equal unlike bearings.
struct RigidRotor {
    double mass = 20, Id = 0.8, Ip = 0.5, dI = 0.08, direction = 0.3;
    double kx = 4e5, ky = 6e5, cx = 40, cy = 90, kxy = 3e4;
    double mr = 1e-3, place = 0.3, phase = 0.7;

    [[nodiscard]] model::Case scene() const {
        model::Case out;
        out.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
        out.rotor.shaft.rigid = true;
        out.rotor.discs = {tests::disc_at(0.5, mass, Id, Ip)};
        out.rotor.anisotropies = {{"", 0.5, dI, direction}};
        for (const double z : {0.0, 1.0}) {
            model::Bearing bearing = tests::isotropic_bearing(z, kx, cx);
            bearing.rows[0].k << kx, kxy, kxy, ky;
            bearing.rows[0].c << cx, 0, 0, cy;
            out.rotor.bearings.push_back(bearing);
        }
        out.rotor.imbalances = {tests::imbalance_at(place, mr, phase)};
        out.speeds = model::SpeedRange{200, 1400, 13};
        return out;
    }
};

/// x + i y of a motion and its first two derivatives at an angle of the rotor.
std::array<Complex, 3> derivatives(const forced::TurnParts &parts, double speed, double angle) {
    std::array<Complex, 3> out{};
    int multiple = parts.first;
    for (const forced::Phasor &part : parts.parts) {
        Complex factor = std::polar(1.0, multiple * angle);
        for (Complex &sum : out) {
            sum += Complex((part.x * factor).real(), (part.y * factor).real());
            factor *= i_unit * (multiple * speed);
        }
        multiple += 2;
    }
    return out;
}

/// In the fixed frame, w of the middle, b = dw/dz, halves of the distance of the bearings h = 1/2:
/// m w'' + 2 F(w) = m r W^2 exp(i (W t + phase)),
/// Id b'' + dI d/dt[exp(2 i (W t + direction)) conj(b')] - i W Ip b' + 2 h^2 F(b) =
/// m r W^2 (place - h) exp(i (W t + phase)), F the force of a bearing: dI acts on the rate of the
/// slope as seen by the rotor's principal axes.
TEST(PeriodicResponse, EquationsOfARigidRotorInTheFixedFrame) {
    const RigidRotor rotor;
    const model::Case scene = rotor.scene();
    const assembly::Discretization d(scene.rotor, 1);
    forced::PeriodicMotion motion(d);
    for (const double W : {220.0, 400.0, 500.0, 760.0, 900.0, 1300.0}) {
        ASSERT_TRUE(motion.solve(W));
        const forced::TurnParts left = motion.motion(d.deflection_at(0));
        const forced::TurnParts right = motion.motion(d.deflection_at(1));
        EXPECT_GT(std::abs(left.part(3).x), 1e-6 * std::abs(left.part(1).x)) << W;
        for (const double angle : {0.1, 0.9, 2.0, 3.7, 5.5}) {
            const auto a = derivatives(left, W, angle);
            const auto b = derivatives(right, W, angle);
            const auto middle = [&](int k) { return (a[k] + b[k]) / 2.0; };
            const auto slope = [&](int k) { return b[k] - a[k]; };
            const auto force = [&](const Complex &u, const Complex &v) {
                return Complex(rotor.kx * u.real() + rotor.kxy * u.imag() + rotor.cx * v.real(),
                               rotor.kxy * u.real() + rotor.ky * u.imag() + rotor.cy * v.imag());
            };
            const Complex load = rotor.mr * W * W * std::polar(1.0, angle + rotor.phase);
            const Complex pull = 2.0 * force(middle(0), middle(1));
            EXPECT_LT(std::abs(rotor.mass * middle(2) + pull - load), 1e-10 * std::abs(load));
            const Complex turn = std::polar(1.0, 2 * (angle + rotor.direction));
            const Complex unequal =
                rotor.dI * turn * (std::conj(slope(2)) + 2.0 * i_unit * W * std::conj(slope(1)));
            const Complex moment = rotor.Id * slope(2) + unequal -
                                   i_unit * W * rotor.Ip * slope(1) +
                                   0.5 * force(slope(0), slope(1)) - load * (rotor.place - 0.5);
            // Of the terms that it is the sum of.
            EXPECT_LT(std::abs(moment), 1e-10 * rotor.Id * std::abs(slope(2))) << W << " " << angle;
            const auto at_left = derivatives(motion.bearing_force(0), W, angle);
            const auto at_right = derivatives(motion.bearing_force(1), W, angle);
            EXPECT_LT(std::abs(at_left[0] + at_right[0] - pull), 1e-10 * std::abs(pull));
        }
    }
}

TEST(PeriodicResponse, WithoutLimitAtTheEndsOfUnstableRanges) {
    const RigidRotor rotor;
    const model::Case scene = rotor.scene();
    const auto response = analyses::unbalance_response(scene);
    const auto stability = analyses::stability(scene, {});
    int ends = 0;
    for (const results::Interval &range : stability.unstable)
        for (const double end : {range.from, range.to}) {
            if (end <= scene.speeds->from || end >= scene.speeds->to)
                continue;
            ++ends;
            EXPECT_TRUE(std::ranges::any_of(response.peaks, [&](const auto &peak) {
                return std::isinf(peak.value) && std::abs(peak.speed / end - 1) < 1e-8;
            })) << end;
        }
    EXPECT_GE(ends, 2);
    // And nowhere else.
    for (const results::ResponsePeak &peak : response.peaks)
        if (std::isinf(peak.value)) {
            EXPECT_TRUE(std::ranges::any_of(stability.unstable, [&](const auto &range) {
                return std::abs(range.from / peak.speed - 1) < 1e-8 ||
                       std::abs(range.to / peak.speed - 1) < 1e-8;
            })) << peak.speed;
        }
}

TEST(PeriodicCriticalSpeeds, AreThoseOfTheSymmetricLimits) {
    RigidRotor rotor;
    rotor.cx = rotor.cy = rotor.kxy = 0;
    rotor.dI = 0;
    model::Case scene = rotor.scene();
    scene.rotor.anisotropies.clear();
    const auto usual = analyses::critical_speeds(scene);
    scene.formulation = model::FormChoice::hill;
    const auto series = analyses::critical_speeds(scene);
    for (const results::CriticalSpeed &critical : usual.critical_speeds) {
        if (critical.speed < scene.speeds->from || critical.speed > scene.speeds->to)
            continue;
        EXPECT_TRUE(std::ranges::any_of(series.critical_speeds, [&](const auto &other) {
            return std::abs(other.speed / critical.speed - 1) < 1e-9;
        })) << critical.speed;
    }
    for (const results::CriticalSpeed &critical : series.critical_speeds)
        EXPECT_TRUE(std::ranges::any_of(usual.critical_speeds, [&](const auto &other) {
            return std::abs(other.speed / critical.speed - 1) < 1e-9;
        })) << critical.speed;
}

} // namespace periodic_motion_test

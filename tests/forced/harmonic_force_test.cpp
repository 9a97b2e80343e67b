// Harmonic forces of any frequency and receptances: closed forms of a point mass and of a pinned
// Timoshenko shaft that turns, an independent dense model, reciprocity, superposition.

#include "analyses/response.h"
#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/swept_motion.h"
#include "model/errors.h"
#include "oracles/dense_rotor.h"
#include "results/response.h"
#include "support/rigid_jeffcott.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace harmonic_force_test {

using namespace whirl;
using Complex = std::complex<double>;
using forced::Drive;
using forced::ForcedMotion;
using forced::Phasor;
using forced::Push;
using model::ForceDirection;
using results::Form;

constexpr Complex i_unit(0, 1);

/// Forward and backward: y a quarter turn behind and before x.
const Phasor forward{std::polar(70.0, 0.4), -i_unit *std::polar(70.0, 0.4)};
const Phasor backward{std::polar(70.0, 0.4), i_unit *std::polar(70.0, 0.4)};

/// A point mass on bearings that couple x and y, (K + i w C - w^2 m) u = f, whatever the spin.
struct CoupledMass {
    Eigen::Matrix2d k{{0.6e6, 2e5}, {-1.5e5, 0.9e6}};
    Eigen::Matrix2d c{{300, 40}, {-20, 500}};
    double mass = 10;

    [[nodiscard]] model::Rotor rotor() const {
        model::Rotor out = tests::RigidJeffcott().scene().rotor;
        for (model::Bearing &bearing : out.bearings) {
            bearing.rows[0].k = k / 2;
            bearing.rows[0].c = c / 2;
        }
        return out;
    }
    [[nodiscard]] Eigen::Vector2cd motion(double w, const Phasor &force) const {
        const Eigen::Matrix2cd Z = k.cast<Complex>() + i_unit * w * c.cast<Complex>() -
                                   w * w * mass * Eigen::Matrix2cd::Identity();
        return Z.inverse() * Eigen::Vector2cd(force.x, force.y);
    }
};

TEST(HarmonicForceOnAPointMass, MovesItAtAnyFrequency) {
    const CoupledMass coupled;
    const model::Rotor rotor = coupled.rotor();
    const assembly::Discretization d(rotor, 1);
    for (const Phasor &force : {Phasor{80, 0}, Phasor{0, Complex(3, -50)}, forward, backward})
        for (const forced::Sweep &sweep :
             {forced::Sweep{0, 1, 0, 1}, forced::Sweep{0, 1, 0, 2}, forced::Sweep{0, 1, 0, 0.5},
              forced::Sweep{0, 1, 310, 0}, forced::Sweep{400, 0, 0, 1}}) {
            Drive drive;
            drive.forces = {{0.5, force}};
            drive.sweep = sweep;
            ForcedMotion motion(d, Form::general, drive);
            for (const double s : {-250.0, 60.0, 290.0, 700.0}) {
                motion.solve(s);
                const double w = sweep.frequency_at(s);
                const Eigen::Vector2cd exact = coupled.motion(w, force);
                const Phasor found = motion.at(0.5);
                const double size = exact.norm();
                EXPECT_LT(std::abs(found.x - exact(0)), 1e-12 * size) << s;
                EXPECT_LT(std::abs(found.y - exact(1)), 1e-12 * size) << s;
                // Either bearing has half of the stiffness and of the damping.
                const Eigen::Vector2cd carried =
                    (coupled.k.cast<Complex>() + i_unit * w * coupled.c.cast<Complex>()) * exact /
                    2.0;
                const Phasor pressed = motion.bearing_force(0);
                EXPECT_LT(std::abs(pressed.x - carried(0)), 1e-12 * carried.norm()) << s;
                EXPECT_LT(std::abs(pressed.y - carried(1)), 1e-12 * carried.norm()) << s;
            }
        }
}

/// Coefficients of a bearing that couple x and y and bend over the spin speed.
model::BearingCoefficients along_a_curve(double speed) {
    model::BearingCoefficients out;
    out.k << 4e6 * (1 + std::pow(speed / 600, 2)), 2e5 * std::sin(speed / 200), -3e5,
        6e6 + 2e3 * speed;
    out.c << 900 * std::exp(-speed / 700), 0, 0, 450;
    return out;
}

/// Two discs on a shaft of steel, bearings along curves over the spin speed.
model::Rotor curved_rotor() {
    model::Rotor out;
    out.shaft = tests::uniform_shaft(1.2, 0.05, tests::steel());
    out.shaft.segments[0].elements = 4;
    out.shaft.internal_damping = 1e-5;
    out.discs = {tests::disc_at(0.4, 15, 0.1, 0.18), tests::disc_at(0.9, 25, 0.2, 0.35)};
    out.imbalances = {tests::imbalance_at(0.9, 1e-4, 1)};
    out.forces = {{"", 0.7, 0, 0, 1.0, {}, model::ForceDirection::x}}; // a node
    for (const double z : {0.0, 1.2}) {
        model::Bearing bearing;
        bearing.z = z;
        for (int row = 0; row <= 180; ++row) {
            bearing.speeds.push_back(5.0 * row);
            bearing.rows.push_back(along_a_curve(5.0 * row));
        }
        out.bearings.push_back(bearing);
    }
    return out;
}

/// The motion with the tables as they are from those with their means, for each sweep.
TEST(HarmonicForces, MoveARotorOnTablesAsItsEquationsSay) {
    const model::Rotor rotor = curved_rotor();
    const assembly::Discretization d(rotor, 3);
    const std::vector<forced::Quantity> quantities{{d.deflection_at(0.4)},
                                                   {forced::stretch_of_bearing(d, 1), 1}};
    for (const forced::Sweep &sweep : {forced::Sweep{0, 1, 0, 2}, forced::Sweep{0, 1, 310, 0},
                                       forced::Sweep{450, 0, 0, 1}, forced::Sweep{0, 1, 0, 1}}) {
        Drive drive;
        drive.forces = {{0.4, forward}, {0.7, {20, 0}}};
        drive.sweep = sweep;
        drive.unbalanced = sweep.frequency_rate == 1 && sweep.spin_rate == 1;
        forced::SweptMotion motion(d, Form::general, quantities, drive, 10, 900);
        ForcedMotion whole(d, Form::general, drive);
        for (const double s : {33.0, 207.5, 411.0, 633.3, 878.0}) {
            const auto found = motion.at(s);
            ASSERT_TRUE(found);
            whole.solve(s);
            for (Eigen::Index q = 0; q < 2; ++q) {
                const Phasor expected = q == 0 ? whole.at(0.4) : whole.bearing_force(1);
                const double size = std::hypot(std::abs(expected.x), std::abs(expected.y));
                // The motions that they are made of are fitted to 1e-11.
                EXPECT_LE(std::abs(found->numbers(q, 0) - expected.x), 1e-10 * size) << s;
                EXPECT_LE(std::abs(found->numbers(q, 1) - expected.y), 1e-10 * size) << s;
            }
        }
    }
}

/// Classical elements by another code, LU of all of it: discs, gyroscopic terms, internal damping,
/// bearings that couple, at spin speeds and frequencies that have nothing to do with each other.
TEST(HarmonicForces, MoveARotorAsADenseModelSays) {
    oracles::CaseRotor other;
    oracles::Segment segment;
    segment.left = {1.2, 0.06, 0, 2.1e11, 8e10, 7800};
    segment.outer_end = 0.06;
    segment.elements = 6;
    other.shaft = {segment};
    other.internal_damping = 2e-5;
    other.discs = {{0.4, 15, 0.1, 0.18}, {1.0, 20, 0.2, 0.3}};
    for (const double z : {0.0, 1.2}) {
        oracles::Support support;
        support.z = z;
        support.k = {{{5e6, 4e5}, {-3e5, 8e6}}};
        support.c = {{{900, 0}, {0, 1500}}};
        other.supports.push_back(support);
    }
    const oracles::DenseRotor dense = oracles::dense_rotor(other);

    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1.2, 0.06, {"steel", 2.1e11, 8e10, 7800});
    rotor.shaft.segments[0].elements = 6;
    rotor.shaft.internal_damping = other.internal_damping;
    rotor.discs = {tests::disc_at(0.4, 15, 0.1, 0.18), tests::disc_at(1.0, 20, 0.2, 0.3)};
    for (const oracles::Support &support : other.supports) {
        model::Bearing bearing = tests::isotropic_bearing(support.z, 0);
        bearing.rows[0].k << support.k[0][0], support.k[0][1], support.k[1][0], support.k[1][1];
        bearing.rows[0].c << support.c[0][0], 0, 0, support.c[1][1];
        rotor.bearings.push_back(bearing);
    }
    const assembly::Discretization d(rotor, 1);
    const Eigen::Index n = dense.planar();
    for (const auto &[spin, w] : {std::pair(0.0, 240.0), std::pair(600.0, 240.0),
                                  std::pair(-350.0, 900.0), std::pair(1200.0, 1200.0)}) {
        Drive drive;
        drive.forces = {{0.4, forward}, {0.8, {Complex(0, 30), 10}}};
        drive.sweep = {spin, 0, 0, 1};
        ForcedMotion motion(d, Form::general, drive);
        motion.solve(w);
        Eigen::VectorXcd load = Eigen::VectorXcd::Zero(2 * n);
        for (const Push &push : drive.forces) {
            load(dense.deflection(push.z)) += push.force.x;
            load(n + dense.deflection(push.z)) += push.force.y;
        }
        const Eigen::MatrixXcd Z = (dense.K + spin * dense.Kc - w * w * dense.M).cast<Complex>() +
                                   i_unit * w * (dense.C + spin * dense.G).cast<Complex>();
        const Eigen::VectorXcd u = Z.partialPivLu().solve(load);
        for (const double z : {0.0, 0.4, 0.6, 1.2}) {
            const Complex x = u(dense.deflection(z));
            const Complex y = u(n + dense.deflection(z));
            const Phasor found = motion.at(z);
            const double size = std::hypot(std::abs(x), std::abs(y));
            // Both lose some 1e-11 by rounding of elements that are far stiffer than the rotor.
            EXPECT_LT(std::abs(found.x - x), 1e-9 * size) << spin << ' ' << w;
            EXPECT_LT(std::abs(found.y - y), 1e-9 * size) << spin << ' ' << w;
        }
    }
}

// --- what the command answers ---

model::HarmonicForce force_at(double z, double amplitude, ForceDirection direction) {
    model::HarmonicForce out;
    out.z = z;
    out.amplitude = amplitude;
    out.phase = 0.4;
    out.direction = direction;
    return out;
}

const results::ResponseNode &node_at(const results::HarmonicMotion &motion, double z) {
    return *std::ranges::find_if(motion.nodes,
                                 [z](const auto &node) { return std::abs(node.z - z) < 1e-12; });
}

TEST(ForcesOfACase, EachFrequencyHasAMotionOfItsOwn) {
    const CoupledMass coupled;
    model::Case scene;
    scene.rotor = coupled.rotor();
    model::HarmonicForce twice = force_at(0.5, 70, ForceDirection::forward);
    twice.multiple = 2;
    model::HarmonicForce against = force_at(0.5, 70, ForceDirection::backward);
    against.multiple = 2;
    model::HarmonicForce shaker = force_at(0.5, 30, ForceDirection::y);
    shaker.frequency = 310;
    scene.rotor.forces = {twice, shaker, against}; // two frequencies
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3)};
    scene.speeds = model::SpeedRange{0, 400, 5};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    ASSERT_EQ(result.forces.size(), 2U);
    EXPECT_EQ(result.forces[0].forces.size(), 2U);
    EXPECT_EQ(result.forces[0].multiple, 2.0);
    EXPECT_EQ(result.forces[1].frequency, 310.0);
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double s = result.speeds[i];
        const Phasor both{forward.x + backward.x, 0}; // their parts along y cancel
        const Eigen::Vector2cd at_twice = coupled.motion(2 * s, both);
        const Eigen::Vector2cd shaken = coupled.motion(310, {0, std::polar(30.0, 0.4)});
        const Eigen::Vector2cd turned = coupled.motion(s, {1e-3 * s * s, -i_unit * 1e-3 * s * s});
        const auto check = [&](const results::HarmonicMotion &motion,
                               const Eigen::Vector2cd &exact) {
            const results::ResponseNode &node = node_at(motion, 0.5);
            EXPECT_NEAR(node.x[i], std::abs(exact(0)), 1e-12 * exact.norm());
            EXPECT_NEAR(node.y[i], std::abs(exact(1)), 1e-12 * exact.norm());
            if (exact.norm() > 0) {
                EXPECT_NEAR(
                    std::remainder(node.x_phase[i] - std::arg(exact(0)), 2 * std::numbers::pi), 0,
                    1e-11);
            }
        };
        check(result.forces[0], at_twice);
        check(result.forces[1], shaken);
        check(result, turned);
    }
}

/// What has the frequency of the imbalances moves the rotor together with them, whatever the order
/// of the case, and is looked for peaks of together; without an imbalance it is a force like
/// others.
TEST(ForcesOfACase, AtTheSpinSpeedJoinTheImbalances) {
    const CoupledMass coupled;
    model::Case scene;
    scene.rotor = coupled.rotor();
    model::HarmonicForce once = force_at(0.5, 70, ForceDirection::backward);
    once.multiple = 1;
    scene.rotor.forces = {once};
    scene.speeds = model::SpeedRange{0, 400, 5};
    const results::ResponseResult alone = analyses::unbalance_response(scene);
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-3, 1.1)};
    const results::ResponseResult both = analyses::unbalance_response(scene);
    ASSERT_EQ(alone.forces.size(), 1U);
    EXPECT_TRUE(alone.nodes.empty());
    EXPECT_TRUE(both.forces.empty());
    const auto exact = [&coupled](double s, bool unbalanced) {
        const Complex push = (unbalanced ? 1e-3 * s * s : 0) * std::polar(1.0, 1.1);
        return coupled.motion(s, {backward.x + push, backward.y - i_unit * push});
    };
    for (std::size_t i = 0; i < both.speeds.size(); ++i)
        for (const bool unbalanced : {false, true}) {
            const results::ResponseNode &node =
                unbalanced ? node_at(both, 0.5) : node_at(alone.forces[0], 0.5);
            const Eigen::Vector2cd u = exact(both.speeds[i], unbalanced);
            EXPECT_NEAR(node.x[i], std::abs(u(0)), 1e-12 * u.norm());
            EXPECT_NEAR(node.y[i], std::abs(u(1)), 1e-12 * u.norm());
        }
    const auto major = [&exact](double s) {
        const Eigen::Vector2cd u = exact(s, true);
        return (std::abs(u(0) + i_unit * u(1)) + std::abs(u(0) - i_unit * u(1))) / 2;
    };
    int peaks = 0;
    for (const results::ResponsePeak &peak : both.peaks)
        if (peak.of == "station" && peak.z == 0.5) {
            ++peaks;
            EXPECT_NEAR(peak.value / major(peak.speed), 1, 1e-9);
            for (const double beside : {1 - 1e-4, 1 + 1e-4})
                EXPECT_LT(major(peak.speed * beside), peak.value);
        }
    EXPECT_GT(peaks, 0);
}

/// x over a force along x, one degree of freedom of damping ratio D: largest where the frequency is
/// sqrt(1 - 2 D^2) of the natural one, 1/(2 D sqrt(1 - D^2)) of the static deflection.
TEST(Receptance, OfAPointMassHasItsPeak) {
    const tests::RigidJeffcott jeffcott;
    model::Case scene = jeffcott.scene();
    scene.speeds = model::SpeedRange{700, 700, 1};
    scene.response.receptances = {{0.5, 0.5}};
    scene.response.frequencies = {0, 900, 10};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    ASSERT_TRUE(result.receptance);
    EXPECT_EQ(result.receptance->speed, 700);
    const double D = jeffcott.ratio();
    std::size_t peaks = 0;
    for (const results::ReceptancePeak &peak : result.receptance->peaks) {
        EXPECT_TRUE(peak.direction == "xx" || peak.direction == "yy") << "nothing couples them";
        EXPECT_NEAR(peak.frequency / (jeffcott.natural() * std::sqrt(1 - 2 * D * D)), 1, 1e-9);
        EXPECT_NEAR(peak.value * jeffcott.kx * 2 * D * std::sqrt(1 - D * D), 1, 1e-10);
        ++peaks;
    }
    EXPECT_EQ(peaks, 2U);
    for (std::size_t i = 0; i < result.receptance->frequencies.size(); ++i) {
        const double w = result.receptance->frequencies[i];
        const Complex exact = 1.0 / (jeffcott.kx - jeffcott.mass * w * w + i_unit * w * jeffcott.c);
        const results::ReceptanceDirection &xx = result.receptance->receptances[0].directions[0];
        EXPECT_NEAR(xx.amplitude[i], std::abs(exact), 1e-12 * std::abs(exact));
        EXPECT_NEAR(std::remainder(xx.phase[i] - std::arg(exact), 2 * std::numbers::pi), 0, 1e-11);
        EXPECT_EQ(result.receptance->receptances[0].directions[1].amplitude[i], 0) << "xy";
    }
}

/// A uniform Timoshenko shaft on knife edges, turning: in w and phi ~ sin, cos (n pi z / L) the
/// equations of each n are two, and the deflection at z under a unit force at a that turns with w
/// is
///     H(w) = sum 2/L sin(n pi z/L) sin(n pi a/L) h_n(w),
/// h_n the first entry of the inverse of [GA k^2 - rho A w^2, -GA k; -GA k, EI k^2 + GA - rho I w^2
/// + 2 rho I Omega w], k = n pi/L, GA with the shear coefficient. Of each h_n its limit 1/(GA k^2)
/// is summed in closed form: z (L - a)/(GA L) for z < a.
struct PinnedShaft {
    double L = 1.5, diameter = 0.12, E = 2.1e11, G = 8e10, rho = 7800, kappa = 0.88;

    [[nodiscard]] double turning(double w, double spin, double a, double z) const {
        const double A = std::numbers::pi * diameter * diameter / 4;
        const double I = A * diameter * diameter / 16;
        const double GA = kappa * G * A;
        double sum = std::min(a, z) * (L - std::max(a, z)) / (GA * L);
        for (int n = 4000; n > 0; --n) { // what is left falls as n^-4: 1e-11 of it
            const double k = n * std::numbers::pi / L;
            const double first = GA * k * k - rho * A * w * w;
            const double second = E * I * k * k + GA - rho * I * w * w + 2 * rho * I * spin * w;
            const double h = second / (first * second - GA * k * GA * k);
            sum += 2 / L * std::sin(k * z) * std::sin(k * a) * (h - 1 / (GA * k * k));
        }
        return sum;
    }
    [[nodiscard]] model::Case scene() const {
        model::Case out;
        out.rotor.shaft = tests::uniform_shaft(L, diameter, {"steel", E, G, rho});
        out.rotor.shaft.order = 9;
        out.rotor.shaft.segments[0].elements = 4;
        out.rotor.shaft.shear = model::ShearFormula::given;
        out.rotor.shaft.shear_coefficient = kappa;
        // What they give falls with their stiffness: of k = 1e14 N/m it is up to 8e-6 of a
        // deflection next to a resonance, of these 8e-8.
        for (const double z : {0.0, L})
            out.rotor.bearings.push_back(tests::isotropic_bearing(z, 1e16));
        return out;
    }
};

TEST(Receptance, OfATurningTimoshenkoShaftIsTheSeries) {
    const PinnedShaft shaft;
    model::Case scene = shaft.scene();
    const double spin = 2500;
    const double a = 0.4;
    const double z = 1.1;
    scene.speeds = model::SpeedRange{spin, spin, 1};
    scene.response.receptances = {{a, z}, {z, a}};
    scene.response.frequencies = {0, 3000, 7};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    ASSERT_TRUE(result.receptance);
    for (std::size_t i = 0; i < result.receptance->frequencies.size(); ++i) {
        const double w = result.receptance->frequencies[i];
        const double with = shaft.turning(w, spin, a, z);
        const double against = shaft.turning(-w, spin, a, z);
        // x = Re(u exp(i w t)) under cos(w t): w = (H(w) exp(i w t) + H(-w) exp(-i w t))/2.
        const double xx = (with + against) / 2;
        const Complex yx = (with - against) / (2.0 * i_unit);
        for (const results::Receptance &one : result.receptance->receptances) {
            const auto value = [&one, i](std::size_t direction) {
                const results::ReceptanceDirection &of = one.directions[direction];
                return of.amplitude[i] > 0 ? std::polar(of.amplitude[i], of.phase[i]) : Complex(0);
            };
            const double size = std::hypot(xx, std::abs(yx));
            EXPECT_LT(std::abs(value(0) - xx), 2e-7 * size) << w;
            EXPECT_LT(std::abs(value(3) - xx), 2e-7 * size) << w;
            EXPECT_LT(std::abs(value(2) - yx), 2e-7 * size) << w;
            EXPECT_LT(std::abs(value(1) + yx), 2e-7 * size) << w; // x under a force along y
        }
    }
}

/// At rest force and deflection may change places (Maxwell), of a rotor without cross coupling that
/// is not symmetric; when it turns its gyroscopic moments change their sign with that.
TEST(Receptance, IsReciprocal) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.05, tests::steel());
    scene.rotor.shaft.segments[0].elements = 3;
    scene.rotor.discs = {tests::disc_at(0.3, 15, 0.1, 0.18), tests::disc_at(0.9, 25, 0.2, 0.35)};
    for (const double z : {0.0, 1.0}) {
        model::Bearing bearing = tests::isotropic_bearing(z, 5e6, 900);
        bearing.rows[0].k << 5e6, 8e5, 8e5, 9e6;
        scene.rotor.bearings.push_back(bearing);
    }
    scene.response.receptances = {{0.2, 1.2}, {1.2, 0.2}};
    scene.response.frequencies = {0, 900, 10};
    const auto receptances = [&scene](double spin) {
        scene.speeds = model::SpeedRange{spin, spin, 1};
        return analyses::unbalance_response(scene).receptance->receptances;
    };
    const std::vector<results::Receptance> rest = receptances(0);
    const std::vector<results::Receptance> with = receptances(800);
    const std::vector<results::Receptance> against = receptances(-800);
    constexpr std::array transposed{0U, 2U, 1U, 3U}; // xx, xy, yx, yy
    double turned = 0;
    for (std::size_t i = 0; i < 10; ++i)
        for (std::size_t direction = 0; direction < 4; ++direction) {
            const auto value = [i](const results::Receptance &one, std::size_t of) {
                return std::polar(one.directions[of].amplitude[i], one.directions[of].phase[i]);
            };
            const Complex there = value(rest[0], direction);
            EXPECT_LT(std::abs(there - value(rest[1], transposed[direction])),
                      1e-10 * std::abs(there));
            const Complex forth = value(with[0], direction);
            EXPECT_LT(std::abs(forth - value(against[1], transposed[direction])),
                      1e-10 * std::abs(forth));
            turned = std::max(turned, std::abs(forth - value(with[1], transposed[direction])) /
                                          std::abs(forth));
        }
    EXPECT_GT(turned, 0.01) << "of a rotor that turns they may not";
}

/// Of the whole rotor, each in its own direction; of one whose bearings couple x and y unequally.
TEST(Receptance, PeaksAreValuesOfTheirDirections) {
    model::Case scene;
    scene.rotor = curved_rotor();
    scene.rotor.forces.clear();
    scene.rotor.stations = {{0.2}, {1.0}};
    scene.speeds = model::SpeedRange{430, 430, 1};
    scene.response.receptances = {{0.2, 1.0}, {1.0, 1.0}};
    scene.response.frequencies = {10, 1500, 5};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
    std::map<std::string, int> counts;
    for (const results::ReceptancePeak &peak : result.receptance->peaks) {
        Drive drive;
        drive.forces = {{peak.from, peak.direction[1] == 'x' ? Phasor{1, 0} : Phasor{0, 1}}};
        drive.sweep = {430, 0, 0, 1};
        ForcedMotion motion(d, Form::general, drive);
        const auto value = [&](double frequency) {
            motion.solve(frequency);
            const Phasor u = motion.at(peak.to);
            return std::abs(peak.direction[0] == 'x' ? u.x : u.y);
        };
        EXPECT_NEAR(peak.value / value(peak.frequency), 1, 1e-8) << peak.direction;
        for (const double beside : {1 - 1e-4, 1 + 1e-4})
            EXPECT_LT(value(peak.frequency * beside), peak.value) << peak.direction;
        ++counts[peak.direction];
    }
    for (const char *direction : {"xx", "xy", "yx", "yy"})
        EXPECT_GE(counts[direction], 2) << direction;
}

/// Errors are those of the elements: estimated on two coarse ones, true against fine ones.
TEST(ForcesOfACase, ErrorsHold) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.05, tests::steel());
    scene.rotor.shaft.segments[0].elements = 2;
    scene.rotor.discs = {tests::disc_at(0.3, 15, 0.1, 0.18)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 5e6, 900),
                            tests::isotropic_bearing(1.2, 8e6, 900)};
    model::HarmonicForce force = force_at(0.8, 10, ForceDirection::x);
    force.multiple = 3;
    scene.rotor.forces = {force};
    scene.response.receptances = {{0.8, 0.3}};
    scene.response.frequencies = {10, 1500, 12};
    scene.speeds = model::SpeedRange{10, 500, 12};
    scene.rotor.shaft.order = 2;
    const results::ResponseResult coarse = analyses::unbalance_response(scene);
    scene.rotor.shaft.order = 12;
    const results::ResponseResult fine = analyses::unbalance_response(scene);
    const results::ResponseNode &a = node_at(coarse.forces[0], 0.3);
    const results::ResponseNode &b = node_at(fine.forces[0], 0.3);
    for (std::size_t i = 0; i < a.amplitude.size(); ++i)
        EXPECT_LE(std::abs(a.amplitude[i] - b.amplitude[i]), 1.05 * a.error[i] * b.amplitude[i]);
    for (std::size_t i = 0; i < 12; ++i) {
        const auto &xx = coarse.receptance->receptances[0].directions[0];
        const auto &truth = fine.receptance->receptances[0].directions[0];
        EXPECT_LE(std::abs(std::polar(xx.amplitude[i], xx.phase[i]) -
                           std::polar(truth.amplitude[i], truth.phase[i])),
                  1.05 * xx.error[i] * std::max(xx.amplitude[i], truth.amplitude[i]));
    }
    ASSERT_FALSE(coarse.forces[0].peaks.empty());
    ASSERT_EQ(coarse.forces[0].peaks.size(), fine.forces[0].peaks.size());
    for (std::size_t i = 0; i < coarse.forces[0].peaks.size(); ++i) {
        const results::ResponsePeak &peak = coarse.forces[0].peaks[i];
        const double truth = fine.forces[0].peaks[i].value;
        EXPECT_LE(std::abs(peak.value - truth), 1.05 * peak.error * truth);
        EXPECT_LE(peak.error, 100 * std::abs(peak.value - truth) / truth + 1e-9) << "too careful";
    }
}

/// A rotor that nothing holds has no motion under a force at rest, where its frequency is 0, nor a
/// receptance there; moving it is that of its mass.
TEST(ForcesOfACase, OnAFreeRotorHaveNoMotionAtRest) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
    const double mass = 7800 * std::numbers::pi * 0.05 * 0.05 / 4;
    model::HarmonicForce force = force_at(0.5, 10, ForceDirection::x);
    force.multiple = 2;
    scene.rotor.forces = {force};
    scene.response.receptances = {{0.5, 0.5}};
    scene.response.frequencies = {0, 2, 2};
    scene.speeds = model::SpeedRange{0, 1, 2};
    const results::ResponseResult result = analyses::unbalance_response(scene);
    const results::ResponseNode &middle = node_at(result.forces[0], 0.5);
    EXPECT_TRUE(std::isinf(middle.amplitude[0]));
    // Bending adds 1e-5 of it at these frequencies.
    EXPECT_NEAR(middle.amplitude[1] * mass * 4 / 10, 1, 1e-4);
    const auto &receptance = result.receptance->receptances[0].directions[0];
    EXPECT_TRUE(std::isinf(receptance.amplitude[0]));
    EXPECT_NEAR(receptance.amplitude[1] * mass * 4, 1, 1e-4);
}

/// On bearings that are the same from every direction a force that turns forward meets forward
/// whirl alone, one that turns backward backward whirl: at a frequency of its own that the spin
/// speed is half of.
TEST(ForcesOfACase, PeaksHaveTheNamesOfTheModesTheyMeet) {
    for (const ForceDirection direction : {ForceDirection::forward, ForceDirection::backward}) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(1.2, 0.05, tests::steel());
        scene.rotor.shaft.segments[0].elements = 3;
        scene.rotor.discs = {tests::disc_at(0.3, 15, 0.1, 0.18)};
        scene.rotor.bearings = {tests::isotropic_bearing(0, 5e6, 200),
                                tests::isotropic_bearing(1.2, 8e6, 200)};
        model::HarmonicForce force = force_at(0.3, 10, direction);
        force.multiple = 2;
        scene.rotor.forces = {force};
        scene.speeds = model::SpeedRange{10, 700, 3};
        const results::ResponseResult result = analyses::unbalance_response(scene);
        std::vector<std::string> names;
        for (const results::ResponsePeak &peak : result.forces[0].peaks)
            if (peak.of == "station" && peak.z == 0.3)
                names.push_back(peak.mode);
        ASSERT_GE(names.size(), 2U);
        EXPECT_EQ(names[0], direction == ForceDirection::forward ? "1F" : "1B");
        EXPECT_EQ(names[1], direction == ForceDirection::forward ? "2F" : "2B");
    }
}

TEST(ForcesOfACase, AreRefusedOnARotorThatIsNotTheSameFromEveryDirection) {
    model::Case scene = tests::RigidJeffcott().scene();
    scene.rotor.anisotropies = {{"", 0.5, 0.01, 0}};
    scene.speeds = model::SpeedRange{0, 400, 5};
    model::HarmonicForce force = force_at(0.5, 10, ForceDirection::x);
    force.frequency = 100;
    scene.rotor.forces = {force};
    EXPECT_THROW((void)analyses::unbalance_response(scene), model::BadInput);
    scene.rotor.forces.clear();
    scene.response.receptances = {{0.5, 0.5}};
    scene.response.frequencies = {0, 100, 3};
    EXPECT_THROW((void)analyses::unbalance_response(scene), model::BadInput);
}

} // namespace harmonic_force_test

// Motion under the weight: closed form of a disc on an asymmetric shaft, harmonic balance in the
// fixed frame, rotors that are axisymmetric, peaks looked for speed by speed.

#include "analyses/response.h"
#include "assembly/assemble.h"
#include "assembly/discretization.h"
#include "assembly/system.h"
#include "forced/forced_motion.h"
#include "forced/response_peaks.h"
#include "model/errors.h"
#include "results/response.h"
#include "support/random.h"
#include "support/scenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using Complex = std::complex<double>;
using results::Form;
using results::ResponsePeak;
using tests::Random;

constexpr Complex i_unit(0, 1);
constexpr double g = 9.81;

/// Disc in the middle of a massless shaft with two stiffnesses, on two equal bearings.
struct Keyway {
    double length = 0.8, diameter = 0.025, mass = 9, k = 2e6, c = 0, asymmetry = 0.06, angle = 0.5;

    [[nodiscard]] model::Case scene(double from, double to, int count) const {
        model::Case out;
        out.rotor.shaft = tests::uniform_shaft(length, diameter, tests::weightless_steel());
        out.rotor.shaft.segments[0].asymmetry = asymmetry;
        out.rotor.shaft.segments[0].asymmetry_angle = angle;
        out.rotor.shaft.shear = model::ShearFormula::given;
        out.rotor.shaft.shear_coefficient = 0.9;
        out.rotor.discs = {tests::disc_at(length / 2, mass, 0.02, 0.03)};
        out.rotor.bearings = {tests::isotropic_bearing(0, k, c),
                              tests::isotropic_bearing(length, k, c)};
        out.speeds = model::SpeedRange{from, to, count};
        out.response.gravity = g;
        return out;
    }

    /// Deflections of the disc (from the ground) for a unit force along and across the stiff axis,
    /// without those of the bearings: mean, and half the difference.
    [[nodiscard]] double compliance(double sign) const {
        const double area = std::numbers::pi * diameter * diameter / 4;
        const double I = area * diameter * diameter / 16;
        const model::Material steel = tests::steel();
        return std::pow(length, 3) / (48 * steel.E * I * (1 + sign * asymmetry)) +
               length / (4 * 0.9 * steel.G * area);
    }
    [[nodiscard]] double mean() const { return (compliance(1) + compliance(-1)) / 2; }
    [[nodiscard]] Complex turning() const {
        return (compliance(1) - compliance(-1)) / 2 * std::polar(1.0, 2 * angle);
    }

    // In rotating axes u = A exp(i W t) + B exp(-i W t), forces 4 m W^2 A and -i g m on the shaft;
    // u = s_m f + s_d conj(f) and the bearings' compliances at 2 W and at rest.
    [[nodiscard]] Complex circle(double W) const {
        const Complex s = mean() + 0.5 / (k + 2.0 * i_unit * W * c);
        return turning() * (i_unit * g * mass) / (1.0 - 4 * mass * W * W * s);
    }
    [[nodiscard]] Complex still(double W) const {
        return (mean() + 0.5 / k) * (-i_unit * g * mass) +
               turning() * std::conj(4 * mass * W * W * circle(W));
    }
};

const results::GravityStation &station(const results::ResponseResult &result, double z) {
    for (const results::GravityStation &of : result.gravity->stations)
        if (std::abs(of.z - z) < 1e-9)
            return of;
    throw std::runtime_error("no such station");
}

std::vector<ResponsePeak> peaks_at(const results::ResponseResult &result, double z) {
    std::vector<ResponsePeak> out;
    for (const ResponsePeak &peak : result.gravity->peaks)
        if (peak.of == "station" && std::abs(peak.z - z) < 1e-9)
            out.push_back(peak);
    return out;
}

TEST(Weight, DiscOnAShaftOfTwoStiffnesses) {
    for (const double c : {0.0, 300.0, 3000.0}) {
        Keyway keyway;
        keyway.c = c;
        const auto result = analyses::unbalance_response(keyway.scene(0, 400, 41));
        const auto &disc = station(result, 0.4);
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            const double W = result.speeds[i];
            const Complex circle = keyway.circle(W);
            const Complex still = keyway.still(W);
            // A relative error of 1e-12 of the resonance weighs more beside it.
            const double near = 1e-10 * std::max(1.0, std::abs(circle) / std::abs(still));
            EXPECT_NEAR(std::abs(std::polar(disc.twice[i], disc.phase[i]) / circle - 1.0), 0, near)
                << c << " " << W;
            EXPECT_NEAR(std::abs(Complex(disc.sag_x[i], disc.sag_y[i]) / still - 1.0), 0, near);
            EXPECT_NEAR(disc.sag[i], std::abs(still), near * std::abs(still));
            // Each bearing carries half of the weight, and half of the inertia of the circle.
            const auto &bearing = result.gravity->bearings[0];
            EXPECT_NEAR(bearing.carried[i] / (keyway.mass * g / 2), 1, 1e-9);
            if (W > 0) {
                EXPECT_NEAR(bearing.twice[i] / (2 * keyway.mass * W * W * std::abs(circle)), 1,
                            1e-9 + near);
            }
            EXPECT_LT(disc.error[i], 1e-7 * std::max(1.0, std::abs(circle / still)));
        }
    }
}

TEST(Weight, PeakOfTheDampedKeywayShaftWhateverTheGrid) {
    Keyway keyway;
    keyway.c = 2000;
    // d |circle|^2 / dW = 0: |D|^2 least, D = 1 - 4 m W^2 (s + 1/(2 (k + 2 i W c))).
    const auto slope = [&](double W) {
        const Complex z = keyway.k + 2.0 * i_unit * W * keyway.c;
        const Complex s = keyway.mean() + 0.5 / z;
        const Complex D = 1.0 - 4 * keyway.mass * W * W * s;
        const Complex dD = -8 * keyway.mass * W * s +
                           4 * keyway.mass * W * W * (0.5 * 2.0 * i_unit * keyway.c / (z * z));
        return (std::conj(D) * dD).real();
    };
    double low = 60;
    double high = 130;
    while (high - low > 1e-13 * high)
        (slope((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    for (const int count : {2, 11, 1001}) {
        const auto peaks = peaks_at(analyses::unbalance_response(keyway.scene(1, 400, count)), 0.4);
        ASSERT_EQ(peaks.size(), 1U);
        EXPECT_NEAR(peaks[0].speed / low, 1, 1e-9);
        EXPECT_NEAR(peaks[0].value / std::abs(keyway.circle(low)), 1, 1e-9);
        EXPECT_NEAR(
            std::remainder(peaks[0].phase - std::arg(keyway.circle(low)), 2 * std::numbers::pi), 0,
            1e-6);
        ASSERT_TRUE(peaks[0].lower && peaks[0].upper);
        for (const double half : {*peaks[0].lower, *peaks[0].upper})
            EXPECT_NEAR(std::abs(keyway.circle(half)) * std::numbers::sqrt2 / peaks[0].value, 1,
                        1e-8);
    }
}

/// Half the critical speed of the mean shaft (Den Hartog, Mechanical Vibrations, 4th ed., section
/// 6.5: a subcritical speed by gravity and two stiffnesses); with the mean of the compliances
/// exactly.
TEST(Weight, CriticalAtHalfTheSpeedWithoutDamping) {
    for (const double asymmetry : {0.01, 0.06, 0.3}) {
        Keyway keyway;
        keyway.asymmetry = asymmetry;
        const double half = 0.5 / std::sqrt(keyway.mass * (keyway.mean() + 0.5 / keyway.k));
        auto scene = keyway.scene(1, 400, 11);
        const auto peaks = peaks_at(analyses::unbalance_response(scene), 0.4);
        ASSERT_EQ(peaks.size(), 1U);
        EXPECT_NEAR(peaks[0].speed / half, 1, 1e-9);
        EXPECT_TRUE(std::isinf(peaks[0].value));
        Keyway round = keyway;
        round.asymmetry = 0;
        const double critical = 1 / std::sqrt(round.mass * (round.mean() + 0.5 / round.k));
        EXPECT_NEAR(peaks[0].speed / (critical / 2), 1, asymmetry * asymmetry);
        scene.speeds = model::SpeedRange{peaks[0].speed, peaks[0].speed, 1};
        const auto there = analyses::unbalance_response(scene);
        EXPECT_TRUE(std::isinf(station(there, 0.4).twice[0]));
        EXPECT_TRUE(std::isinf(station(there, 0.4).sag[0]));
        ASSERT_EQ(there.model.notes.size(), 1U);
        EXPECT_NE(there.model.notes[0].find("no steady motion under the weight"),
                  std::string::npos);
    }
}

/// Some asymmetric flexible rotor with damping on bearings that are alike in all directions.
/// @param shaft  of two stiffnesses; else unequal inertias alone
model::Case random_rotor(Random &random, bool shaft = true) {
    model::Case scene;
    model::Rotor &rotor = scene.rotor;
    rotor.shaft = tests::uniform_shaft(1.0, random(0.03, 0.08), tests::steel());
    rotor.shaft.order = 2;
    rotor.shaft.segments[0].elements = 4;
    rotor.shaft.internal_damping = random.coin() ? 0 : random(1e-6, 1e-5);
    for (int i = 0; i < 2; ++i)
        rotor.discs.push_back(
            tests::disc_at(random(0.1, 0.95), random(5, 30), random(0.1, 0.2), random(0.05, 0.19)));
    if (shaft) {
        rotor.shaft.segments[0].asymmetry = random(0.01, 0.3);
        rotor.shaft.segments[0].asymmetry_angle = random(0, 3);
    }
    if (!shaft || random.coin())
        rotor.anisotropies = {
            {"", rotor.discs[0].z, random(0.1, 0.5) * rotor.discs[0].Ip, random(0, 3)}};
    for (const double z : {random(0, 0.2), random(0.8, 1)}) {
        model::Bearing bearing = tests::isotropic_bearing(z, std::pow(10, random(6, 7.5)),
                                                          std::pow(10, random(2.5, 3.7)));
        model::BearingCoefficients &row = bearing.rows[0];
        if (random.coin()) {
            row.k(0, 1) = random(-0.02, 0.02) * row.k(0, 0);
            row.k(1, 0) = -row.k(0, 1);
        }
        if (random(0, 1) < 0.3) {
            model::BearingCoefficients faster = row;
            faster.k *= random(1, 3);
            faster.c *= random(0.3, 1);
            bearing.rows.push_back(faster);
            bearing.speeds = {random(100, 400), random(600, 1500)};
        }
        if (random.coin())
            bearing.pedestal = model::Pedestal{random(2, 20), std::pow(10, random(7, 8.5)),
                                               std::pow(10, random(3, 4))};
        rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, random(500, 1200), 11};
    scene.response.gravity = g;
    return scene;
}

/// Harmonic balance in the fixed frame, dense: w = sum w_n exp(2 i n W t), n = -2..2, of
///   M w'' - i W G w' + (Ce + Ci) w' + (K - i W Ci) w + exp(2 i W t) [a conj(w'' - 2 i W w')
///     + d conj(w' - i W w) + k conj(w)] = -i g M 1
/// where a, d, k are what is not axisymmetric (theory.md, "Rotating frame", seen from the ground).
struct HarmonicBalance {
    static constexpr int most = 2;
    Eigen::Index n;
    Eigen::VectorXd unknowns; ///< (Re, Im) of each w_n

    HarmonicBalance(const assembly::Discretization &d, double W) : n(d.planar_size()) {
        fill(d, W);
        const Eigen::Index size = 2 * n * (2 * most + 1);
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
        Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
        for (int h = -most; h <= most; ++h) {
            const Complex l = 2.0 * i_unit * static_cast<double>(h) * W;
            place(A, h, h, l * l * M - i_unit * W * l * G + l * (Ce + Ci) + K - i_unit * W * Ci,
                  false);
            if (std::abs(1 - h) > most) // conj of the harmonic 1 - h falls on h
                continue;
            const Complex of = 2.0 * i_unit * static_cast<double>(1 - h) * W;
            place(A, h, 1 - h,
                  std::conj(of * of - 2.0 * i_unit * W * of) * a +
                      std::conj(of - i_unit * W) * damping + stiffness,
                  true);
        }
        const std::vector<double> ones = d.rigid_motion(false);
        f.segment(2 * n * most + n, n) =
            -g * rotor_mass * Eigen::Map<const Eigen::VectorXd>(ones.data(), n);
        unknowns = A.fullPivLu().solve(f);
    }

    [[nodiscard]] Complex harmonic(int h, const assembly::Combination &w) const {
        Complex out;
        for (const auto &[unknown, value] : w)
            out += value * Complex(unknowns(2 * n * (h + most) + unknown),
                                   unknowns(2 * n * (h + most) + n + unknown));
        return out;
    }

  private:
    Eigen::MatrixXcd M, G, Ce, Ci, K, a, damping, stiffness;
    Eigen::MatrixXd rotor_mass;

    void place(Eigen::MatrixXd &A, int row, int column, const Eigen::MatrixXcd &block,
               bool conjugate) const {
        const Eigen::Index i = 2 * n * (row + most);
        const Eigen::Index j = 2 * n * (column + most);
        const double sign = conjugate ? -1 : 1;
        A.block(i, j, n, n) += block.real();
        A.block(i, j + n, n, n) -= sign * block.imag();
        A.block(i + n, j, n, n) += block.imag();
        A.block(i + n, j + n, n, n) += sign * block.real();
    }

    void fill(const assembly::Discretization &d, double W) {
        using assembly::Term;
        for (Eigen::MatrixXcd *matrix : {&M, &G, &Ce, &Ci, &K, &a, &damping, &stiffness})
            *matrix = Eigen::MatrixXcd::Zero(n, n);
        const auto add = [](Eigen::MatrixXcd &to, std::span<const int> at,
                            const Eigen::MatrixXd &block, Complex factor) {
            for (std::size_t i = 0; i < at.size(); ++i)
                for (std::size_t j = 0; j < at.size(); ++j)
                    to(at[i], at[j]) +=
                        factor * block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        };
        assembly::assemble_rotating_parts(
            d, [&](Term term, std::span<const int> at, const Eigen::MatrixXd &block) {
                if (term == Term::mass)
                    add(M, at, block, 1);
                else if (term == Term::gyroscopic)
                    add(G, at, block, 1);
                else if (term == Term::stiffness)
                    add(K, at, block, 1);
                else if (term == Term::damping)
                    add(Ci, at, block, 1);
            });
        rotor_mass = M.real();
        assembly::assemble_asymmetry(d, [&](Term term, std::span<const int> at,
                                            const Eigen::MatrixXd &block, Complex factor) {
            add(term == Term::mass ? a : (term == Term::damping ? damping : stiffness), at, block,
                factor);
        });
        assembly::assemble_supports(
            d, W, [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                const Complex round(block(0, 0), block(1, 0));
                (term == Term::mass ? M : (term == Term::damping ? Ce : K))(i, j) += round;
            });
    }
};

TEST(Weight, IsAStaticPartAndOneAtTwiceTheSpeedByHarmonicBalance) {
    Random random(31);
    for (int rotor = 0; rotor < 25; ++rotor) {
        const bool shaft = rotor % 5 != 0;
        const model::Case scene = random_rotor(random, shaft);
        const assembly::Discretization d(scene.rotor, 2);
        forced::ForcedMotion motion(d, Form::rotating, {g});
        for (int i = 0; i < 3; ++i) {
            const double W = i == 0 ? 0 : random(-1200, 1200);
            const HarmonicBalance balance(d, W);
            motion.solve(W);
            for (const model::Disc &disc : scene.rotor.discs) {
                const assembly::Combination w = d.deflection_at(disc.z);
                const Complex still = balance.harmonic(0, w);
                const Complex twice = balance.harmonic(1, w);
                const double size = std::abs(still) + std::abs(twice);
                if (!shaft) {
                    EXPECT_LT(std::abs(twice), 1e-11 * size); // unequal inertias are not felt
                }
                EXPECT_LT(std::abs(motion.at_rest(w) - still), 1e-9 * size) << rotor << " " << W;
                EXPECT_LT(std::abs(motion.motion(w).x - twice), 1e-9 * size) << rotor << " " << W;
                for (const int h : {-2, -1, 2})
                    EXPECT_LT(std::abs(balance.harmonic(h, w)), 1e-12 * size);
            }
        }
    }
}

TEST(Weight, OfAxisymmetricRotorsInRotatingAxesIsStaticAndTheirImbalanceAsInFixedOnes) {
    Random random(32);
    for (int rotor = 0; rotor < 12; ++rotor) {
        model::Case scene = random_rotor(random);
        scene.rotor.anisotropies.clear();
        scene.rotor.shaft.segments[0].asymmetry = 0;
        scene.rotor.imbalances = {tests::imbalance_at(scene.rotor.discs[0].z, 1e-4, 0.4)};
        const assembly::Discretization d(scene.rotor, 2);
        forced::ForcedMotion turning(d, Form::rotating, {g});
        forced::ForcedMotion fixed(d, Form::general, {g});
        forced::ForcedMotion imbalance_turning(d, Form::rotating);
        forced::ForcedMotion imbalance_fixed(d, Form::general);
        for (int i = 0; i < 3; ++i) {
            const double W = random(-1200, 1200);
            for (forced::ForcedMotion *motion :
                 {&turning, &fixed, &imbalance_turning, &imbalance_fixed})
                motion->solve(W);
            for (const model::Disc &disc : scene.rotor.discs) {
                const assembly::Combination w = d.deflection_at(disc.z);
                const double sag = std::abs(fixed.at_rest(w));
                EXPECT_LT(std::abs(turning.at_rest(w) - fixed.at_rest(w)), 1e-11 * sag);
                EXPECT_LT(std::abs(turning.motion(w).x), 1e-11 * sag);
                EXPECT_EQ(std::abs(fixed.motion(w).x), 0);
                const forced::Phasor a = imbalance_turning.motion(w);
                const forced::Phasor b = imbalance_fixed.motion(w);
                EXPECT_LT(std::abs(a.x - b.x), 1e-11 * std::abs(b.x));
                EXPECT_LT(std::abs(a.y - b.y), 1e-11 * std::abs(b.y));
            }
        }
    }
}

TEST(Weight, OfAnAxisymmetricRotorIsCarriedByItsBearings) {
    Random random(33);
    for (int rotor = 0; rotor < 6; ++rotor) {
        model::Case scene = random_rotor(random);
        scene.rotor.anisotropies.clear();
        scene.rotor.shaft.segments[0].asymmetry = 0;
        scene.rotor.shaft.rigid = rotor % 3 == 0;
        double mass = 0;
        for (model::Bearing &bearing : scene.rotor.bearings)
            for (model::BearingCoefficients &row : bearing.rows) {
                row.k(0, 1) = row.k(1, 0) = 0;
                row.k(0, 0) *= 1.7; // not the same from every direction: answered as well
            }
        for (const model::Disc &disc : scene.rotor.discs)
            mass += disc.mass;
        const model::Segment &shaft = scene.rotor.shaft.segments[0];
        mass += shaft.material.rho * std::numbers::pi / 4 * std::pow(shaft.outer_start, 2) *
                shaft.length;
        const auto result = analyses::unbalance_response(scene);
        EXPECT_TRUE(result.nodes.empty());
        EXPECT_TRUE(result.gravity->peaks.empty());
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            double carried = 0;
            for (const auto &bearing : result.gravity->bearings) {
                carried += bearing.carried[i];
                EXPECT_EQ(bearing.twice[i], 0);
            }
            if (scene.rotor.shaft.internal_damping == 0 || scene.rotor.shaft.rigid) {
                EXPECT_NEAR(carried / (mass * g), 1, 1e-10);
            }
            for (const auto &of : result.gravity->stations)
                EXPECT_EQ(of.twice[i], 0);
        }
    }
}

/// Local maxima of the whole rotor's circle, by looking at very many speeds.
std::vector<std::pair<double, double>> looked_for(const assembly::Discretization &d, double z, double from, double to,
                               int count) {
    forced::ForcedMotion motion(d, Form::rotating, {g});
    const assembly::Combination w = d.deflection_at(z);
    const auto circle = [&](double speed) {
        motion.solve(speed);
        return std::abs(motion.motion(w).x);
    };
    std::vector<double> values;
    const double step = (to - from) / count;
    for (int i = 0; i <= count; ++i)
        values.push_back(circle(from + i * step));
    std::vector<std::pair<double, double>> out;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
        if (values[i] < values[i - 1] || values[i] <= values[i + 1])
            continue;
        double a = from + static_cast<double>(i - 1) * step;
        double b = from + static_cast<double>(i + 1) * step;
        while (b - a > 1e-7 * b) { // thirds
            const double left = a + (b - a) / 3;
            const double right = b - (b - a) / 3;
            (circle(left) < circle(right) ? a : b) = circle(left) < circle(right) ? left : right;
        }
        out.emplace_back((a + b) / 2, circle((a + b) / 2));
    }
    return out;
}

TEST(Weight, NoPeakIsMissingAndNoneFalseInRandomRotors) {
    Random random(34);
    int found = 0;
    for (int rotor = 0; rotor < 8; ++rotor) {
        const model::Case scene = random_rotor(random);
        const auto result = analyses::unbalance_response(scene);
        const assembly::Discretization d(scene.rotor, 2);
        for (const model::Disc &disc : scene.rotor.discs) {
            const auto peaks = peaks_at(result, disc.z);
            const auto expected = looked_for(d, disc.z, 0.3, scene.speeds->to, 4000);
            ASSERT_EQ(peaks.size(), expected.size()) << "rotor " << rotor;
            for (std::size_t i = 0; i < peaks.size(); ++i, ++found) {
                // A search by values finds the place of a shallow one to the root of rounding.
                EXPECT_NEAR(peaks[i].speed / expected[i].first, 1, 1e-4) << "rotor " << rotor;
                EXPECT_NEAR(peaks[i].value / expected[i].second, 1, 1e-8) << "rotor " << rotor;
            }
        }
    }
    EXPECT_GT(found, 20);
}

TEST(Weight, TheGridOfItsPeaksDoesNotMatter) {
    Random random(35);
    for (int rotor = 0; rotor < 2; ++rotor) {
        model::Case scene = random_rotor(random);
        const auto coarse = analyses::unbalance_response(scene).gravity->peaks;
        scene.speeds->count = 1001;
        const auto fine = analyses::unbalance_response(scene).gravity->peaks;
        ASSERT_EQ(coarse.size(), fine.size());
        for (std::size_t i = 0; i < fine.size(); ++i) {
            EXPECT_NEAR(coarse[i].speed / fine[i].speed, 1, 1e-8);
            EXPECT_NEAR(coarse[i].value / fine[i].value, 1, 1e-8);
        }
    }
}

TEST(Weight, ErrorsOfItsPeaksHold) {
    Random random(36);
    int compared = 0;
    for (int rotor = 0; rotor < 3; ++rotor) {
        model::Case scene = random_rotor(random);
        scene.rotor.shaft.order = 1 + rotor % 3;
        const auto coarse = analyses::unbalance_response(scene).gravity->peaks;
        scene.rotor.shaft.order = 10;
        const auto fine = analyses::unbalance_response(scene).gravity->peaks;
        if (coarse.size() != fine.size())
            continue; // so coarse that a peak is on the other side of an end
        for (std::size_t i = 0; i < fine.size(); ++i, ++compared)
            if (!std::isnan(coarse[i].error)) {
                EXPECT_LE(std::abs(coarse[i].value / fine[i].value - 1), 2 * coarse[i].error + 3e-9)
                    << "rotor " << rotor << " peak " << i;
            }
    }
    EXPECT_GT(compared, 10);
}

TEST(Weight, UnequalInertiasAloneAreNotFelt) {
    Random random(38);
    for (int rotor = 0; rotor < 4; ++rotor) {
        model::Case scene = random_rotor(random, false);
        const auto with = analyses::unbalance_response(scene);
        scene.rotor.anisotropies.clear();
        const auto without = analyses::unbalance_response(scene);
        EXPECT_TRUE(with.gravity->peaks.empty());
        for (const model::Disc &disc : scene.rotor.discs) {
            EXPECT_EQ(station(with, disc.z).sag, station(without, disc.z).sag);
            EXPECT_EQ(station(with, disc.z).twice, station(without, disc.z).twice);
        }
        EXPECT_EQ(with.model.notes.size(), 1U);
    }
}

/// In rotating axes rounding makes no peaks of nothing.
TEST(Weight, RoundingHasNoPeaks) {
    Random random(39);
    for (int rotor = 0; rotor < 6; ++rotor) {
        model::Case scene = random_rotor(random, false);
        if (rotor % 2 == 0) {
            scene.rotor.shaft.internal_damping = 0;
            for (model::Bearing &bearing : scene.rotor.bearings) {
                for (model::BearingCoefficients &row : bearing.rows)
                    row.c.setZero();
                bearing.pedestal.reset();
            }
        }
        const assembly::Discretization d(scene.rotor, 2);
        std::vector<forced::Quantity> quantities;
        std::vector<double> places;
        for (const model::Disc &disc : scene.rotor.discs) {
            quantities.push_back({d.deflection_at(disc.z)});
            places.push_back(disc.z);
        }
        const auto found =
            forced::response_peaks(d, Form::rotating, quantities, places, 0, scene.speeds->to, {g});
        EXPECT_TRUE(found.peaks.empty()) << rotor;
    }
}

TEST(Weight, SaysWhatItCannotAnswer) {
    Random random(37);
    model::Case scene = random_rotor(random);
    scene.rotor.bearings[0].rows[0].k(1, 1) *= 2;
    EXPECT_THROW((void)analyses::unbalance_response(scene), model::AnalysisFailure);
    scene = random_rotor(random);
    scene.rotor.bearings.clear();
    EXPECT_THROW((void)analyses::unbalance_response(scene), model::BadInput);
}

} // namespace

// Motion under the weight: closed form of a disc on an asymmetric shaft, harmonic balance in the
// fixed frame, rotors that are axisymmetric.

#include "analyses/response.h"
#include "assembly/assemble.h"
#include "assembly/discretization.h"
#include "assembly/system.h"
#include "forced/forced_motion.h"
#include "model/errors.h"
#include "results/response.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/weighed_rotors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weight_test {

using namespace whirl;
using Complex = std::complex<double>;
using results::Form;
using tests::g;
using tests::Keyway;
using tests::Random;
using tests::station;
using tests::weighed_rotor;

constexpr Complex i_unit(0, 1);

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
        f.segment(2 * n * most + n, n) = -g * rotor_mass * d.rigid_motion(false);
        unknowns = A.partialPivLu().solve(f);
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
        const model::Case scene = weighed_rotor(random, shaft);
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
        model::Case scene = weighed_rotor(random);
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
                // The shaft is up to 1e5 times as stiff within an element as what bears it.
                EXPECT_LT(std::abs(a.x - b.x), 1e-10 * std::abs(b.x));
                EXPECT_LT(std::abs(a.y - b.y), 1e-10 * std::abs(b.y));
            }
        }
    }
}

TEST(Weight, OfAnAxisymmetricRotorIsCarriedByItsBearings) {
    Random random(33);
    for (int rotor = 0; rotor < 6; ++rotor) {
        model::Case scene = weighed_rotor(random);
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

TEST(Weight, UnequalInertiasAloneAreNotFelt) {
    Random random(38);
    for (int rotor = 0; rotor < 4; ++rotor) {
        model::Case scene = weighed_rotor(random, false);
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

TEST(Weight, SaysWhatItCannotAnswer) {
    Random random(37);
    model::Case scene = weighed_rotor(random);
    scene.rotor.bearings.clear();
    EXPECT_THROW((void)analyses::unbalance_response(scene), model::BadInput);
}

} // namespace weight_test

#include "operation/level1.h"

#include "model/errors.h"
#include "support/rigid_jeffcott.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace {

using namespace whirl;
using Complex = std::complex<double>;

/// The rotor of a test at 500 rad/s with coupling at mid-span.
model::Case coupled(const tests::RigidJeffcott &rotor) {
    model::Case scene = rotor.scene();
    scene.operation = model::Operation{300, 500, {}};
    scene.level1 = model::Level1Settings{0.5, {}, 13, {}};
    return scene;
}

results::Level1 level1(const model::Case &scene, std::vector<results::Sentence> &notes) {
    const model::Shaft &shaft = scene.rotor.shaft;
    return operation::level1(scene, shaft.rigid ? 1 : shaft.order, notes);
}

results::Level1 level1(const model::Case &scene) {
    std::vector<results::Sentence> notes;
    const results::Level1 out = level1(scene, notes);
    EXPECT_TRUE(notes.empty()) << notes.front();
    return out;
}

/// m l^2 + c l + k - i q = 0 for w = x + i y: on the border l = i w_n, c w_n = q.
TEST(Level1, JeffcottRotor) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    const double threshold = rotor.c * rotor.natural();
    scene.level1->anticipated = 0.4 * threshold;
    const results::Level1 found = level1(scene);
    ASSERT_TRUE(found.critical_cross_coupling.has_value());
    // Rounding of an eigenvalue problem of two unknowns.
    EXPECT_NEAR(*found.critical_cross_coupling / threshold, 1, 1e-10);
    EXPECT_NEAR(*found.critical_frequency / rotor.natural(), 1, 1e-10);
    EXPECT_EQ(found.speed, 500);
    const auto log_dec = [&](double q) {
        const Complex root =
            std::sqrt(Complex(rotor.c * rotor.c, 0) - 4 * rotor.mass * Complex(rotor.kx, -q));
        const Complex l = (-rotor.c + (root.imag() > 0 ? root : -root)) / (2 * rotor.mass);
        return -2 * std::numbers::pi * l.real() / l.imag();
    };
    ASSERT_EQ(found.q.size(), 13U);
    EXPECT_EQ(found.q.front(), 0);
    EXPECT_NEAR(found.q.back() / threshold, 1.5, 1e-9);
    for (std::size_t i = 0; i < found.q.size(); ++i)
        EXPECT_NEAR(found.log_dec[i], log_dec(found.q[i]), 1e-9) << found.q[i];
    EXPECT_NEAR(*found.anticipated_log_dec, log_dec(0.4 * threshold), 1e-9);
}

/// (m l^2 + c l + kx)(m l^2 + c l + ky) + q^2 = 0. Below q = |kx - ky|/2 both motions are damped
/// alike and their frequencies meet there; beyond it one is forward, on the border at
/// l^2 = -(kx + ky)/(2 m), q^2 = c^2 (kx + ky)/(2 m) + (kx - ky)^2/4.
TEST(Level1, BearingsThatDifferBetweenTheirDirections) {
    tests::RigidJeffcott rotor;
    rotor.kx = 0.8e6;
    rotor.ky = 1.2e6;
    model::Case scene = coupled(rotor);
    scene.level1->to = 0.4e6;
    scene.level1->count = 9;
    const results::Level1 found = level1(scene);
    const double border = std::hypot(rotor.c * rotor.natural(), 0.2e6);
    EXPECT_NEAR(*found.critical_cross_coupling / border, 1, 1e-10);
    EXPECT_NEAR(*found.critical_frequency / rotor.natural(), 1, 1e-10);
    for (std::size_t i = 0; i < found.q.size(); ++i) {
        const Complex p = -1e6 + std::sqrt(Complex(0.04e12 - found.q[i] * found.q[i]));
        double nearest = 1e9; // of the roots of both branches
        for (const Complex k : {-p, -std::conj(p), 2e6 + p})
            for (const double sign : {-1.0, 1.0}) {
                const Complex l =
                    (-rotor.c + sign * std::sqrt(rotor.c * rotor.c - 4 * rotor.mass * k)) /
                    (2 * rotor.mass);
                if (l.imag() > 0)
                    nearest =
                        std::min(nearest, std::abs(found.log_dec[i] +
                                                   2 * std::numbers::pi * l.real() / l.imag()));
            }
        // At q = |kx - ky|/2 the root is double: known to the root of rounding.
        EXPECT_LT(nearest, i == 4 ? 1e-6 : 1e-9) << found.q[i];
    }
    EXPECT_GT(found.log_dec[4], 0.5); // still as damped as without
    EXPECT_LT(found.log_dec[8], 0);
}

TEST(Level1, WithoutDampingAnyCouplingDrives) {
    tests::RigidJeffcott rotor;
    rotor.c = 0;
    const results::Level1 found = level1(coupled(rotor));
    EXPECT_EQ(found.critical_cross_coupling, 0);
    EXPECT_EQ(found.log_dec.front(), 0);
    EXPECT_LT(found.log_dec.back(), 0);
}

TEST(Level1, SaysThatARotorGrowsWithoutAddedCoupling) {
    const tests::RigidJeffcott rotor;
    model::Case scene = coupled(rotor);
    model::Bearing seal;
    seal.seal = true;
    seal.z = 0.5;
    const double q = 1.1 * rotor.c * rotor.natural();
    seal.rows.emplace_back().k << 0, q, -q, 0;
    scene.rotor.bearings.push_back(seal);
    std::vector<results::Sentence> notes;
    const results::Level1 found = level1(scene, notes);
    EXPECT_FALSE(found.critical_cross_coupling.has_value());
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("without any added cross coupling"), std::string::npos);
}

TEST(Level1, EstimatesItsError) {
    model::Case scene;
    scene.rotor = tests::two_disc_rotor(1e7, 2e7, 0, 3e4);
    scene.operation = model::Operation{100, 300, {}};
    scene.level1 = model::Level1Settings{0.75, {}, 2, {}};
    const auto of_order = [&](int order) {
        scene.rotor.shaft.order = order;
        // Of order 2: its fastest motion grows before, at 1e5 rad/s.
        std::vector<results::Sentence> notes;
        return level1(scene, notes);
    };
    const results::Level1 exact = of_order(12);
    for (const int order : {1, 2, 3}) {
        const results::Level1 found = of_order(order);
        const double error =
            std::abs(*found.critical_cross_coupling / *exact.critical_cross_coupling - 1);
        EXPECT_GT(error, 1e-9) << order; // there is something to estimate
        EXPECT_LT(error, found.error) << order;
        EXPECT_LT(found.error, 3 * error) << order;
    }
}

TEST(Level1, IsForAxisymmetricRotors) {
    model::Case scene = coupled({});
    scene.rotor.anisotropies.push_back({"", 0.5, 0.001, 0});
    std::vector<results::Sentence> notes;
    EXPECT_THROW((void)level1(scene, notes), model::BadInput);
}

} // namespace

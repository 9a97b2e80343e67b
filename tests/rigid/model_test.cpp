// The finite-element side of the comparison with the rigid rotor: against statics of a massless
// shaft, which uses nothing of the program; and against the analyses of stability, which use the
// same element matrices and other equations and searches.

#include "rigid/model.h"

#include "analyses/stability.h"
#include "ends/permissible.h"
#include "rigid/inertia.h"
#include "support/rigid_rotors.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::rigid {

namespace {

using namespace whirl::tests;

RigidTarget target_of(RigidQuantity kind, int index = 0) {
    RigidTarget target;
    target.kind = kind;
    target.index = index;
    return target;
}

} // namespace

/// The two-support rotor as a disc on a massless Timoshenko beam: compliance at the disc by the
/// rules of statics, W from det[1/W^2 - C diag(M, A - C)].
TEST(RigidLimitModel, FlexibleSpeedsFollowFromTheComplianceOfTheShaft) {
    model::Rotor rotor = two_support_case().rotor;
    rotor.shaft.shear = model::ShearFormula::given;
    rotor.shaft.shear_coefficient = 0.9;
    const double a = 0.4, b = 0.5, L = 0.9, k1 = 2e6, k2 = 3e6;
    const double EI = 2e11 * M_PI * std::pow(0.06, 4) / 64;
    const double kGA = 0.9 * 7.7e10 * M_PI * 0.06 * 0.06 / 4;
    Eigen::Matrix2d compliance; // (w, phi) per (force, moment)
    compliance << a * a * b * b / (3 * EI * L) + a * b / (kGA * L), a * b * (b - a) / (3 * EI * L),
        a * b * (b - a) / (3 * EI * L), (a * a - a * b + b * b) / (3 * EI * L) + 1 / (kGA * L);
    Eigen::Matrix2d rigid;
    rigid << k1 + k2, k2 * b - k1 * a, k2 * b - k1 * a, k1 * a * a + k2 * b * b;
    compliance += rigid.inverse();
    const Eigen::Vector2d inertia(60, 3 - 1);
    const Eigen::MatrixXd product = compliance * inertia.asDiagonal();
    const Eigen::VectorXd squares = product.eigenvalues().real().cwiseInverse();
    for (const int order : {1, 4}) { // both elements are exact between nodes without mass
        const auto found = model_values(
            rotor, order,
            {target_of(RigidQuantity::critical, 0), target_of(RigidQuantity::critical, 1)});
        ASSERT_TRUE(found[0] && found[1]);
        // The shaft's own 2e-15 kg and rounding of its stiffness.
        EXPECT_NEAR(found[0]->value, std::sqrt(squares.minCoeff()), 1e-8 * found[0]->value);
        EXPECT_NEAR(found[1]->value, std::sqrt(squares.maxCoeff()), 1e-8 * found[1]->value);
    }
}

/// The anisotropic disc in the middle of a massless shaft on two damped bearings, standing still in
/// rotating axes: with q the stiffness against its tilt under a moment that turns with the rotor,
/// 1/q = L/(12 EI) + 1/(kGA L) + 2/((k + i W c) L^2), and the inertia
/// W^2 (A - C) on the mean, W^2 a between the tilt and its conjugate, the determinant is
/// |q - W^2 (A - C)|^2 - (W^2 a)^2.
struct StandingTilt {
    double E = 2e9, G = 7.7e8, L = 2, d = 0.02, k = 0.78125, c = 0.078, A = 1, C = 0.8;

    /// Largest a at which the determinant is not negative.
    [[nodiscard]] double permissible(double W) const {
        const double nu = E / (2 * G) - 1;
        const double shear = 6 * (1 + nu) / (7 + 6 * nu) * G * M_PI * d * d / 4; // Cowper
        const std::complex<double> bearing(k, W * c);
        const std::complex<double> compliance =
            L / (12 * E * M_PI * std::pow(d, 4) / 64) + 1 / (shear * L) + 2.0 / (bearing * L * L);
        return std::abs(1.0 / compliance - W * W * (A - C)) / (W * W);
    }
    /// Where it becomes equal to a between two speeds.
    [[nodiscard]] double end(double a, double from, double to) const {
        const bool stable = permissible(from) > a;
        for (int i = 0; i < 100; ++i) {
            const double middle = (from + to) / 2;
            ((permissible(middle) > a) == stable ? from : to) = middle;
        }
        return from;
    }
    /// Its least over a range, by golden sections.
    [[nodiscard]] double least(double from, double to) const {
        const double share = (std::sqrt(5.0) - 1) / 2;
        for (int i = 0; i < 100; ++i) {
            const double a = to - share * (to - from);
            const double b = from + share * (to - from);
            if (permissible(a) < permissible(b))
                to = b;
            else
                from = a;
        }
        return permissible(from);
    }
};

TEST(RigidLimitModel, AnisotropicDiscOnAMasslessShaft) {
    const model::Rotor rotor = anisotropic_case().rotor;
    RigidTarget from = target_of(RigidQuantity::unstable_from, 2); // translation comes first, twice
    from.upper = 3;
    RigidTarget to = from;
    to.kind = RigidQuantity::unstable_to;
    RigidTarget permissible = target_of(RigidQuantity::permissible);
    permissible.from = 0;
    permissible.to = 6;
    const auto found = model_values(rotor, 2, {from, to, permissible});
    const StandingTilt tilt;
    ASSERT_TRUE(found[0] && found[1] && found[2]);
    const double least = tilt.least(2.3, 3.9); // one minimum, between the ends
    EXPECT_LT(least, 0.1);
    EXPECT_NEAR(found[2]->value, least, 1e-8 * least); // flat at the minimum
    EXPECT_NEAR(found[0]->value, tilt.end(0.1, 1.5, 2.8), 1e-8 * 2.4);
    EXPECT_NEAR(found[1]->value, tilt.end(0.1, 2.8, 5), 1e-8 * 3.8);
}

/// The ends of instability by following the free motions over speed.
TEST(RigidLimitModel, EndsAreThoseOfTheUnstableBand) {
    const model::Case scene = heavier_anisotropic_case();
    RigidTarget from = target_of(RigidQuantity::unstable_from, 2); // translation comes first, twice
    from.upper = 3;
    RigidTarget to = from;
    to.kind = RigidQuantity::unstable_to;
    const auto found = model_values(scene.rotor, 2, {from, to});
    const auto bands = analyses::unstable_bands_of(scene, {}, false).bands;
    ASSERT_EQ(bands.size(), 1u);
    ASSERT_TRUE(found[0] && found[1]);
    EXPECT_NEAR(found[0]->value, bands[0].from, 1e-8 * bands[0].from); // of the bands' ends
    EXPECT_NEAR(found[1]->value, bands[0].to, 1e-8 * bands[0].to);
}

/// The largest stable anisotropy by descent over unstable bands.
TEST(RigidLimitModel, PermissibleAnisotropyIsThatOfTheStabilityAnalysis) {
    const model::Case scene = heavier_anisotropic_case();
    RigidTarget target = target_of(RigidQuantity::permissible);
    target.from = 0;
    target.to = 6;
    const auto found = model_values(scene.rotor, 2, {target});
    const auto model = stability::stability_model(scene, scene.speeds->values());
    const auto entries =
        ends::permissible_anisotropies({model, {}}, stability::search_speeds(*scene.speeds), {});
    ASSERT_TRUE(found[0] && entries.at(0).dI);
    EXPECT_NEAR(found[0]->value, *entries[0].dI, 1e-7 * *entries[0].dI); // of the descent
}

/// Speeds at which a root is zero with the balls free to move.
TEST(RigidLimitModel, PinnedRotorStandsWhereFreeBallsDo) {
    const model::Rotor rotor = balancer_case().rotor;
    model::Rotor undamped = rotor;
    for (model::Bearing &bearing : undamped.bearings)
        bearing.rows[0].c.setZero();
    std::vector<RigidTarget> targets;
    for (const int index : {0, 1}) {
        targets.push_back(target_of(RigidQuantity::additional, index));
        targets.back().z = 0.5;
    }
    const auto found = model_values(rotor, 4, targets);
    const assembly::Discretization d(undamped, 4);
    const auto standing =
        stability::zero_root_speeds(d, balancers::arrangement_at_balance(undamped), false, 1500);
    ASSERT_GE(standing.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(found[i]);
        EXPECT_NEAR(found[i]->value, standing[i].speed, 1e-7 * standing[i].speed); // of the latter
    }
}

/// Sums over the parts, as in cases/composite_rotor: M_s and C by hand.
TEST(RigidLimitModel, InertiaCountsBallsAndImbalance) {
    model::Case scene = balancer_case();
    scene.rotor.shaft.segments[0].material = weightless_steel();
    const double m0 = 0.4 / 0.3, balls = 2 * 2 * 0.04, A_m0 = m0 * 0.09;
    const double center = (57.83 * 0.4 + (4 + m0) * 0.5) / (61.83 + m0);
    const Inertia of_matrices = model_inertia(scene.rotor, 4);
    // E = 4 x 0.2 / 0.4 = 2: D = 2/E^2 - 1 = -1/2
    EXPECT_NEAR(std::abs(of_matrices.a), (A_m0 - balls / 2) / 2, 1e-12);
    for (const Inertia &inertia : {of_matrices, inertia_of(scene.rotor)}) {
        EXPECT_NEAR(inertia.mass, 57.83 + 4 + m0, 1e-10);
        EXPECT_NEAR(inertia.polar, 0.289 + balls + A_m0, 1e-12);
        EXPECT_NEAR(inertia.center(), center, 1e-12);
        EXPECT_NEAR(inertia.diametral(),
                    0.413 + 57.83 * std::pow(0.4 - center, 2) +
                        (4 + m0) * std::pow(0.5 - center, 2) + (balls + A_m0) / 2,
                    1e-11);
    }
}

/// A tube of the mass m: m (ro^2 + ri^2)/2 about its axis, m (3 (ro^2 + ri^2) + L^2)/12 across it.
TEST(RigidInertia, OfATubeIsThatOfTheTextbooks) {
    model::Rotor rotor;
    rotor.shaft = uniform_shaft(0.3, 0.2, steel());
    rotor.shaft.segments[0].inner_start = rotor.shaft.segments[0].inner_end = 0.12;
    rotor.shaft.segments[0].elements = 2;
    const double squares = 0.1 * 0.1 + 0.06 * 0.06;
    const double mass = 7800 * std::numbers::pi * (0.1 * 0.1 - 0.06 * 0.06) * 0.3;
    for (const Inertia &inertia : {model_inertia(rotor, 4), inertia_of(rotor)}) {
        // Rounding of sums over elements.
        EXPECT_NEAR(inertia.mass / mass, 1, 1e-12);
        EXPECT_NEAR(inertia.center(), 0.15, 1e-12);
        EXPECT_NEAR(inertia.polar / (mass * squares / 2), 1, 1e-12);
        EXPECT_NEAR(inertia.diametral() / (mass * (3 * squares + 0.3 * 0.3) / 12), 1, 1e-12);
    }
}

} // namespace whirl::rigid

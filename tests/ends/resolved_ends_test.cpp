// Ends of growth of rotors with a drive that reaches every frequency: those of motions that the
// elements resolve, on meshes of several orders.

#include "analyses/stability.h"
#include "assembly/planar_part.h"
#include "ends/resolved_reach.h"
#include "modes/form_matrices.h"
#include "support/scenes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace resolved_ends {

using namespace whirl;

/// A disc aside of the middle of a shaft under an axial torque that does work on its ends.
model::Case twisted(int order) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.5, 0.03, tests::steel());
    scene.rotor.shaft.segments.push_back(scene.rotor.shaft.segments.front());
    scene.rotor.shaft.order = order;
    scene.rotor.shaft.axial_torque = 2000;
    scene.rotor.shaft.torque_kind = model::TorqueKind::axial;
    scene.rotor.discs = {tests::disc_at(0.3, 8, 0.03, 0.05)};
    for (const double z : {0.0, 1.0}) {
        scene.rotor.bearings.push_back(tests::isotropic_bearing(z, 1e7, 800));
        scene.rotor.bearings.back().rows[0].k(1, 1) = 2e7;
    }
    scene.speeds = model::SpeedRange{0, 1500, 6};
    return scene;
}

TEST(ResolvedEnds, AreTheSameOnMeshesThatResolveThem) {
    const results::StabilityResult coarse = analyses::stability(twisted(4), {});
    const results::StabilityResult fine = analyses::stability(twisted(8), {});
    ASSERT_TRUE(coarse.resolved_up_to && fine.resolved_up_to);
    EXPECT_GT(*fine.resolved_up_to, *coarse.resolved_up_to);
    ASSERT_FALSE(coarse.ends.empty());
    ASSERT_EQ(coarse.ends.size(), fine.ends.size());
    for (std::size_t i = 0; i < coarse.ends.size(); ++i) {
        const results::StabilityEnd &a = coarse.ends[i];
        const results::StabilityEnd &b = fine.ends[i];
        ASSERT_TRUE(a.resolved.error && b.resolved.error);
        EXPECT_LE(std::abs(a.speed - b.speed), *a.resolved.error + *b.resolved.error);
        EXPECT_LE(*b.resolved.error, 1e-6 * b.speed);
        EXPECT_EQ(a.growing_below, b.growing_below);
        EXPECT_EQ(a.growing_above, b.growing_above);
        EXPECT_LE(*a.frequency, *coarse.resolved_up_to);
    }
    ASSERT_FALSE(fine.unresolved_ends.empty());
    for (const results::StabilityEnd &end : fine.unresolved_ends)
        EXPECT_GT(*end.frequency, *fine.resolved_up_to);
    for (std::size_t i = 0; i < fine.speeds.size(); ++i) // the growth of all is no less
        EXPECT_LE(fine.resolved_growth[i], fine.growth[i] * (1 + 1e-9));
}

/// The same with a finer mesh, a smaller torque and bearings that damp all but the fastest motions,
/// at one speed.
model::Case lightly_twisted(int order, double speed) {
    model::Case scene = twisted(order);
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements = 2;
    scene.rotor.shaft.axial_torque = 200;
    scene.speeds = model::SpeedRange{speed, speed, 1};
    return scene;
}

/// Largest real part of the motions with |l| up to `top`, 1/s, by the eigenvalues of the equations
/// of first order: of fast motions they know the real parts as sharply as of slow ones.
double growth_of_all(const model::Case &scene, double speed,
                     double top = std::numeric_limits<double>::infinity()) {
    const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
    const modes::QuadraticAt p = modes::FormMatrices(d, results::Form::general, {}).at(speed);
    const Eigen::VectorXd scale = Eigen::VectorXd(p.M.diagonal()).cwiseSqrt().cwiseInverse();
    const auto scaled = [&scale](const Eigen::SparseMatrix<double> &A) -> Eigen::MatrixXd {
        return scale.asDiagonal() * Eigen::MatrixXd(A) * scale.asDiagonal();
    };
    const Eigen::LLT<Eigen::MatrixXd> root(scaled(p.M));
    const auto reduced = [&](const Eigen::SparseMatrix<double> &A) -> Eigen::MatrixXd {
        return root.matrixL().solve(root.matrixL().solve(scaled(A)).transpose().eval()).transpose();
    };
    const Eigen::MatrixXd K = reduced(p.K);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> own((K + K.transpose()) / 2);
    const Eigen::VectorXd w = own.eigenvalues().cwiseSqrt(); // velocities over w are deflections
    const Eigen::MatrixXd &V = own.eigenvectors();
    const Eigen::Index n = w.size();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n) = w.asDiagonal();
    A.bottomLeftCorner(n, n) = -(V.transpose() * K * V) * w.cwiseInverse().asDiagonal();
    A.bottomRightCorner(n, n) = -(V.transpose() * reduced(p.D) * V);
    double most = -std::numeric_limits<double>::infinity();
    for (const std::complex<double> &value : A.eigenvalues())
        if (std::abs(value) <= top)
            most = std::max(most, value.real());
    return most;
}

TEST(ResolvedEnds, FastMotionsThatGrowAreFoundAtEverySpeed) {
    model::Case scene = lightly_twisted(3, 0);
    scene.rotor.shaft.axial_torque = 100;
    scene.speeds = model::SpeedRange{0, 1500, 4};
    const results::StabilityResult result = analyses::stability(scene, {});
    ASSERT_EQ(result.unresolved_growth.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(result.verdict[i], results::Verdict::unstable) << i;
        EXPECT_NEAR(result.unresolved_growth[i] / growth_of_all(scene, result.speeds[i]), 1, 1e-4);
        EXPECT_EQ(result.growth[i], result.unresolved_growth[i]);
    }
    EXPECT_EQ(result.unstable, (std::vector<results::Interval>{{0, 1500}}));
}

TEST(ResolvedEnds, VerdictsOnResolvedMotionsAreThoseOfEveryOrder) {
    for (const double speed : {0.0, 450.0}) {
        const auto exact = analyses::stability(lightly_twisted(8, speed), {});
        for (const int order : {2, 4}) {
            const auto result = analyses::stability(lightly_twisted(order, speed), {});
            EXPECT_EQ(result.resolved_verdict, exact.resolved_verdict) << order << " " << speed;
            EXPECT_NEAR(result.resolved_growth.front() / exact.resolved_growth.front(), 1, 0.01);
        }
    }
    const model::Case fine = lightly_twisted(12, 450);
    const auto result = analyses::stability(fine, {});
    EXPECT_EQ(result.resolved_verdict.front(), results::Verdict::unstable);
    EXPECT_NEAR(result.unresolved_growth.front() / growth_of_all(fine, 450), 1, 1e-4);
}

TEST(ResolvedEnds, BandsAndVerdictsTellOneStory) {
    model::Case scene = lightly_twisted(6, 0);
    scene.rotor.shaft.axial_torque = 20;
    scene.speeds = model::SpeedRange{0, 1500, 6};
    const results::StabilityResult result = analyses::stability(scene, {});
    const auto inside = [](const auto &bands, double speed) {
        return std::any_of(bands.begin(), bands.end(), [speed](const auto &band) {
            return speed >= band.from && speed <= band.to;
        });
    };
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        EXPECT_EQ(result.growth[i] > 0, inside(result.unstable, result.speeds[i])) << i;
        EXPECT_EQ(result.resolved_growth[i] > 0, inside(result.resolved_unstable, result.speeds[i]))
            << i;
    }
}

/// A shaft without inertia against tilting, whose mass matrix is singular.
TEST(ResolvedEnds, TheReachKnowsUnknownsWithoutMass) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.02, tests::steel());
    rotor.shaft.order = 8;
    rotor.shaft.rotary_inertia = false;
    rotor.bearings = {tests::isotropic_bearing(0, 1e7), tests::isotropic_bearing(1, 1e7)};
    const double without = ends::resolved_up_to(assembly::Discretization(rotor, 8), nullptr, 0);
    rotor.shaft.rotary_inertia = true;
    const double with = ends::resolved_up_to(assembly::Discretization(rotor, 8), nullptr, 0);
    EXPECT_NEAR(without / with, 1, 0.1); // a slender shaft
}

/// A shaft on few shapes with a seal of negative damping: its resolved motions grow as those of
/// the whole rotor; of faster ones it is only known where one was found to grow.
TEST(ResolvedEnds, RotorsOnFewShapesHaveAReach) {
    model::Case scene = twisted(4);
    scene.rotor.shaft.axial_torque = 0;
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements = 3;
    scene.rotor.bearings.push_back(tests::isotropic_bearing(0.4, 1e5, -50));
    scene.rotor.bearings.back().seal = true;
    scene.speeds = model::SpeedRange{0, 600, 4};
    const results::StabilityResult few = analyses::stability(scene, {});
    scene.reduction = false;
    const results::StabilityResult whole = analyses::stability(scene, {});
    ASSERT_TRUE(few.resolved_up_to && whole.resolved_up_to);
    EXPECT_NEAR(*few.resolved_up_to / *whole.resolved_up_to, 1, 0.01); // the next mode differs
    EXPECT_GT(*few.resolved_up_to, 1200);
    ASSERT_EQ(few.resolved_growth.size(), whole.resolved_growth.size());
    EXPECT_EQ(few.resolved_verdict, whole.resolved_verdict);
    for (std::size_t i = 0; i < few.growth.size(); ++i) {
        EXPECT_NEAR(few.resolved_growth[i], whole.resolved_growth[i],
                    1e-6 * std::abs(whole.resolved_growth[i]));
        EXPECT_FALSE(std::isnan(whole.unresolved_growth[i])); // the whole rotor knows all
        EXPECT_EQ(few.verdict[i],
                  few.growth[i] > 0 ? results::Verdict::unstable : results::Verdict::unknown);
    }
}

/// A spindle whose rear bearing pushes: few shapes hit its fast motions roughly, and growth was
/// that of a slower one; how the resolved ones die out was told up to a bound by the largest speed.
TEST(ResolvedEnds, GrowthIsThatOfTheWholeRotorOnFewShapesInEveryRange) {
    model::Case scene;
    model::Rotor &rotor = scene.rotor;
    rotor.shaft = tests::uniform_shaft(0.06, 0.04, tests::steel());
    rotor.shaft.segments.resize(6, rotor.shaft.segments.front());
    rotor.shaft.order = 5;
    rotor.discs = {tests::disc_at(0.36, 1.9, 2.2e-3, 4.1e-3),
                   tests::disc_at(0.18, 2.4, 4e-3, 3e-3)};
    rotor.bearings = {tests::bearing(0.06, 4e7, 3.1e7, 0, 120),
                      tests::bearing(0.3, 9e7, 5.5e7, 0, 220)};
    rotor.bearings[0].rows[0].c(0, 0) = -20;
    for (const double to : {300., 7000.}) {
        scene.speeds = model::SpeedRange{0, to, 4};
        const results::StabilityResult result = analyses::stability(scene, {});
        ASSERT_TRUE(result.resolved_up_to);
        for (std::size_t i = 0; i < 4; ++i) {
            const double exact = growth_of_all(scene, result.speeds[i], *result.resolved_up_to);
            EXPECT_NEAR(result.resolved_growth[i], exact, 1e-5 * std::abs(exact)) << to << " " << i;
        }
    }
}

TEST(ResolvedEnds, AreAllWhereNothingDrivesEveryFrequency) {
    model::Case scene = twisted(4);
    scene.rotor.shaft.torque_kind = model::TorqueKind::semitangential;
    scene.rotor.shaft.internal_damping = 1e-4;
    const results::StabilityResult result = analyses::stability(scene, {});
    EXPECT_FALSE(result.resolved_up_to);
    EXPECT_FALSE(result.ends.empty());
    EXPECT_TRUE(result.unresolved_ends.empty());
    EXPECT_TRUE(result.resolved_growth.empty());
}

/// A slender beam that is all but pinned: w = (k pi / L)^2 sqrt(EI / rho A).
TEST(ResolvedEnds, TheModesBelowTheReachAreKnownToAPercent) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1, 0.002, tests::steel());
    rotor.bearings = {tests::isotropic_bearing(0, 1e9), tests::isotropic_bearing(1, 1e9)};
    const model::Material steel = tests::steel();
    const double unit = std::pow(std::numbers::pi, 2) * std::sqrt(steel.E / steel.rho) * 0.002 / 4;
    for (const int order : {3, 5, 8}) {
        rotor.shaft.order = order;
        const assembly::Discretization d(rotor, order);
        const double reach = ends::resolved_up_to(d, nullptr, 0);
        const assembly::PlanarPair pair = assembly::planar_pair(d, 0);
        const Eigen::VectorXd own = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                        Eigen::MatrixXd(pair.K), Eigen::MatrixXd(pair.M))
                                        .eigenvalues()
                                        .cwiseSqrt();
        Eigen::Index k = 0;
        for (; own(k) < reach; ++k)
            EXPECT_NEAR(own(k) / (unit * std::pow(k + 1, 2)), 1, 0.01) << order;
        EXPECT_GE(k, 1) << order;
        EXPECT_GT(own(k) / (unit * std::pow(k + 1, 2)), 1 + 0.5 * 0.01) << order; // not known
    }
}

} // namespace resolved_ends

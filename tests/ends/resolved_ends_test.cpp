// Ends of growth of rotors with a drive that reaches every frequency: those of motions that the
// elements resolve, on meshes of several orders.

#include "analyses/stability.h"
#include "ends/resolved_reach.h"
#include "reduction/planar_pair.h"
#include "support/scenes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
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
        const reduction::PlanarPair pair = reduction::planar_pair(d, 0);
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

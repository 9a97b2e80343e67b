#include "assembly/discretization.h"
#include "assembly/system.h"
#include "support/test_rotors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using assembly::Discretization;

double value_of(const assembly::Combination &combination, const Eigen::VectorXd &unknowns) {
    double sum = 0;
    for (const auto &[unknown, factor] : combination)
        sum += factor * unknowns(unknown);
    return sum;
}

TEST(Discretization, FreeRotorMeetsNoForceInRigidMotions) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    rotor.bearings.clear();
    rotor.shaft.segments[0].outer_start = 0.04;
    for (const int order : {1, 2, 6, 10}) {
        for (const int refinement : {1, 7}) {
            const Discretization d(rotor, order, refinement);
            const Eigen::MatrixXd K(assembly::assemble_planar(d, 0).K.view());
            for (const bool tilt : {false, true}) {
                const Eigen::VectorXd r = d.rigid_motion(tilt);
                EXPECT_LT((K * r).norm(), 1e-14 * (K.cwiseAbs() * r.cwiseAbs()).norm());
            }
        }
    }
}

/// Mass, first moment and inertias about z = 0 of the two-disc rotor, from its drawing.
TEST(Discretization, RigidMotionsMeetTheInertiaOfTheRotor) {
    const double A = std::numbers::pi * 0.0025 / 4;
    const double shaft = 7810 * A * 1.5;
    const double mass = shaft + 32.58972765 + 51.52526111;
    const double moment = shaft * 0.75 + 32.58972765 * 0.5 + 51.52526111;
    const double section = 7810 * A * 0.0025 / 16 * 1.5; // rho I L
    const double Id = shaft * 1.5 * 1.5 / 3 + section + 32.58972765 * 0.25 + 0.178089283 +
                      51.52526111 + 0.423580584;
    const double Ip = 2 * section + 0.329563621 + 0.805082205;
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    for (const bool rigid : {false, true}) {
        for (const int order : {1, 4, 10}) {
            rotor.shaft.rigid = rigid;
            const Discretization d(rotor, order);
            const assembly::PlanarSystem s = assembly::assemble_planar(d, 0);
            const Eigen::VectorXd t = d.rigid_motion(false);
            const Eigen::VectorXd r = d.rigid_motion(true);
            EXPECT_NEAR(t.dot(s.M.view() * t), mass, 1e-13 * mass);
            EXPECT_NEAR(r.dot(s.M.view() * t), moment, 1e-13 * moment);
            EXPECT_NEAR(r.dot(s.M.view() * r), Id, 1e-13 * Id);
            EXPECT_NEAR(r.dot(s.G.view() * r), Ip, 1e-13 * Ip);
            // Bearings of 1e6 N/m at 0 and 1.5 m.
            EXPECT_NEAR(t.dot(s.K.view() * t), 2e6, 1e-3);
            EXPECT_NEAR(r.dot(s.K.view() * r), 2.25e6, 1e-3);
        }
    }
    rotor.shaft.rigid = true;
    EXPECT_EQ(Discretization(rotor, 4).planar_size(), 2);
}

TEST(Discretization, DeflectionsAndSlopesOfRigidMotionsAreThoseOfTheLine) {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6);
    rotor.bearings[1].pedestal = model::Pedestal{1, 1e6, 0};
    for (const bool rigid : {false, true}) {
        rotor.shaft.rigid = rigid;
        const Discretization d(rotor, 5, 2);
        const Eigen::VectorXd r = d.rigid_motion(true);
        EXPECT_NEAR(value_of(d.deflection_at(1.0), r), 1.0, 1e-14);
        EXPECT_NEAR(value_of(d.slope_at(1.0), r), 1.0, 1e-14);
        const mesh::Span &span = d.shaft_mesh().spans[3];
        EXPECT_NEAR(value_of(d.deflection_inside(3, 0.3), r), span.z + 0.3 * span.length, 1e-14);
        EXPECT_NEAR(r(d.pedestal_unknown(1)), 1.5, 1e-14);
    }
}

TEST(Discretization, CountsItsUnknowns) {
    const model::Rotor rotor = tests::two_disc_rotor(1e6, 1e6); // 3 spans, 4 nodes
    EXPECT_EQ(Discretization(rotor, 1).planar_size(), 8);
    EXPECT_EQ(Discretization(rotor, 10).planar_size(), 8 + 3 * 19);
    EXPECT_EQ(Discretization(rotor, 1, 16).planar_size(), 2 * 49);
    const Discretization d(rotor, 2);
    EXPECT_EQ(d.beam_unknowns(1), (std::vector<int>{5, 6, 10, 11, 7, 8, 9}));
}

} // namespace

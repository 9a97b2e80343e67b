// Shafts under axial torque: critical torques in closed form (theory.md, "Axial torque").

#include "analyses/response.h"
#include "analyses/stability.h"
#include "assembly/system.h"
#include "modes/formulation.h"
#include "support/scenes.h"
#include "support/test_rotors.h"
#include "verification/spectrum_of.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace {

using namespace whirl;
using model::TorqueKind;
using results::Form;

constexpr double length = 1;
constexpr double diameter = 1e-3;
/// N m2. Slenderness 1000: shear takes 1e-6 of it.
const double EI = 211e9 * std::numbers::pi / 64 * std::pow(diameter, 4);

/// Ends held by springs 1e8 times as stiff as the shaft, clamped or free to tilt.
model::Rotor held(bool clamped) {
    model::Rotor rotor = tests::uniform_shaft(length, diameter, 3);
    for (const double z : {0.0, length}) {
        rotor.bearings.push_back(tests::bearing(z, 1e6, 1e6));
        if (clamped)
            rotor.bearings.back().rows[0].kt = 1e6 * Eigen::Matrix2d::Identity();
    }
    return rotor;
}

/// Least modulus of the eigenvalues of K0^-1 K: 1 without torque, 0 where the shaft buckles.
double what_is_left(model::Rotor rotor, double torque, TorqueKind kind, int order = 8) {
    const auto stiffness = [&rotor, order] {
        const assembly::Discretization d(rotor, order);
        return Eigen::MatrixXd(assembly::assemble_fixed(d, 0).K.view());
    };
    const Eigen::MatrixXd without = stiffness();
    rotor.shaft.axial_torque = torque;
    rotor.shaft.torque_kind = kind;
    const Eigen::MatrixXd ratio = without.partialPivLu().solve(stiffness());
    return ratio.eigenvalues().cwiseAbs().minCoeff();
}

/// Shear, and rounding over the springs: some 1e-6 each.
constexpr double gone = 2e-5;

void expect_critical(bool clamped, TorqueKind kind, double critical) {
    const double torque = critical * EI / length;
    EXPECT_LT(what_is_left(held(clamped), torque, kind), gone);
    EXPECT_LT(what_is_left(held(clamped), -torque, kind), gone);
    for (const double share : {0.5, 0.9, 0.98}) // none below
        EXPECT_GT(what_is_left(held(clamped), share * torque, kind), 500 * gone) << share;
}

/// Greenhill 1883: 2 pi EI/l where the torque stays along z or along the tangent.
TEST(AxialTorque, BucklesAPinnedShaftAtGreenhillsTorque) {
    expect_critical(false, TorqueKind::axial, 2 * std::numbers::pi);
    expect_critical(false, TorqueKind::tangential, 2 * std::numbers::pi);
}

/// tan(T l/2EI) = -T l/6EI, from w = a + b z + c z^2 + d exp(i T z/EI), w and EI w'' - i T w'/2
/// zero at both ends.
TEST(AxialTorque, BucklesAPinnedShaftEarlierWhereItIsSemitangential) {
    const double s = 2.45564386287944;
    ASSERT_NEAR(std::tan(s), -s / 3, 1e-13);
    expect_critical(false, TorqueKind::semitangential, 2 * s);
}

/// tan(T l/2EI) = T l/2EI, whatever the torque does at ends that do not tilt (Ziegler 1968).
TEST(AxialTorque, BucklesAClampedShaftAtOneTorqueOfAnyKind) {
    const double s = 4.493409457909064;
    for (const TorqueKind kind :
         {TorqueKind::axial, TorqueKind::semitangential, TorqueKind::tangential})
        expect_critical(true, kind, 2 * s);
}

TEST(AxialTorque, OfTheClassicalElementConverges) {
    model::Rotor rotor = held(false);
    rotor.shaft.segments[0].elements = 40;
    const double critical = 2 * std::numbers::pi * EI / length;
    // As h^2 of the pieces of a full wave: (2 pi/40)^2/12 = 2e-3.
    EXPECT_LT(what_is_left(rotor, critical, TorqueKind::axial, 1), 3e-3);
}

model::Rotor twisted(TorqueKind kind, double torque) {
    model::Rotor rotor = tests::two_disc_rotor(1e7, 1e7, 0, 500);
    rotor.shaft.axial_torque = torque;
    rotor.shaft.torque_kind = kind;
    return rotor;
}

TEST(AxialTorque, IsTheSameInFixedAndRotatingAxes) {
    for (const TorqueKind kind :
         {TorqueKind::axial, TorqueKind::semitangential, TorqueKind::tangential}) {
        model::Case scene;
        scene.rotor = twisted(kind, 5e4);
        EXPECT_EQ(modes::choose_formulation(scene).form, Form::general);
        const auto fixed = modes::SpectrumSolver(scene.rotor, Form::general, 4).at(250, 6).modes;
        const auto turning = modes::SpectrumSolver(scene.rotor, Form::rotating, 4).at(250, 6).modes;
        ASSERT_EQ(fixed.size(), turning.size());
        for (std::size_t i = 0; i < fixed.size(); ++i) // rounding of some fifty unknowns
            EXPECT_LT(std::abs(fixed[i].eigenvalue - turning[i].eigenvalue),
                      1e-8 * std::abs(fixed[i].eigenvalue));
    }
}

/// Seen in a mirror spin and torque turn the other way.
TEST(AxialTorque, HasAMirrorImage) {
    const auto modes = [](double torque, double speed) {
        return modes::SpectrumSolver(twisted(TorqueKind::axial, torque), Form::general, 4)
            .at(speed, 6)
            .modes;
    };
    const auto one = modes(5e4, 250);
    const auto mirror = modes(-5e4, -250);
    const auto other = modes(-5e4, 250);
    ASSERT_EQ(one.size(), mirror.size());
    double difference = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double size = std::abs(one[i].eigenvalue);
        EXPECT_LT(std::abs(one[i].eigenvalue - mirror[i].eigenvalue), 1e-8 * size);
        difference = std::max(difference, std::abs(one[i].eigenvalue - other[i].eigenvalue) / size);
    }
    EXPECT_GT(difference, 1e-4); // it does matter
}

/// A torque with a potential leaves frequencies real.
TEST(AxialTorque, ThatIsSemitangentialNeitherDrivesNorDamps) {
    model::Rotor rotor = twisted(TorqueKind::semitangential, 5e4);
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows[0].c.setZero();
    const auto modes = modes::SpectrumSolver(rotor, Form::general, 4).at(250, 6).modes;
    ASSERT_FALSE(modes.empty());
    for (const modes::WhirlMode &mode : modes)
        EXPECT_LT(std::abs(mode.eigenvalue.real()), 1e-9 * std::abs(mode.eigenvalue));
}

TEST(AxialTorque, IsInTheResponse) {
    model::Case scene;
    scene.rotor = twisted(TorqueKind::axial, 5e4);
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-4)};
    scene.speeds = model::SpeedRange{20, 400, 5};
    const auto with = analyses::unbalance_response(scene);
    scene.rotor.shaft.axial_torque = 0;
    const auto without = analyses::unbalance_response(scene);
    double difference = 0;
    for (std::size_t n = 0; n < with.nodes.size(); ++n)
        for (std::size_t i = 0; i < with.speeds.size(); ++i) {
            EXPECT_LT(with.nodes[n].error[i], 1e-5); // order 4 against 8
            difference = std::max(difference,
                                  std::abs(with.nodes[n].major[i] / without.nodes[n].major[i] - 1));
        }
    EXPECT_GT(difference, 1e-3);
}

/// Only bending makes the torque do anything.
TEST(AxialTorque, DoesNothingToARigidShaft) {
    model::Rotor rotor = twisted(TorqueKind::axial, 5e4);
    rotor.shaft.rigid = true;
    const auto with = modes::SpectrumSolver(rotor, Form::general, 1).at(100, 4).modes;
    rotor.shaft.axial_torque = 0;
    const auto without = modes::SpectrumSolver(rotor, Form::general, 1).at(100, 4).modes;
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i)
        EXPECT_EQ(with[i].eigenvalue, without[i].eigenvalue);
}

// Ends that tilt: the work of a torque that stays along z drives an undamped shaft, one with a
// potential does not, and the note says so. With a disc off the middle the growth is far above
// rounding; of a uniform shaft it is nothing else (GrowthAndBandsTellOneStory).
TEST(AxialTorque, ThatDrivesMotionsIsNamed) {
    model::Case scene;
    scene.rotor = held(false);
    scene.rotor.shaft.segments[0].outer_start = scene.rotor.shaft.segments[0].outer_end = 0.02;
    scene.rotor.shaft.axial_torque = 6e3;
    scene.rotor.shaft.order = 6;
    scene.rotor.discs = {tests::disc(0.3, 5, 0.05, 0.09)};
    scene.speeds = model::SpeedRange{1, 1, 1};
    const auto noted = [](const results::StabilityResult &result) {
        return std::any_of(result.model.notes.begin(), result.model.notes.end(),
                           [](const std::string &note) {
                               return note.find("has no potential") != std::string::npos &&
                                      note.find("no mode grows there") != std::string::npos;
                           });
    };
    const results::StabilityResult driven = analyses::stability(scene, {});
    EXPECT_GT(driven.growth.front(), 1);
    EXPECT_TRUE(noted(driven));
    scene.rotor.shaft.torque_kind = TorqueKind::semitangential;
    const results::StabilityResult still = analyses::stability(scene, {});
    EXPECT_EQ(still.growth.front(), 0);
    EXPECT_FALSE(noted(still));
}

/// Held where they do not tilt much, half way to the critical torque: every motion keeps its size
/// without damping and dies out with it, whatever rounding makes of motions of 1e5 rad/s.
TEST(AxialTorque, GrowthAndBandsTellOneStory) {
    for (const double c : {0.0, 10.0}) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(1, 0.02, tests::steel());
        scene.rotor.shaft.order = 10;
        scene.rotor.shaft.rotary_inertia = false;
        scene.rotor.shaft.axial_torque = 6e3;
        for (const double z : {0.0, 1.0})
            scene.rotor.bearings.push_back(tests::bearing(z, 1e6, 1e6, 0, c));
        scene.speeds = model::SpeedRange{0, 400, 5};
        const results::StabilityResult result = analyses::stability(scene, {});
        for (const double growth : result.growth)
            EXPECT_TRUE(c == 0 ? growth == 0 : growth < 0) << growth;
        EXPECT_TRUE(result.unstable.empty());
        EXPECT_TRUE(result.ends.empty());
        EXPECT_TRUE(result.model.notes.empty());
    }
}

} // namespace

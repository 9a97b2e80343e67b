// Receptance and bands of damped and anisotropic rotors.

#include "analyses/balance.h"
#include "assembly/system.h"
#include "forced/forced_motion.h"
#include "results/formulation.h"
#include "support/scenes.h"
#include "synchronous/receptance.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using results::BalanceResult;
using results::Form;

model::Rotor damped_rotor(double c) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1.0, 0.06, tests::steel());
    rotor.shaft.segments[0].elements = 2;
    rotor.shaft.order = 1;
    rotor.discs = {tests::disc_at(0.3, 15, 0.08, 0.15), tests::disc_at(0.7, 20, 0.1, 0.18)};
    rotor.bearings = {tests::isotropic_bearing(0.0, 1e6, c),
                      tests::isotropic_bearing(1.0, 1.5e6, c / 2)};
    rotor.planes = {{"", 0.3}, {"", 0.6}};
    return rotor;
}

std::vector<assembly::Combination> places_of(const assembly::Discretization &d) {
    std::vector<assembly::Combination> places;
    for (const auto &plane : d.rotor().planes)
        places.push_back(d.deflection_at(plane.z));
    return places;
}

/// R column by column from the forced motion under a unit imbalance at each plane: its forward part
/// is (x + i y) / 2.
Eigen::MatrixXcd receptance_by_response(model::Rotor rotor, Form form, double speed) {
    const auto planes = rotor.planes;
    const auto n = static_cast<Eigen::Index>(planes.size());
    Eigen::MatrixXcd R(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        rotor.imbalances = {tests::imbalance_at(planes[static_cast<std::size_t>(k)].z, 1)};
        const assembly::Discretization d(rotor, 1);
        forced::ForcedMotion motion(d, form);
        motion.solve(speed);
        for (Eigen::Index j = 0; j < n; ++j) {
            const forced::Phasor u =
                motion.motion(d.deflection_at(planes[static_cast<std::size_t>(j)].z));
            R(j, k) = (u.x + std::complex<double>(0, 1) * u.y) / 2.0;
        }
    }
    return R;
}

TEST(ForwardReceptance, IsTheForcedMotionUnderUnitImbalances) {
    for (const double c : {0.0, 800.0}) {
        model::Rotor isotropic = damped_rotor(c);
        model::Rotor cross = isotropic;
        cross.bearings[0].rows[0].k << 1e6, 2e5, -1e5, 0.7e6;
        cross.bearings[1].rows[0].c << 300, 20, 10, 100;
        cross.shaft.internal_damping = 1e-5;
        for (const auto &[rotor, form] :
             {std::pair(isotropic, Form::planar), std::pair(cross, Form::general)}) {
            const assembly::Discretization d(rotor, 1);
            synchronous::ForwardReceptance receptance(d, form, places_of(d));
            for (const double speed : {50.0, 220.0, 410.0, 1500.0}) {
                const Eigen::MatrixXcd expected = receptance_by_response(rotor, form, speed);
                // Two factorisations of matrices of condition 1e6 at most.
                EXPECT_LT((receptance.at(speed) - expected).norm(), 1e-9 * expected.norm())
                    << speed;
            }
        }
    }
}

TEST(ForwardReceptance, EqualBearingsInXAndYGiveThePlanarValue) {
    const model::Rotor rotor = damped_rotor(500);
    const assembly::Discretization d(rotor, 1);
    synchronous::ForwardReceptance planar(d, Form::planar, places_of(d));
    synchronous::ForwardReceptance general(d, Form::general, places_of(d));
    for (const double speed : {50.0, 220.0, 410.0, 1500.0}) {
        const Eigen::MatrixXcd R = planar.at(speed);
        EXPECT_LT((general.at(speed) - R).norm(), 1e-10 * R.norm()) << speed;
    }
}

TEST(ForwardReceptance, InternalDampingDropsOutWithIsotropicBearings) {
    model::Rotor rotor = damped_rotor(500);
    const assembly::Discretization plain(rotor, 1);
    rotor.shaft.internal_damping = 1e-4;
    const assembly::Discretization inside(rotor, 1);
    synchronous::ForwardReceptance without(plain, Form::planar, places_of(plain));
    synchronous::ForwardReceptance with(inside, Form::general, places_of(inside));
    for (const double speed : {50.0, 410.0, 1500.0}) {
        const Eigen::MatrixXcd R = without.at(speed);
        EXPECT_LT((with.at(speed) - R).norm(), 1e-9 * R.norm()) << speed;
    }
}

/// All speeds at which Re(B^T Z^-1 B) of a damped rotor is singular, one plane: with
/// Z u = B s, u = a + i b, the real bordered matrix [P -Q B; Q P 0; B^T 0 0] with P = K - W^2 A,
/// Q = W C is singular there; its real positive eigenvalues W.
std::vector<double> sign_changes(const assembly::Discretization &d, double from, double to) {
    const assembly::PlanarSystem system = assembly::assemble_planar(d, 0);
    const assembly::FixedSystem fixed = assembly::assemble_fixed(d, 0);
    const int n = d.planar_size();
    const Eigen::MatrixXd K = Eigen::MatrixXd(system.K.view());
    const Eigen::MatrixXd A = Eigen::MatrixXd(system.M.view()) - Eigen::MatrixXd(system.G.view());
    const Eigen::MatrixXd C =
        Eigen::MatrixXd(fixed.C.view())(Eigen::seqN(0, n, 2), Eigen::seqN(0, n, 2));
    const int size = 2 * n + 1;
    Eigen::MatrixXd A0 = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd A1 = A0;
    Eigen::MatrixXd A2 = A0;
    const double unit = 300; // speeds in this unit
    const double stiffness = 1e6;
    A0.topLeftCorner(n, n) = A0.block(n, n, n, n) = K / stiffness;
    A1.block(0, n, n, n) = -C * unit / stiffness;
    A1.block(n, 0, n, n) = C * unit / stiffness;
    A2.topLeftCorner(n, n) = A2.block(n, n, n, n) = -A * unit * unit / stiffness;
    for (const auto &[unknown, value] : d.deflection_at(d.rotor().planes[0].z))
        A0(unknown, 2 * n) = A0(2 * n, unknown) = value;
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(2 * size, 2 * size);
    Eigen::MatrixXd right = left;
    left.topLeftCorner(size, size) = A0;
    left.bottomRightCorner(size, size).setIdentity();
    right.topLeftCorner(size, size) = -A1;
    right.topRightCorner(size, size) = -A2;
    right.bottomLeftCorner(size, size).setIdentity();
    // Of 1/W: the left matrix, with K and the border, has an inverse; the right one has none.
    const Eigen::MatrixXd inverted = left.partialPivLu().solve(right);
    const Eigen::VectorXcd reciprocals = inverted.eigenvalues();
    std::vector<double> speeds;
    for (Eigen::Index i = 0; i < 2 * size; ++i) {
        const std::complex<double> W = unit / reciprocals[i];
        if (std::abs(W.imag()) < 1e-7 * std::abs(W) && W.real() > from && W.real() < to)
            speeds.push_back(W.real());
    }
    std::sort(speeds.begin(), speeds.end());
    return speeds;
}

TEST(Balance, BandEndsOfADampedRotorAreAllRealRootsOfTheBorderedProblem) {
    int narrow = 0;
    for (const double c : {2.0, 50.0, 400.0, 3000.0, 1e5})
        for (const double z : {0.1, 0.3, 0.44, 0.6, 0.95}) {
            model::Case scene;
            scene.rotor = damped_rotor(c);
            scene.rotor.planes = {{"", z}};
            scene.speeds = model::SpeedRange{0, 6000, 25};
            const BalanceResult result = analyses::balance(scene);
            EXPECT_FALSE(result.sharp);
            const assembly::Discretization d(scene.rotor, 1);
            const std::vector<double> expected = sign_changes(d, 1, 6000);
            const auto &ends = result.planes[0].bands.ends;
            ASSERT_EQ(ends.size(), expected.size()) << "c = " << c << ", z = " << z;
            for (std::size_t i = 0; i < ends.size(); ++i)
                EXPECT_NEAR(ends[i].speed / expected[i], 1, 1e-7) // the QZ method's rounding
                    << "c = " << c << ", z = " << z;
            for (std::size_t i = 1; i < ends.size(); ++i)
                narrow += ends[i].speed / ends[i - 1].speed < 1.05 ? 1 : 0;
        }
    EXPECT_GT(narrow, 2); // the search was not only for wide bands
}

TEST(Balance, LittleDampingChangesLittle) {
    model::Case scene;
    scene.rotor = damped_rotor(0);
    scene.speeds = model::SpeedRange{0, 2500, 26};
    const BalanceResult sharp = analyses::balance(scene);
    scene.rotor = damped_rotor(1e-3);
    const BalanceResult soft = analyses::balance(scene);
    EXPECT_TRUE(sharp.sharp);
    EXPECT_FALSE(soft.sharp);
    ASSERT_EQ(soft.joint.bands.ends.size(), sharp.joint.bands.ends.size());
    for (std::size_t i = 0; i < soft.joint.bands.ends.size(); ++i)
        EXPECT_NEAR(soft.joint.bands.ends[i].speed / sharp.joint.bands.ends[i].speed, 1, 1e-5);
}

TEST(Balance, BearingsThatDifferInXAndYUndamped) {
    // Both paths to the bands, by critical speeds and by sampling (a trace of damping), agree.
    model::Case scene;
    scene.rotor = damped_rotor(0);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].k(1, 1) *= 0.8;
    scene.speeds = model::SpeedRange{0, 2500, 26};
    const BalanceResult sharp = analyses::balance(scene);
    scene.rotor.bearings[0].rows[0].c = 1e-4 * Eigen::Matrix2d::Identity();
    const BalanceResult sampled = analyses::balance(scene);
    EXPECT_TRUE(sharp.sharp);
    for (std::size_t plane = 0; plane < 2; ++plane) {
        const auto &a = sharp.planes[plane].bands.ends;
        const auto &b = sampled.planes[plane].bands.ends;
        ASSERT_EQ(a.size(), b.size());
        EXPECT_GE(a.size(), 5U); // split critical speeds make more bands
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_NEAR(a[i].speed / b[i].speed, 1, 1e-6);
    }
}

TEST(Balance, ConstantBearingTablesAreOrdinaryBearings) {
    model::Case scene;
    scene.rotor = damped_rotor(200);
    scene.speeds = model::SpeedRange{0, 2500, 26};
    const BalanceResult plain = analyses::balance(scene);
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.speeds = {0, 1000, 2500};
        bearing.rows.assign(3, bearing.rows[0]);
    }
    const BalanceResult table = analyses::balance(scene);
    for (std::size_t plane = 0; plane < 2; ++plane) {
        const auto &a = plain.planes[plane].bands.ends;
        const auto &b = table.planes[plane].bands.ends;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_NEAR(a[i].speed / b[i].speed, 1, 1e-10);
    }
}

} // namespace

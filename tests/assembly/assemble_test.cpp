// The assembly loops: the same entries in a dense matrix as in PETSc's, and what they must obey.

#include "assembly/system.h"
#include "support/test_rotors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace {

using namespace whirl;
using assembly::Term;

/// Everything at once: cone, bore, discs, full bearings, tilt coefficients, pedestal, internal
/// damping, axial force.
model::Rotor rotor_with_everything() {
    model::Rotor rotor = tests::two_disc_rotor(1e6, 0.8e6, 3e5, 200);
    rotor.shaft.segments[1].outer_end = 0.07;
    rotor.shaft.segments[2].inner_start = rotor.shaft.segments[2].inner_end = 0.02;
    rotor.shaft.internal_damping = 1e-5;
    rotor.shaft.axial_force = 2e4;
    rotor.bearings[0].rows[0].kt << 1e4, 0, 0, 2e4;
    rotor.bearings[0].rows[0].ct << 3, 1, -1, 4;
    rotor.bearings[1].pedestal = model::Pedestal{5, 1e7, 100};
    return rotor;
}

Eigen::MatrixXd dense(const linalg::Matrix &A) { return Eigen::MatrixXd(A.view()); }

/// The real form filled into dense matrices by the loops of assemble.h.
std::map<Term, Eigen::MatrixXd> dense_real_form(const assembly::Discretization &d, double speed) {
    const Eigen::Index n = 2 * d.planar_size();
    std::map<Term, Eigen::MatrixXd> sum;
    for (const Term term :
         {Term::mass, Term::damping, Term::gyroscopic, Term::stiffness, Term::circulatory})
        sum[term] = Eigen::MatrixXd::Zero(n, n);
    assembly::assemble_rotating_parts(
        d, [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
            const bool couples = term == Term::gyroscopic || term == Term::circulatory;
            for (std::size_t i = 0; i < unknowns.size(); ++i)
                for (std::size_t j = 0; j < unknowns.size(); ++j) {
                    const int x = 2 * unknowns[i];
                    const int column = 2 * unknowns[j];
                    const double v = block(static_cast<int>(i), static_cast<int>(j));
                    sum[term](x, couples ? column + 1 : column) += v;
                    sum[term](x + 1, couples ? column : column + 1) += couples ? -v : v;
                }
        });
    assembly::assemble_supports(d, speed,
                                [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                                    sum[term].block(2 * i, 2 * j, 2, 2) += block;
                                });
    return sum;
}

TEST(Assembly, DenseAndPetscMatricesHaveTheSameEntries) {
    for (const int order : {1, 3, 8}) {
        const assembly::Discretization d(rotor_with_everything(), order, 2);
        const assembly::FixedSystem system = assembly::assemble_fixed(d, 100);
        auto expected = dense_real_form(d, 100);
        const auto compare = [&](Term term, const linalg::Matrix &A) {
            ASSERT_GT(expected[term].norm(), 0);
            // The order of summation differs: rounding of a few terms.
            EXPECT_LE((dense(A) - expected[term]).norm(), 1e-15 * expected[term].norm());
        };
        compare(Term::mass, system.M);
        compare(Term::damping, system.C);
        compare(Term::gyroscopic, system.G);
        compare(Term::stiffness, system.K);
        compare(Term::circulatory, system.Kc);
    }
}

TEST(Assembly, RealFormIsSymmetricWhereItMustBeAndSkewWhereItMustBe) {
    const assembly::Discretization d(rotor_with_everything(), 4);
    const assembly::FixedSystem s = assembly::assemble_fixed(d, 0);
    const Eigen::MatrixXd M = dense(s.M);
    const Eigen::MatrixXd G = dense(s.G);
    const Eigen::MatrixXd Kc = dense(s.Kc);
    EXPECT_LE((M - M.transpose()).norm(), 1e-15 * M.norm());
    EXPECT_LE((G + G.transpose()).norm(), 1e-15 * G.norm());
    EXPECT_LE((Kc + Kc.transpose()).norm(), 1e-15 * Kc.norm());
    const Eigen::VectorXd unit = M.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = unit.asDiagonal() * M * unit.asDiagonal();
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues()(0), 0);
    const Eigen::MatrixXd S = dense(assembly::hyperbolic_coupling(d));
    EXPECT_LE((S - S.transpose()).norm(), 1e-15 * S.norm());
    // S and G have the same blocks, the lower one with the other sign.
    for (Eigen::Index row = 0; row < S.rows(); ++row)
        EXPECT_EQ(S.row(row), (row % 2 == 0 ? 1 : -1) * G.row(row));
}

TEST(Assembly, PlanarFormIsOnePlaneOfTheRealForm) {
    const assembly::Discretization d(tests::two_disc_rotor(1e6, 1e6), 5);
    const assembly::PlanarSystem planar = assembly::assemble_planar(d, 0);
    const assembly::FixedSystem real = assembly::assemble_fixed(d, 0);
    const Eigen::Index n = d.planar_size();
    const auto x = Eigen::seqN(0, n, 2);
    const auto y = Eigen::seqN(1, n, 2);
    const Eigen::MatrixXd K = dense(real.K);
    const Eigen::MatrixXd G = dense(real.G);
    EXPECT_EQ(K(x, y).norm(), 0);
    // Up to the order in which PETSc sums equal places.
    const auto expect_same = [](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b) {
        EXPECT_LE((a - b).norm(), 1e-15 * a.norm());
    };
    expect_same(dense(planar.K), K(x, x));
    expect_same(dense(planar.K), K(y, y));
    expect_same(dense(planar.M), dense(real.M)(x, x));
    expect_same(dense(planar.G), G(x, y));
    expect_same(dense(planar.G), -G(y, x));
}

/// alpha M + beta K of the shaft, of its bending alone: discs and bearings add nothing to it.
TEST(Assembly, DampingIsProportionalToMassAndStiffnessOfTheShaft) {
    for (const int order : {1, 4}) {
        model::Rotor rotor = tests::friswell_shaft();
        const assembly::FixedSystem shaft =
            assembly::assemble_fixed(assembly::Discretization(rotor, order), 0);
        const Eigen::MatrixXd M = dense(shaft.M);
        const Eigen::MatrixXd K = dense(shaft.K);
        rotor = tests::two_disc_rotor(1e6, 0.8e6);
        for (const auto &[alpha, beta] :
             {std::pair(3.0, 0.0), std::pair(0.0, 2e-4), std::pair(3.0, 2e-4)}) {
            rotor.shaft.alpha = alpha;
            rotor.shaft.beta = beta;
            const Eigen::MatrixXd C =
                dense(assembly::assemble_fixed(assembly::Discretization(rotor, order), 100).C);
            const Eigen::MatrixXd expected = alpha * M + beta * K;
            // Sums in another order.
            EXPECT_LE((C - expected).norm(), 1e-14 * expected.norm()) << alpha << ' ' << beta;
        }
    }
}

/// Over w = x + i y a bearing [a b; -b a] is a - i b: the x and y rows of what one column x does.
TEST(Assembly, PlanarFormOfBearingsThatCoupleIsOneColumnOfTheRealForm) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05, 2);
    rotor.bearings = {tests::bearing(0.5, 1e6, 1e6, 0, 200)};
    model::BearingCoefficients &at = rotor.bearings[0].rows[0];
    at.k << 1e6, 3e5, -3e5, 1e6;
    at.c << 200, -70, 70, 200;
    at.kt << 1e4, 2e3, -2e3, 1e4;
    const assembly::Discretization d(rotor, 3);
    const assembly::DampedPlanarSystem planar = assembly::assemble_damped_planar(d, 0);
    const assembly::FixedSystem real = assembly::assemble_fixed(d, 0);
    const Eigen::Index n = d.planar_size();
    const auto x = Eigen::seqN(0, n, 2);
    const auto y = Eigen::seqN(1, n, 2);
    const auto expect_same = [](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b) {
        ASSERT_GT(b.norm(), 0);
        EXPECT_LE((a - b).norm(), 1e-15 * b.norm()); // sums in another order
    };
    expect_same(dense(planar.K), dense(real.K)(x, x));
    expect_same(dense(planar.Kx), dense(real.K)(y, x));
    expect_same(dense(planar.C), dense(real.C)(x, x));
    expect_same(dense(planar.Cx), dense(real.C)(y, x));
}

TEST(Assembly, BearingsActAtTheirNodesWithTheirCoefficientsOfTheSpeed) {
    model::Rotor with = tests::uniform_shaft(1, 0.05, 2);
    const assembly::FixedSystem without =
        assembly::assemble_fixed(assembly::Discretization(with, 1), 0);
    model::Bearing table = tests::bearing(0.5, 1e6, 2e6, 3e5, 0);
    table.speeds = {0, 100};
    table.rows.push_back(table.rows[0]);
    table.rows[1].k *= 3;
    table.rows[1].kt << 10, 1, 2, 20;
    with.bearings = {table};
    const assembly::Discretization d(with, 1);
    const Eigen::MatrixXd added =
        dense(assembly::assemble_fixed(d, 50).K) - dense(without.K); // halfway: factor 2
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
    expected.block(4, 4, 2, 2) << 2e6, 6e5, 6e5, 4e6; // second node: unknowns 2 (w), 3 (phi)
    expected.block(6, 6, 2, 2) << 5, 0.5, 1, 10;
    EXPECT_LT((added - expected).norm(), 1e-6); // rounding of stiffnesses of 1e9
}

TEST(Assembly, PedestalStandsBetweenBearingAndGround) {
    model::Rotor rotor = tests::uniform_shaft(1, 0.05);
    rotor.bearings = {tests::bearing(0, 1e6, 2e6, 0, 30)};
    rotor.bearings[0].pedestal = model::Pedestal{4, 5e6, 70};
    const assembly::Discretization d(rotor, 1);
    ASSERT_EQ(d.planar_size(), 5);
    const assembly::FixedSystem s = assembly::assemble_fixed(d, 0);
    const int p = 2 * d.pedestal_unknown(0);
    const Eigen::MatrixXd K = dense(s.K);
    EXPECT_DOUBLE_EQ(K(p, p), 6e6);
    EXPECT_DOUBLE_EQ(K(p + 1, p + 1), 7e6);
    EXPECT_DOUBLE_EQ(K(p, 0), -1e6);
    EXPECT_DOUBLE_EQ(K(1, p + 1), -2e6);
    EXPECT_DOUBLE_EQ(dense(s.C)(p, p), 100);
    EXPECT_DOUBLE_EQ(dense(s.C)(0, p), -30);
    EXPECT_DOUBLE_EQ(dense(s.M)(p + 1, p + 1), 4);
}

/// A cantilever under the torque T and a force F at its tip: E I phi'' - i T phi' + F = 0 with
/// w' - phi = F/(kappa G A), docs/theory.md, "Axial torque"; phi and w are zero at z = 0. At the
/// tip E I phi' = share i T phi: the whole torque where it stays along z, none of it where it
/// follows the tangent.
std::complex<double> tip_of_cantilever(double F, double T, double share, double EI, double kappaGA,
                                       double l) {
    const std::complex<double> i(0, 1);
    const double tau = T / EI;
    const std::complex<double> turn = std::exp(i * tau * l);
    // phi' = -i F/T + A exp(i tau z)
    const std::complex<double> A = F / T * (share * tau * l + i) / (turn - share * (turn - 1.0));
    return -i * F * l * l / (2 * T) + A / (i * tau) * ((turn - 1.0) / (i * tau) - l) +
           F * l / kappaGA;
}

TEST(AxialTorque, BendsACantileverByWhatItDoesAtTheTip) {
    constexpr double l = 0.8;
    model::Rotor rotor = tests::uniform_shaft(l, 0.05, 2);
    rotor.shaft.shear = model::ShearFormula::given;
    rotor.shaft.shear_coefficient = 0.9;
    const double EI = 211e9 * std::numbers::pi / 64 * std::pow(0.05, 4);
    const double kappaGA = 0.9 * 81.2e9 * std::numbers::pi / 4 * 0.05 * 0.05;
    constexpr double F = 1e3;
    using Kind = model::TorqueKind;
    for (const double T : {0.7 * EI / l, -1.9 * EI / l})
        for (const auto &[kind, share] :
             {std::pair(Kind::axial, 1.0), {Kind::semitangential, 0.5}, {Kind::tangential, 0.0}}) {
            rotor.shaft.axial_torque = T;
            rotor.shaft.torque_kind = kind;
            const assembly::Discretization d(rotor, 8);
            Eigen::MatrixXd K = dense(assembly::assemble_fixed(d, 0).K);
            for (const assembly::Combination &held : {d.deflection_at_node(0), d.slope_at_node(0)})
                for (const int unknown : {2 * held.begin()->first, 2 * held.begin()->first + 1}) {
                    K.row(unknown).setZero();
                    K(unknown, unknown) = 1;
                }
            Eigen::VectorXd force = Eigen::VectorXd::Zero(K.rows());
            for (const auto &[unknown, value] : d.deflection_at(l))
                force(2 * unknown) = F * value;
            const Eigen::VectorXd q = K.partialPivLu().solve(force);
            std::complex<double> found;
            for (const auto &[unknown, value] : d.deflection_at(l))
                found += value * std::complex<double>(q(2 * unknown), q(2 * unknown + 1));
            const std::complex<double> expected = tip_of_cantilever(F, T, share, EI, kappaGA, l);
            // Polynomials of degree 8 over half of exp(2 i): 1e-10 and less; rounding of K.
            EXPECT_LT(std::abs(found / expected - 1.0), 1e-9) << share << ' ' << T;
        }
}

} // namespace

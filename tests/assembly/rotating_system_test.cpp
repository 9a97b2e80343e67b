// Constant matrices in rotating axes against the periodic ones in the fixed frame, which are
// written from the energy of single point masses (tests/support/periodic_system.h).

#include "assembly/hill_system.h"
#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "linalg/dense/products.h"
#include "support/balancer_parts.h"
#include "support/dense_eigenvalues.h"
#include "support/periodic_system.h"
#include "support/rotating_scenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace rotating_system_test {

using namespace whirl;
using Eigen::MatrixXd;

MatrixXd dense(const linalg::Matrix &matrix) { return MatrixXd(matrix.view()); }

/// Everything that can turn with a rotor, at once.
model::Rotor full_rotor() {
    model::Rotor rotor;
    rotor.shaft.segments = {tests::cylinder(0.4, 0.04), tests::cylinder(0.5, 0.05, 1, 0.01)};
    rotor.shaft.order = 3;
    rotor.shaft.segments[1].asymmetry = 0.15;
    rotor.shaft.segments[1].asymmetry_angle = 0.6;
    rotor.shaft.internal_damping = 2e-6;
    rotor.shaft.axial_force = 2e4;
    rotor.discs = {tests::disc(0.4, 20, 0.2, 0.3)};
    rotor.anisotropies = {{"", 0.4, 0.05, -0.4}};
    rotor.bearings = {tests::round_bearing(0, 3e6, 200), tests::round_bearing(0.9, 2e6, 300)};
    rotor.bearings[1].rows[0].k(0, 1) = 4e5; // the same from every direction
    rotor.bearings[1].rows[0].k(1, 0) = -4e5;
    rotor.bearings[1].rows[0].kt = 1e3 * Eigen::Matrix2d::Identity();
    rotor.bearings[0].pedestal = model::Pedestal{3, 4e6, 50};
    const tests::CompositeScene balls =
        tests::composite_scene({.imbalance = 0.05}, tests::unsymmetric_position(1.6));
    rotor.balancers = balls.rotor.balancers;
    rotor.balancers[0].z = 0.4;
    model::Balancer pendulums;
    pendulums.z = 0.9;
    tests::pendulums_of(pendulums).mass = 0.2;
    tests::pendulums_of(pendulums).arm = 0.1;
    tests::pendulums_of(pendulums).pivot = 0.03;
    tests::pendulums_of(pendulums).damping = 0.02;
    rotor.balancers.push_back(pendulums);
    return rotor;
}

struct Motion {
    MatrixXd M, D, K;
};

/// The periodic system in axes that turn with the rotor, still one unknown a moving mass.
Motion turned(const tests::PeriodicSystem &system, double time) {
    const tests::Instant f = system.at(time);
    const Eigen::Index n = system.size();
    const double W = system.speed();
    MatrixXd T = MatrixXd::Identity(n, n);
    MatrixXd J = MatrixXd::Zero(n, n); // T' = W J T on the pairs
    for (int i = 0; i < system.paired(); i += 2) {
        T.block<2, 2>(i, i) << std::cos(W * time), -std::sin(W * time), std::sin(W * time),
            std::cos(W * time);
        J.block<2, 2>(i, i) << 0, -1, 1, 0;
    }
    using linalg::times;
    using linalg::transposed_times;
    const MatrixXd rate = W * times(J, T);
    const MatrixXd second = W * times(J, rate);
    return {transposed_times(T, times(f.M, T)),
            transposed_times(T, times(f.D, T) + 2 * times(f.M, rate)),
            transposed_times(T, times(f.K, T) + times(f.D, rate) + times(f.M, second))};
}

/// From one unknown a moving mass to the means sigma: (columns, rows) of the two sides of
/// rows * one-by-one = means * columns.
std::pair<MatrixXd, MatrixXd> means(const tests::PeriodicSystem &system,
                                    const std::vector<int> &counts) {
    const int pairs = system.paired();
    const Eigen::Index reduced = pairs + 2 * std::ssize(counts);
    MatrixXd columns = MatrixXd::Zero(reduced, system.size());
    columns.topLeftCorner(pairs, pairs).setIdentity();
    MatrixXd rows = columns;
    int j = 0;
    for (std::size_t b = 0; b < counts.size(); ++b)
        for (int k = 0; k < counts[b]; ++k, ++j) {
            const double angle = system.moving()[static_cast<std::size_t>(j)].angle;
            const Eigen::Vector2d along(-std::sin(angle), std::cos(angle));
            const auto row = static_cast<Eigen::Index>(pairs + 2 * static_cast<int>(b));
            columns.block<2, 1>(row, pairs + j) = along / counts[b];
            rows.block<2, 1>(row, pairs + j) = along;
        }
    return {columns, rows};
}

TEST(RotatingSystem, EqualsThePeriodicEquationsOfSinglePointMassesEntryByEntry) {
    const model::Rotor rotor = full_rotor();
    const assembly::Discretization d(rotor, rotor.shaft.order);
    const balancers::Arrangement balls = balancers::arrangement_at_balance(rotor);
    const assembly::RotatingSystem rotating =
        assembly::assemble_rotating(d, 0, balancers::balancer_elements(rotor, balls));
    for (const double speed : {130.0, 900.0}) {
        const tests::PeriodicSystem periodic(d, speed, balls);
        const auto [columns, rows] = means(periodic, {3, 2});
        for (const double time : {0.0, 0.0021, 0.31, 5.7}) {
            const Motion one_by_one = turned(periodic, time);
            const auto compare = [&, &rows = rows, &columns = columns](const MatrixXd &single,
                                                                       const MatrixXd &mean) {
                // Rounding of sums of numbers as large as the largest of the matrix.
                const double size = mean.cwiseAbs().maxCoeff();
                EXPECT_LT((rows * single - mean * columns).cwiseAbs().maxCoeff(), 1e-13 * size);
            };
            compare(one_by_one.M, dense(rotating.M));
            compare(one_by_one.D, dense(rotating.damping(speed)));
            compare(one_by_one.K, dense(rotating.stiffness(speed)));
        }
    }
}

TEST(RotatingSystem, RigidAsymmetricSegmentTurnsItsRotaryInertia) {
    model::Rotor rotor = full_rotor();
    rotor.shaft.rigid = true;
    rotor.balancers.clear();
    const assembly::Discretization d(rotor, 4);
    const MatrixXd with = dense(assembly::assemble_rotating(d, 0, {}).M);
    rotor.shaft.segments[1].asymmetry = 0;
    const assembly::Discretization round(rotor, 4);
    const MatrixXd without = dense(assembly::assemble_rotating(round, 0, {}).M);
    // rho I L s exp(2 i angle) on the slope, I of the hollow circle.
    const double I = std::numbers::pi / 64 * (std::pow(0.05, 4) - std::pow(0.01, 4));
    const double a = 7810 * I * 0.5 * 0.15;
    const MatrixXd difference = with - without;
    EXPECT_NEAR(difference(2, 2), a * std::cos(1.2), 1e-12 * a);
    EXPECT_NEAR(difference(2, 3), a * std::sin(1.2), 1e-12 * a);
    EXPECT_NEAR(difference(3, 3), -a * std::cos(1.2), 1e-12 * a);
    EXPECT_LT(difference.topRows(2).cwiseAbs().maxCoeff(), 1e-12 * a);
}

TEST(RotatingSystem, FrozenBallsLeaveTheirMassesAlone) {
    const model::Rotor rotor = full_rotor();
    const assembly::Discretization d(rotor, rotor.shaft.order);
    const auto elements =
        balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor));
    const assembly::RotatingSystem free = assembly::assemble_rotating(d, 0, elements);
    const assembly::RotatingSystem frozen = assembly::assemble_rotating(d, 0, elements, true);
    const int n = 2 * d.planar_size();
    ASSERT_EQ(frozen.M.size(), n);
    ASSERT_EQ(free.M.size(), n + 4);
    const double speed = 217;
    const auto same = [n](const MatrixXd &a, const MatrixXd &b) { // sums in another order
        return (a - b.topLeftCorner(n, n)).cwiseAbs().maxCoeff() <= 1e-15 * a.cwiseAbs().maxCoeff();
    };
    EXPECT_TRUE(same(dense(frozen.M), dense(free.M)));
    EXPECT_TRUE(same(dense(frozen.damping(speed)), dense(free.damping(speed))));
    EXPECT_TRUE(same(dense(frozen.stiffness(speed)), dense(free.stiffness(speed))));
}

/// Stiffness of a one-element shaft in one plane, seen from its two nodes: what lies between them
/// is eliminated, so that it does not matter by which functions it is described.
MatrixXd nodal_stiffness(const MatrixXd &K, int plane) {
    const auto n = K.rows() / 2;
    const MatrixXd in_plane = K(Eigen::seqN(plane, n, 2), Eigen::seqN(plane, n, 2));
    std::vector<Eigen::Index> nodes{0, 1, n - 2, n - 1};
    std::vector<Eigen::Index> between;
    for (Eigen::Index i = 2; i < n - 2; ++i)
        between.push_back(i);
    const MatrixXd across = in_plane(between, nodes);
    const MatrixXd inside = in_plane(between, between);
    const MatrixXd moved = inside.partialPivLu().solve(across);
    MatrixXd nodal = in_plane(nodes, nodes);
    nodal -= linalg::transposed_times(across, moved);
    return nodal;
}

// An asymmetric segment is a circular one of other stiffness in each of its two planes, where the
// functions of the element span the same motions whatever that stiffness (order 2 and higher).
TEST(RotatingSystem, AsymmetricSegmentHasTwoBendingStiffnesses) {
    model::Rotor rotor = tests::uniform_shaft(0.6, 0.03);
    rotor.shaft.shear = model::ShearFormula::given;
    rotor.shaft.shear_coefficient = 0.85;
    const auto stiffness_of = [&](double share) {
        model::Rotor other = rotor;
        other.shaft.segments[0].material.E *= share; // G A kappa stays
        const assembly::Discretization d(other, 4);
        return nodal_stiffness(dense(assembly::assemble_rotating(d, 0, {}).K), 0);
    };
    const MatrixXd stiff = stiffness_of(1.3);
    const MatrixXd soft = stiffness_of(0.7);
    rotor.shaft.segments[0].asymmetry = 0.3;
    const assembly::Discretization d(rotor, 4);
    const MatrixXd K = dense(assembly::assemble_rotating(d, 0, {}).K);
    const double size = K.cwiseAbs().maxCoeff();
    EXPECT_LT((nodal_stiffness(K, 0) - stiff).cwiseAbs().maxCoeff(), 1e-14 * size);
    EXPECT_LT((nodal_stiffness(K, 1) - soft).cwiseAbs().maxCoeff(), 1e-14 * size);
    for (Eigen::Index i = 0; i < K.rows(); i += 2)
        for (Eigen::Index j = 1; j < K.cols(); j += 2)
            EXPECT_EQ(K(i, j), 0);
}

/// Bearings that differ between x and y, couple them and are damped.
model::Rotor anisotropic_rotor() {
    model::Rotor rotor = full_rotor();
    rotor.bearings[0].rows[0].k << 3e6, 2e5, -1e5, 1e6;
    rotor.bearings[0].rows[0].c << 300, 20, 50, 100;
    rotor.bearings[1].rows[0].kt << 2e3, 0, 100, 1e3;
    return rotor;
}

TEST(PeriodicSupports, WithTheConstantPartAreTheBearingsTurnedBackwards) {
    const model::Rotor rotor = anisotropic_rotor();
    const assembly::Discretization d(rotor, rotor.shaft.order);
    const balancers::Arrangement balls = balancers::arrangement_at_balance(rotor);
    const assembly::RotatingSystem rotating =
        assembly::assemble_rotating(d, 0, balancers::balancer_elements(rotor, balls));
    const int n = rotating.M.size();
    const assembly::PeriodicSupports turning = assembly::periodic_supports(d, 0, n);
    const double speed = 310;
    const tests::PeriodicSystem periodic(d, speed, balls);
    const auto [columns, rows] = means(periodic, {3, 2});
    for (const double time : {0.0, 0.0013, 0.47}) {
        const double c = std::cos(2 * speed * time);
        const double s = std::sin(2 * speed * time);
        const MatrixXd D = dense(rotating.damping(speed)) + c * dense(turning.C.cosine) +
                           s * dense(turning.C.sine);
        const MatrixXd K = dense(rotating.stiffness(speed)) +
                           c * (dense(turning.K.cosine) + speed * dense(turning.Ks.cosine)) +
                           s * (dense(turning.K.sine) + speed * dense(turning.Ks.sine));
        const Motion one_by_one = turned(periodic, time);
        EXPECT_LT((rows * one_by_one.D - D * columns).cwiseAbs().maxCoeff(),
                  1e-13 * D.cwiseAbs().maxCoeff());
        EXPECT_LT((rows * one_by_one.K - K * columns).cwiseAbs().maxCoeff(),
                  1e-13 * K.cwiseAbs().maxCoeff());
    }
}

// A series put into the equations with time: every harmonic of the residual is a row of Hill's
// matrices. The last harmonic is left out of the series, so that nothing of it is cut off.
TEST(HillSystem, IsTheHarmonicsOfTheResidual) {
    const model::Rotor rotor = anisotropic_rotor();
    const assembly::Discretization d(rotor, 1);
    const assembly::RotatingSystem system = assembly::assemble_rotating(
        d, 0, balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)));
    const Eigen::Index n = system.M.size();
    const assembly::PeriodicSupports turning =
        assembly::periodic_supports(d, 0, static_cast<int>(n));
    const double speed = 270;
    constexpr int harmonics = 3;
    const assembly::SystemAtSpeed hill = assembly::hill_system(system, turning, speed, harmonics);
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(n * (2 * harmonics + 1));
    for (Eigen::Index i = 0; i < n * (2 * harmonics - 1); ++i)
        x(i) = {unit(generator), unit(generator)};
    const std::complex<double> l(-3.1, 88);
    const Eigen::VectorXcd rows =
        l * l * (dense(hill.M) * x) + l * (dense(hill.D) * x) + dense(hill.K) * x;
    for (const double time : {0.0, 0.0007, 0.0041}) {
        Eigen::VectorXcd q = x.head(n);
        Eigen::VectorXcd v = l * q;
        Eigen::VectorXcd a = l * v;
        Eigen::VectorXcd expected = rows.head(n);
        for (int k = 1; k <= harmonics; ++k) {
            const double w = 2 * k * speed;
            const std::complex<double> c = std::cos(w * time);
            const std::complex<double> s = std::sin(w * time);
            const Eigen::VectorXcd A = x.segment((2 * k - 1) * n, n);
            const Eigen::VectorXcd B = x.segment(2 * k * n, n);
            q += c * A + s * B;
            v += (l * c - w * s) * A + (l * s + w * c) * B;
            a += (l * l * c - 2.0 * l * w * s - w * w * c) * A +
                 (l * l * s + 2.0 * l * w * c - w * w * s) * B;
            expected += c * rows.segment((2 * k - 1) * n, n) + s * rows.segment(2 * k * n, n);
        }
        const double c = std::cos(2 * speed * time);
        const double s = std::sin(2 * speed * time);
        const MatrixXd D =
            dense(system.damping(speed)) + c * dense(turning.C.cosine) + s * dense(turning.C.sine);
        const MatrixXd K = dense(system.stiffness(speed)) +
                           c * (dense(turning.K.cosine) + speed * dense(turning.Ks.cosine)) +
                           s * (dense(turning.K.sine) + speed * dense(turning.Ks.sine));
        const Eigen::VectorXcd residual = dense(system.M) * a + D * v + K * q;
        EXPECT_LT((residual - expected).norm(), 1e-12 * residual.norm()) << time;
    }
}

TEST(HillSystem, WithEqualBearingsRepeatsTheRotatingEigenvalues) {
    const model::Rotor rotor = full_rotor();
    const assembly::Discretization d(rotor, 1);
    const assembly::RotatingSystem system = assembly::assemble_rotating(
        d, 0, balancers::balancer_elements(rotor, balancers::arrangement_at_balance(rotor)));
    const double speed = 270;
    const assembly::SystemAtSpeed hill =
        assembly::hill_system(system, assembly::periodic_supports(d, 0, system.M.size()), speed, 1);
    const auto alone = tests::dense_eigenvalues(system, speed);
    const auto series = tests::dense_eigenvalues(dense(hill.M), dense(hill.D), dense(hill.K));
    std::vector<std::complex<double>> expected;
    for (const auto value : alone)
        for (const double shift : {-2.0, 0.0, 2.0})
            expected.push_back(value + std::complex<double>(0, shift * speed));
    ASSERT_EQ(series.size(), expected.size());
    double largest = 0;
    for (const auto value : alone)
        largest = std::max(largest, std::abs(value));
    EXPECT_LT(tests::largest_distance(series, expected), 1e-10 * largest);
    EXPECT_LT(tests::largest_distance(expected, series), 1e-10 * largest);
}

} // namespace rotating_system_test

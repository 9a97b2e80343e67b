// Critical speeds with bearing tables against a scan of the speeds: at each speed of a fine grid
// the eigenvalues with the bearings of that speed, by dense solvers, and the sign changes between.

#include "analyses/critical.h"
#include "assembly/system.h"
#include "input/case_file.h"
#include "results/critical.h"
#include "support/scenes.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace {

using namespace whirl;
using results::CriticalResult;
using Complex = std::complex<double>;

std::vector<double> speeds_of(const CriticalResult &result, double top) {
    std::vector<double> out;
    for (const auto &critical : result.critical_speeds)
        if (critical.speed <= top)
            out.push_back(critical.speed);
    return out;
}

bool says(const CriticalResult &result, const std::string &text) {
    return std::any_of(result.model.notes.begin(), result.model.notes.end(),
                       [&](const auto &note) { return note.find(text) != std::string::npos; });
}

/// Number of negative eigenvalues of K(s) - s^2 (M - i G), all directions together.
int negative_at(const assembly::Discretization &d, double s) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, s);
    const Eigen::MatrixXd K = system.K.view();
    const Eigen::MatrixXd M = system.M.view();
    const Eigen::MatrixXd G = system.G.view();
    Eigen::MatrixXcd Q = (K - s * s * M).cast<Complex>() + Complex(0, s * s) * G.cast<Complex>();
    const Eigen::VectorXd scale = Q.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    Q = scale.asDiagonal() * Q * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(Q, Eigen::EigenvaluesOnly);
    return static_cast<int>((solver.eigenvalues().array() < 0).count());
}

/// Speeds between a and b at which that number changes, each as often as it changes by.
void split(const assembly::Discretization &d, double a, int at_a, double b, int at_b,
           std::vector<double> &out) {
    if (at_a == at_b)
        return;
    if (b - a < 1e-12 * b) {
        out.insert(out.end(), static_cast<std::size_t>(std::abs(at_b - at_a)), (a + b) / 2);
        return;
    }
    const double middle = (a + b) / 2;
    const int at_middle = negative_at(d, middle);
    split(d, a, at_a, middle, at_middle, out);
    split(d, middle, at_middle, b, at_b, out);
}

std::vector<double> scanned(const assembly::Discretization &d, double top, int steps) {
    std::vector<double> out;
    double a = 1e-3 * top / steps;
    int at_a = negative_at(d, a);
    for (int i = 1; i <= steps; ++i) {
        const double b = top * i / steps;
        const int at_b = negative_at(d, b);
        split(d, a, at_a, b, at_b, out);
        a = b;
        at_a = at_b;
    }
    return out;
}

/// Random tables that jump up and down. @param kind 0 isotropic, 1 orthotropic, 2 coupled
/// symmetrically, 3 any stiffness and damping
model::Case table_scene(unsigned seed, int kind) {
    std::mt19937 random(seed);
    const auto between = [&random](double a, double b) {
        return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
    };
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, between(0.05, 0.1), tests::steel());
    scene.rotor.shaft.order = 2;
    const double Ip = between(0.1, 0.6); // one after another: arguments have no order
    const double Id = between(0.1, 0.4);
    const double mass = between(10, 40);
    scene.rotor.discs = {tests::disc_at(between(0.2, 0.8), mass, Id, Ip)};
    for (const double z : {0.0, 1.0}) {
        model::Bearing bearing;
        bearing.z = z;
        for (double speed = between(20, 120); bearing.speeds.size() < 6;
             speed += between(15, 180)) {
            bearing.speeds.push_back(speed);
            model::BearingCoefficients row;
            const double k = std::pow(10, between(5.5, 7.5));
            row.k << k, 0, 0, k;
            if (kind >= 1)
                row.k(1, 1) *= between(0.4, 2);
            if (kind >= 2)
                row.k(0, 1) = row.k(1, 0) = between(-0.5, 0.5) * std::min(k, row.k(1, 1));
            if (kind == 3) {
                row.k(0, 1) += between(-0.2, 0.2) * k;
                const double c = std::pow(10, between(1.5, 3.5));
                row.c << c, 0, 0, c * between(0.5, 1.5);
            }
            bearing.rows.push_back(row);
        }
        scene.rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, 1200, 11};
    scene.campbell.modes = 3;
    return scene;
}

TEST(CriticalTables, UndampedListsAreThoseOfAScan) {
    for (int kind = 0; kind < 3; ++kind)
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const model::Case scene = table_scene(100 * static_cast<unsigned>(kind) + seed, kind);
            const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
            const std::vector<double> expected = scanned(d, 1200, 800);
            const CriticalResult result = analyses::critical_speeds(scene);
            const std::vector<double> found = speeds_of(result, 1200);
            ASSERT_EQ(found.size(), expected.size()) << "kind " << kind << " seed " << seed;
            for (std::size_t i = 0; i < found.size(); ++i) // bisection of signs ends at 1e-13
                EXPECT_NEAR(found[i] / expected[i], 1, 1e-9) << kind << " " << seed;
            EXPECT_FALSE(says(result, "may be missing"));
        }
}

TEST(CriticalTables, AsManyAsAreAskedForBeyondTheRangeAreThere) {
    constexpr std::size_t wanted = 8;
    for (int kind = 0; kind < 3; ++kind)
        for (unsigned seed = 1; seed <= 2; ++seed) {
            model::Case scene = table_scene(50 + 100 * static_cast<unsigned>(kind) + seed, kind);
            scene.speeds = model::SpeedRange{0, 400, 5};
            scene.campbell.modes = wanted;
            const assembly::Discretization d(scene.rotor, scene.rotor.shaft.order);
            const std::vector<double> expected = scanned(d, 3000, 2000);
            const std::vector<double> found = speeds_of(analyses::critical_speeds(scene), 3000);
            ASSERT_GE(found.size(), std::min(wanted, expected.size())) << kind << " " << seed;
            ASSERT_LE(found.size(), expected.size()) << kind << " " << seed;
            for (std::size_t i = 0; i < found.size(); ++i) // bisection of signs ends at 1e-13
                EXPECT_NEAR(found[i] / expected[i], 1, 1e-9)
                    << kind << " " << seed << " at " << found[i];
        }
}

/// Eigenvalues of l^2 (M - iG) + l (C - i Kc) + K with the bearings as at s, by the companion.
Eigen::VectorXcd frozen_eigenvalues(const assembly::Discretization &d, double s) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, s);
    const auto dense = [](const linalg::Matrix &A) { return Eigen::MatrixXd(A.view()); };
    const Eigen::MatrixXcd M =
        dense(system.M).cast<Complex>() - Complex(0, 1) * dense(system.G).cast<Complex>();
    const Eigen::MatrixXcd C =
        dense(system.C).cast<Complex>() - Complex(0, 1) * dense(system.Kc).cast<Complex>();
    const Eigen::MatrixXcd K = dense(system.K).cast<Complex>();
    const Eigen::Index n = M.rows();
    // 1/l, so that unknowns without inertia do no harm; times 100 rad/s against bad scaling.
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(K);
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
    companion.topLeftCorner(n, n) = -100 * lu.solve(C);
    companion.topRightCorner(n, n) = -10000 * lu.solve(M);
    companion.bottomLeftCorner(n, n).setIdentity();
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
    return 100 * solver.eigenvalues().cwiseInverse();
}

/// Speeds s with Im l(s) = s, |Re l| < s, between neighbours of a grid by nearest eigenvalues.
std::vector<double> followed(const assembly::Discretization &d, double top, int steps) {
    std::vector<double> out;
    Eigen::VectorXcd before = frozen_eigenvalues(d, 1e-3 * top / steps);
    for (int i = 1; i <= steps; ++i) {
        const double a = top * (i - 1) / steps;
        const double b = top * i / steps;
        const Eigen::VectorXcd after = frozen_eigenvalues(d, b);
        for (const Complex l : before) {
            if (std::abs(l.imag() - a) > 20 * (b - a))
                continue;
            Eigen::Index nearest = 0;
            (after.array() - l).abs().minCoeff(&nearest);
            const Complex m = after(nearest);
            const double share = (l.imag() - a) / (l.imag() - a - m.imag() + b);
            const Complex at = l + share * (m - l);
            if ((l.imag() < a) != (m.imag() < b) && std::abs(at.real()) < at.imag())
                out.push_back(a + share * (b - a));
        }
        before = after;
    }
    std::sort(out.begin(), out.end());
    return out;
}

TEST(CriticalTables, DampedListsAreThoseOfAScan) {
    std::size_t all = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        model::Case scene = table_scene(seed, 3);
        scene.rotor.shaft.rigid = seed % 2 == 0;
        scene.rotor.shaft.order = 1;
        const assembly::Discretization d(scene.rotor, 1);
        const int steps = scene.rotor.shaft.rigid ? 4000 : 1500;
        const std::vector<double> expected = followed(d, 1200, steps);
        const CriticalResult result = analyses::critical_speeds(scene);
        const std::vector<double> found = speeds_of(result, 1200);
        ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
        for (std::size_t i = 0; i < found.size(); ++i) // straight lines between speeds of the grid
            EXPECT_NEAR(found[i], expected[i], 1200.0 / steps) << "seed " << seed;
        EXPECT_FALSE(says(result, "may be missing"));
        all += found.size();
    }
    EXPECT_GT(all, 15U);
}

TEST(CriticalTables, AStepUpInStiffnessIsPassedMoreThanOnce) {
    // Four pairs of critical speeds: on the soft row, twice on the rise, on the stiff row.
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.8, 0.1, {"steel", 210e9, 210e9 / 2.6, 7850});
    scene.rotor.discs = {tests::disc_at(0.4, 30, 0.3, 0.55)};
    for (const double z : {0.0, 0.8}) {
        model::Bearing bearing;
        bearing.z = z;
        for (const auto &[speed, k] :
             {std::pair(0.0, 1e6), {300.0, 1e6}, {400.0, 2e7}, {2000.0, 2e7}}) {
            bearing.speeds.push_back(speed);
            bearing.rows.push_back(tests::isotropic_bearing(z, k).rows[0]);
        }
        scene.rotor.bearings.push_back(bearing);
    }
    scene.speeds = model::SpeedRange{0, 900, 91};
    scene.campbell.modes = 4;
    const std::vector<double> found = speeds_of(analyses::critical_speeds(scene), 900);
    // Determinant signs on a grid of 0.01 rad/s with spectral elements; digits printed.
    const std::vector<double> expected{157.8, 157.8, 298.8, 300.0, 316.8, 316.8, 632.4, 632.7};
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 0.0501);
}

TEST(CriticalTables, ThreeDiscsWithMeasuredBearings) {
    const model::Case scene =
        input::load_case(std::string(WHIRL_ROOT) + "/cases/speed_dependent_bearings");
    const CriticalResult result = analyses::critical_speeds(scene);
    const std::vector<double> found = speeds_of(result, 4000);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [](double w) { return std::abs(w - 3621.4) < 0.051; }));
    EXPECT_FALSE(says(result, "no more critical speeds"));
}

TEST(CriticalTables, ARootAtARowIsFoundOnce) {
    // A mass of 10 kg on a spring: 1e5 N/m at rest, and exactly 10 W^2 at 200 rad/s.
    for (const double beyond : {3e5, 5e5, 6e5}) {
        model::Case scene;
        scene.rotor.shaft = tests::uniform_shaft(0.5, 0.05, tests::weightless_steel());
        scene.rotor.shaft.rigid = true;
        scene.rotor.discs = {tests::disc_at(0.25, 10, 0.1, 0.2)};
        for (const double z : {0.0, 0.5}) {
            model::Bearing bearing;
            bearing.z = z;
            for (const auto &[speed, k] :
                 {std::pair(0.0, 5e4), {200.0, 2e5}, {300.0, beyond / 2}, {900.0, beyond / 2}}) {
                bearing.speeds.push_back(speed);
                bearing.rows.push_back(tests::isotropic_bearing(z, k).rows[0]);
            }
            scene.rotor.bearings.push_back(bearing);
        }
        scene.speeds = model::SpeedRange{0, 210, 3};
        scene.campbell.modes = 1;
        const std::vector<double> found = speeds_of(analyses::critical_speeds(scene), 210);
        // Translation forward and backward; k = 1e5 + 1500 W stays above 10 W^2 below the row.
        int at_row = 0;
        for (const double speed : found)
            at_row += std::abs(speed / 200 - 1) < 1e-9 ? 1 : 0;
        EXPECT_EQ(at_row, 2) << beyond;
    }
}

} // namespace

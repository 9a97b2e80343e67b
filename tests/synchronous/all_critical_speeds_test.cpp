// None is lost: lists of critical speeds against all synchronous roots of the whole rotor by dense
// decompositions, and of rigid rotors against closed forms.

#include "analyses/critical.h"
#include "assembly/discretization.h"
#include "assembly/system.h"
#include "results/critical.h"
#include "support/rigid_jeffcott.h"
#include "support/scenes.h"
#include "support/written_case.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace whirl;
using Complex = std::complex<double>;
using Speeds = std::vector<double>;

Eigen::MatrixXd dense(const linalg::Matrix &A) { return Eigen::MatrixXd(A.view()); }

Speeds below(Speeds speeds, double top) {
    std::erase_if(speeds, [top](double speed) { return speed > top; });
    std::ranges::sort(speeds);
    return speeds;
}

Speeds listed(const model::Case &scene) {
    Speeds out;
    for (const results::CriticalSpeed &c : analyses::critical_speeds(scene).critical_speeds)
        if (c.speed >= scene.speeds->from)
            out.push_back(c.speed);
    return below(out, scene.speeds->to);
}

/// @param rounding  relative, of the dense decomposition
void expect_all(const Speeds &found, const Speeds &expected, double rounding) {
    ASSERT_EQ(found.size(), expected.size())
        << testing::PrintToString(found) << " for " << testing::PrintToString(expected);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i] / expected[i], 1, rounding);
}

/// Order of the elements and speeds of the tables of a case.
assembly::Discretization discretized(const model::Case &scene) {
    return assembly::Discretization(scene.rotor, scene.rotor.shaft.order);
}

Speeds rows_of(const model::Case &scene) {
    Speeds rows{0};
    for (const model::Bearing &bearing : scene.rotor.bearings)
        for (const double speed : bearing.speeds)
            if (speed > 0)
                rows.push_back(speed);
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

/// Of an undamped rotor: K(s) - s^2 (M + S) = A + t B - t^2 (M + S) between two rows of the tables,
/// t from a speed where A is not singular; in (x, x/t) that is linear with the eigenvalue 1/t.
Speeds dense_undamped(const model::Case &scene) {
    const assembly::Discretization d = discretized(scene);
    Speeds rows = rows_of(scene);
    const double top = scene.speeds->to;
    rows.push_back(std::max(2 * rows.back(), 2 * top));
    Speeds out;
    for (std::size_t i = 0; i + 1 < rows.size() && rows[i] < top; ++i) {
        const assembly::FixedSystem from = assembly::assemble_fixed(d, rows[i]);
        const Eigen::MatrixXd H = dense(from.M) + dense(assembly::hyperbolic_coupling(d));
        const Eigen::MatrixXd K = dense(from.K);
        const bool last = i + 2 == rows.size();
        const Eigen::MatrixXd rate =
            last ? Eigen::MatrixXd(0 * K)
                 : Eigen::MatrixXd((dense(assembly::assemble_fixed(d, rows[i + 1]).K) - K) /
                                   (rows[i + 1] - rows[i]));
        // Deflections and slopes of one size.
        const double s = rows[i] + 0.37 * (rows[i + 1] - rows[i]);
        const Eigen::VectorXd size =
            (K.diagonal().cwiseAbs() + s * s * H.diagonal().cwiseAbs()).cwiseSqrt().cwiseInverse();
        const auto scaled = [&](const Eigen::MatrixXd &A) {
            return Eigen::MatrixXd(size.asDiagonal() * A * size.asDiagonal());
        };
        const double from_row = s - rows[i];
        const Eigen::PartialPivLU<Eigen::MatrixXd> A(scaled(K + from_row * rate - s * s * H));
        const Eigen::MatrixXd B = scaled(rate - 2 * s * H);
        const Eigen::Index n = K.rows();
        Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        companion.topRightCorner(n, n).setIdentity();
        companion.bottomLeftCorner(n, n) = s * s * A.solve(scaled(H));
        companion.bottomRightCorner(n, n) = -s * A.solve(B);
        for (const Complex root : companion.eigenvalues()) {
            const Complex speed = s + s / root;
            constexpr double rounding = 1e-6; // two equal ones become a pair
            if (std::abs(speed.imag()) < rounding * std::abs(speed) && speed.real() > rows[i] &&
                speed.real() <= rows[i + 1])
                out.push_back(speed.real());
        }
    }
    return below(out, top);
}

/// Of a damped rotor without tables at speeds of the sign s: all l of
/// l^2 (M - i s G) + l (C - i s Kc) + K with Im l > |Re l|, ascending by Im l, as l = from + t in
/// (x, x/t), eigenvalue 1/t.
std::vector<Complex> dense_roots(const model::Case &scene, double top, int sign) {
    const assembly::FixedSystem at = assembly::assemble_fixed(discretized(scene), 0);
    const Complex i(0, sign);
    const Eigen::MatrixXcd M = dense(at.M) - i * dense(at.G);
    const Eigen::MatrixXcd C = dense(at.C) - i * dense(at.Kc);
    const Eigen::MatrixXcd K = dense(at.K).cast<Complex>();
    const Complex from = top * Complex(0.1, 0.37); // no root is there
    const Eigen::PartialPivLU<Eigen::MatrixXcd> A(K + from * C + from * from * M);
    const Eigen::MatrixXcd B = C + 2.0 * from * M;
    const Eigen::Index n = M.rows();
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
    companion.topRightCorner(n, n).setIdentity();
    companion.bottomLeftCorner(n, n) = -top * top * A.solve(M);
    companion.bottomRightCorner(n, n) = -top * A.solve(B);
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
    std::vector<Complex> out;
    for (const Complex root : solver.eigenvalues()) {
        const Complex l = from + top / root;
        if (l.imag() > std::abs(l.real()) && l.imag() <= top)
            out.push_back(l);
    }
    std::ranges::sort(out, {}, [](Complex l) { return l.imag(); });
    return out;
}

Speeds dense_damped(const model::Case &scene, double top) {
    Speeds out;
    for (const Complex l : dense_roots(scene, top, 1))
        out.push_back(l.imag());
    return out;
}

struct Row {
    double speed, kx, ky, c;
};

void set_table(model::Bearing &bearing, const std::vector<Row> &rows) {
    bearing.speeds.clear();
    bearing.rows.clear();
    for (const Row &row : rows) {
        model::BearingCoefficients at;
        at.k = Eigen::Vector2d(row.kx, row.ky).asDiagonal();
        at.c = row.c * Eigen::Matrix2d::Identity();
        bearing.speeds.push_back(row.speed);
        bearing.rows.push_back(at);
    }
}

std::string range(double to, int modes) {
    return "[speeds]\nfrom = 0\nto = " + std::to_string(to) +
           "\ncount = 2\n[campbell]\nmodes = " + std::to_string(modes) + "\n";
}

/// Three supports, the second of which holds y by kyy (N/m) or not at all.
std::string supports_soft_in_y(double kyy, const std::string &damping) {
    return R"([material.a]
E = 7e10
nu = 0.3
rho = 7800
[shaft]
segments = [{length = 0.2698, outer = 0.0188, material = "a"},
            {length = 0.3346, outer = 0.0393, material = "a"},
            {length = 0.4625, outer = 0.0129, material = "a"}]
order = 5
elements = 1
[[disc]]
z = 0
mass = 0.285
Id = 0.000382
Ip = 0.000382
[[disc]]
z = 0.1992
mass = 5.4795
Id = 0.001239
Ip = 0.001239
[[bearing]]
z = 0.0533
kxx = 1.79759e7
kyy = 1.79759e7
[[bearing]]
z = 0.9601
kxx = 2.72158e7
kyy = )" + std::to_string(kyy) +
           "\n" + damping + "[[bearing]]\nz = 0.5334\nkxx = 554031\nkyy = 1.49914e6\n" +
           range(2000, 5);
}

// The lowest one is of the direction that the support leaves free, however high the list goes.
TEST(AllCriticalSpeeds, WhereASupportHoldsOneDirectionOnly) {
    for (const double kyy : {0.0, 1e3}) {
        const model::Case undamped = tests::written_case(supports_soft_in_y(kyy, ""));
        expect_all(listed(undamped), dense_undamped(undamped), 1e-7);
        const model::Case damped =
            tests::written_case(supports_soft_in_y(kyy, "cxx = 50\ncyy = 5\n"));
        expect_all(listed(damped), dense_damped(damped, damped.speeds->to), 1e-7);
    }
}

// Rounding of the stiffest spring, 1e12 N/m on 30 kg at 90 rad/s: 1e-9 of the eigenvalue.
TEST(AllCriticalSpeeds, OfARotorHeldByOneSpringInOneDirection) {
    for (const double stiff : {1e9, 1e12}) {
        const model::Case scene = tests::written_case(
            "[shaft]\nsegments = [{length = 1.0, outer = 0.05}]\norder = 4\nelements = 3\n"
            "[[disc]]\nz = 0.3\nmass = 30\nId = 0.5\nIp = 0.9\n"
            "[[bearing]]\nz = 0\nkyy = 1e5\nkxx = " +
            std::to_string(stiff) + "\n[[bearing]]\nz = 1.0\nkyy = 0\nkxx = " +
            std::to_string(stiff) + "\n" + range(3000, 8));
        Speeds expected = dense_undamped(scene);
        std::erase_if(expected, [](double speed) { return speed < 1; }); // a tilt in y is free
        expect_all(listed(scene), expected, 1e-6);
    }
}

const std::string stiff_shaft =
    "[shaft]\nsegments = [{length = 0.5, outer = 0.12}]\norder = 4\nelements = 2\n"
    "[[disc]]\nz = 0.25\nmass = 5\nId = 0.02\nIp = 0.03\n"
    "[[bearing]]\nz = 0\nk = 2e5\n[[bearing]]\nz = 0.5\nk = 2e5\n";

// Within a rad/s above 1000 the supports become stiff enough to lift four motions through the
// speed. Of equal supports some roots are double, which the dense decomposition knows to 1e-6.
TEST(AllCriticalSpeeds, WhereTheSupportsStiffenSteeply) {
    model::Case scene = tests::written_case(stiff_shaft + range(1500, 4));
    const double skew = 1.001;
    set_table(scene.rotor.bearings[0], {{800, 2e5, skew * 2e5, 0},
                                        {1000, 2e5, skew * 2e5, 0},
                                        {1030, 1e9, skew * 1e9, 0},
                                        {1500, 1e9, skew * 1e9, 0}});
    set_table(scene.rotor.bearings[1],
              {{800, 2e5, 2e5, 0}, {1000, 2e5, 2e5, 0}, {1030, 1e9, 1e9, 0}, {1500, 1e9, 1e9, 0}});
    const Speeds expected = dense_undamped(scene);
    ASSERT_EQ(std::ranges::count_if(expected, [](double s) { return s > 1000 && s < 1001; }), 4);
    expect_all(listed(scene), expected, 1e-6);
    // Light damping moves them by its square.
    for (model::Bearing &bearing : scene.rotor.bearings)
        for (model::BearingCoefficients &row : bearing.rows)
            row.c = 0.01 * Eigen::Matrix2d::Identity();
    expect_all(listed(scene), expected, 1e-6);
}

// Stiffness that pushes away at some speeds and holds at others: motions begin at zero and rise
// like a root, or fall and rise again between two rows.
TEST(AllCriticalSpeeds, WhereAStiffnessPassesZero) {
    model::Case scene = tests::written_case(
        "[shaft]\nsegments = [{length = 0.5284, outer = 0.0129}, {length = 0.1609, outer = "
        "0.0089}, {length = 0.1539, outer = 0.0519}]\norder = 4\nelements = 1\n"
        "[[bearing]]\nz = 0.0422\nk = 1e6\n"
        "[[bearing]]\nz = 0.7588\nk = 1e6\npedestal_kx = 1.98045e6\npedestal_ky = 7.96662e6\n"
        "pedestal_mass = 0.01\n[[bearing]]\nz = 0.4216\nk = 1e6\n" +
        range(300, 3));
    set_table(scene.rotor.bearings[0],
              {{134.737, -2.04229e7, 1.49569e8, 0}, {399.476, 2.40236e8, 3.37277e8, 0}});
    set_table(scene.rotor.bearings[1],
              {{301.945, 560544, 219136, 0}, {302.471, 2.27359e6, 4.43455e6, 0}});
    set_table(scene.rotor.bearings[2],
              {{99.9449, -3.5248e6, 1.38693e7, 0}, {268.185, 6.19835e7, 1.06085e8, 0}});
    const Speeds first = dense_undamped(scene);
    ASSERT_GE(first.size(), 3U);
    expect_all(listed(scene), first, 1e-6);

    scene.speeds->to = 2000;
    set_table(scene.rotor.bearings[0], {{0, 2e8, 3e8, 0}});
    set_table(scene.rotor.bearings[1], {{605.552, 606308, 628109, 0}, {1815.63, 31043, 40835, 0}});
    set_table(scene.rotor.bearings[2], {{310.637, -8.49192e7, 1.50511e9, 0},
                                        {409.405, -1.4282e8, 1.40703e9, 0},
                                        {1530.24, 4.18769e8, 5.30981e8, 0},
                                        {1598.55, -1.24571e8, 9.98274e8, 0},
                                        {1827.5, 3.34174e8, 4.25893e8, 0}});
    const Speeds second = dense_undamped(scene);
    ASSERT_GE(std::ranges::count_if(second, [](double s) { return s > 1530.24 && s < 1827.5; }), 2);
    expect_all(listed(scene), second, 1e-6);
}

// Above its last row a table is constant, at whatever speeds its rows are.
TEST(AllCriticalSpeeds, OfATableAtNegativeSpeeds) {
    model::Case scene = tests::written_case(
        "[shaft]\nsegments = [{length = 0.8, outer = 0.03}]\norder = 4\nelements = 2\n"
        "[[disc]]\nz = 0.3\nmass = 9\nId = 0.05\nIp = 0.09\n"
        "[[bearing]]\nz = 0\nk = 1e6\n[[bearing]]\nz = 0.8\nk = 2e6\nc = 100\n" +
        range(4000, 4));
    set_table(scene.rotor.bearings[0], {{-2000, 1e7, 1e7, 500}, {-1000, 5e6, 5e6, 100}});
    expect_all(listed(scene), dense_damped(scene, scene.speeds->to), 1e-7);
    set_table(scene.rotor.bearings[0],
              {{-2000, 1e7, 1e7, 500}, {-1000, 6e6, 6e6, 100}, {5000, 5e6, 5e6, 100}});
    const Speeds crossing_zero = listed(scene);
    set_table(scene.rotor.bearings[0],
              {{0, 6e6 - 1e6 / 6, 6e6 - 1e6 / 6, 100}, {5000, 5e6, 5e6, 100}});
    expect_all(listed(scene), crossing_zero, 1e-9);
}

// A rigid body, symmetric on two supports of k(s) and c(s) linear in s: I l^2 + p c l + p k = 0 is
// synchronous, Im l = s, where p k/I - (p c/(2I))^2 = s^2, with I = m, p = 2 for the translations,
// I = Id -+ Ip, p = 2 a^2 for the tilts on arms a.
TEST(AllCriticalSpeeds, OfMotionsTooDampedToOscillateAtTheRows) {
    model::Case scene = tests::written_case(
        "[material.light]\nE = 2.1e11\nG = 8.1e10\nrho = 1e-9\n[shaft]\nrigid = true\n"
        "segments = [{length = 0.8, outer = 0.02, material = \"light\"}]\n"
        "[[disc]]\nz = 0.4\nmass = 10\nId = 0.05\nIp = 0.08\n"
        "[[bearing]]\nz = 0\nk = 1\n[[bearing]]\nz = 0.8\nk = 1\n" +
        range(2000, 1));
    const double from = 500;
    const double to = 2000;
    const double k0 = 2052.4785;
    const double k1 = 27325858.7;
    const double c0 = 413.19644;
    // At the second row the translations oscillate with much damping, or do not.
    for (const double c1 : {22084.99, 24500.0}) {
        for (model::Bearing &bearing : scene.rotor.bearings)
            set_table(bearing, {{from, k0, k0, c0}, {to, k1, k1, c1}});
        Speeds expected;
        const auto add = [&](double inertia, double p) {
            // k = k0 + kr u, c = c0 + cr u, s = from + u
            const double kr = p * (k1 - k0) / (to - from) / inertia;
            const double cr = p * (c1 - c0) / (to - from) / (2 * inertia);
            const double kf = p * k0 / inertia;
            const double cf = p * c0 / (2 * inertia);
            const double a = -cr * cr - 1;
            const double b = kr - 2 * cf * cr - 2 * from;
            const double c = kf - cf * cf - from * from;
            for (const double sign : {-1.0, 1.0}) {
                const double root = (-b + sign * std::sqrt(b * b - 4 * a * c)) / (2 * a);
                const double speed = from + root;
                const double decay = cf + cr * root;
                if (root > 0 && speed < to && speed > decay)
                    expected.push_back(speed);
            }
        };
        add(10, 2);
        add(10, 2);
        add(0.05 + 0.08, 2 * 0.4 * 0.4);
        // Below the rows and at the first one every motion is that of the constant supports.
        for (const auto &[inertia, p] :
             {std::pair(10.0, 2.0), std::pair(10.0, 2.0), std::pair(0.13, 2 * 0.4 * 0.4)}) {
            const double decay = p * c0 / (2 * inertia);
            const double square = p * k0 / inertia - decay * decay;
            if (square > decay * decay)
                expected.push_back(std::sqrt(square));
        }
        ASSERT_GE(expected.size(), 4U);
        std::ranges::sort(expected);
        expect_all(listed(scene), expected, 1e-9);
    }
}

// Free in y, on 100 and 200 N/m in x: y does not move, the tilt about it follows that in x, and of
// the moment of inertia A there is left A - C^2/A. The shaft bends at 2e4 rad/s: (3.5/2e4)^2.
TEST(AllCriticalSpeeds, OfAStiffRotorOnVerySoftSpringsInOneDirection) {
    model::Case scene = tests::written_case(
        "[shaft]\nsegments = [{length = 0.3, outer = 0.2}]\norder = 4\nelements = 2\n"
        "[[disc]]\nz = 0.1\nmass = 20\nId = 0.05\nIp = 0.04\n"
        "[[bearing]]\nz = 0\nkxx = 100\n[[bearing]]\nz = 0.3\nkxx = 200\n" +
        range(100, 4));
    const double shaft = 7800 * M_PI * 0.01 * 0.3;
    const double mass = shaft + 20;
    const double centre = (shaft * 0.15 + 20 * 0.1) / mass;
    const double A = shaft * (0.01 / 4 + 0.3 * 0.3 / 12) + shaft * std::pow(0.15 - centre, 2) +
                     0.05 + 20 * std::pow(0.1 - centre, 2);
    const double C = shaft * 0.01 / 2 + 0.04;
    const double inertia = A - C * C / A;
    Eigen::Matrix2d K;
    const double a = -centre;
    const double b = 0.3 - centre;
    K << 300, 100 * a + 200 * b, 100 * a + 200 * b, 100 * a * a + 200 * b * b;
    const Eigen::Vector2d scale(1 / std::sqrt(mass), 1 / std::sqrt(inertia));
    const Eigen::Matrix2d scaled = scale.asDiagonal() * K * scale.asDiagonal();
    const Eigen::Vector2d squares =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scaled).eigenvalues();
    expect_all(listed(scene), {std::sqrt(squares(0)), std::sqrt(squares(1))}, 1e-6);
}

// A thick shaft: forward and backward speeds of one bending mode are far apart, the fourth and the
// fifth are within 1 %, and no range is asked for. The tilt is free in y, the rotor in nothing
// else.
TEST(AllCriticalSpeeds, AreTheLowestWhereTwoAreNearlyOne) {
    model::Case scene = tests::written_case(
        "[shaft]\nsegments = [{length = 0.3, outer = 0.15}]\norder = 4\nelements = 3\n"
        "[[bearing]]\nz = 0.15\nkxx = 1e4\nkyy = 3e4\ncxx = 10\n" +
        range(2000, 4));
    Speeds expected = dense_damped(scene, 45000);
    std::erase_if(expected, [](double speed) { return speed < 5; }); // a tilt is free
    ASSERT_EQ(expected.size(), 5U);
    ASSERT_LT(expected[4] / expected[3], 1.01);
    expected.pop_back();
    scene.speeds->to = 44800; // below the fifth one
    Speeds lowest;
    model::Case asked = scene;
    asked.speeds->to = 2000;
    for (const results::CriticalSpeed &c : analyses::critical_speeds(asked).critical_speeds)
        lowest.push_back(c.speed);
    expect_all(below(lowest, 45000), expected, 1e-7);
    expect_all(listed(scene), expected, 1e-7);
}

const std::string coupled_supports = R"(
[shaft]
order = 6
elements = 2
internal_damping = 2e-6
segments = [{length = 0.7, outer = 0.08}, {length = 0.5, outer = 0.05}]
[[disc]]
z = 0.65
mass = 12
Id = 0.05
Ip = 0.08
[[bearing]]
z = 0.4
kxx = 1.3e7
kyy = 6.8e6
kxy = -1.7e5
kyx = 1.3e5
cxx = 150
cyy = 2000
[[bearing]]
z = 0.85
kxx = 6.2e7
kyy = 2.5e7
kxy = -3.5e6
kyx = 3e6
cxx = 130
cyy = 3200
cxy = -11
cyx = -19
[[seal]]
z = 0.78
k = 2.5e5
kxy = 4.8e4
c = 11
[campbell]
modes = 2
[speeds]
count = 2
)";

// Supports that couple the planes drive forward whirl of a spin in one direction and backward whirl
// of one in the other, so that speeds and damping differ.
TEST(AllCriticalSpeeds, OfASpinFromYToXAreNotThoseFromXToY) {
    struct Range {
        double from, to;
    };
    constexpr double rounding = 1e-6; // rad/s, 1e-9 of the range: of the dense decomposition
    for (const Range range : {Range{-1500, -10}, Range{-1200, 1500}, Range{10, 1500}}) {
        const model::Case scene =
            tests::written_case(coupled_supports + "from = " + std::to_string(range.from) +
                                "\nto = " + std::to_string(range.to) + "\n");
        std::vector<Complex> expected; // real part and speed
        if (range.from < 0)
            for (const Complex l : dense_roots(scene, -range.from, -1))
                expected.insert(expected.begin(), Complex(l.real(), -l.imag()));
        if (range.to > 0)
            for (const Complex l : dense_roots(scene, range.to, 1))
                expected.push_back(l);
        const auto found = analyses::critical_speeds(scene);
        const auto &speeds = found.critical_speeds;
        ASSERT_EQ(speeds.size(), expected.size()) << range.from;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_NEAR(speeds[i].speed, expected[i].imag(), rounding);
            EXPECT_NEAR(speeds[i].real, expected[i].real(), rounding);
            EXPECT_LT(speeds[i].error, 1e-4) << speeds[i].speed; // the finer model has the same
        }
        const auto &slowest = std::ranges::min(
            speeds, {}, [](const auto &critical) { return std::abs(critical.speed); });
        EXPECT_FALSE(slowest.mode.empty()) << slowest.speed; // as lines of campbell have names
        EXPECT_LE(found.complete.from, range.from < 0 ? range.from : 0);
        EXPECT_GE(found.complete.to, range.to > 0 ? range.to : 0);
    }
}

// m w'' + c w' + (k - iq) w = 0: at W > 0 forward whirl exp(lt) with Im l > 0 is that with
// m l^2 + c l + k - iq = 0, at W < 0 that with k + iq, which the seals damp.
TEST(AllCriticalSpeeds, ASealDrivesForwardWhirlOfOneSpinOnly) {
    const double q = 2.5e5; // above c w_n = 2e5
    tests::RigidJeffcott rotor;
    model::Case scene = rotor.scene();
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].k += q / 2 * Eigen::Matrix2d{{0, 1}, {-1, 0}};
    scene.speeds = model::SpeedRange{-1000, 1000, 2};
    const auto root = [&](double sign) { // of the larger imaginary part
        const Complex half = rotor.c / (2 * rotor.mass);
        return -half + std::sqrt(half * half - Complex(rotor.kx, -sign * q) / rotor.mass);
    };
    const auto upper = [](Complex l, Complex sum) { return l.imag() > 0 ? l : sum - l; };
    const Complex sum = -rotor.c / rotor.mass;
    const Complex driven = upper(root(1), sum);
    const Complex damped = upper(root(-1), sum);
    ASSERT_GT(driven.real(), 0);
    int forward = 0;
    for (const auto &critical : analyses::critical_speeds(scene).critical_speeds) {
        const bool drives = (critical.whirl == results::Whirl::forward) == (critical.speed > 0);
        const Complex expected = drives ? driven : damped;
        if (std::abs(std::abs(critical.speed) - expected.imag()) > 1e-3 * expected.imag())
            continue; // it tilts
        EXPECT_NEAR(std::abs(critical.speed), expected.imag(), 1e-9 * expected.imag());
        EXPECT_NEAR(critical.real, expected.real(), 1e-9 * expected.imag());
        forward += critical.whirl == results::Whirl::forward ? 1 : 0;
    }
    EXPECT_EQ(forward, 2); // one of each spin
}

// The bearings are read at the speed with its sign: a table and the same one with the signs of its
// speeds turned are of one undamped rotor that spins one way and the other.
TEST(AllCriticalSpeeds, ReadTablesAtNegativeSpeeds) {
    const std::vector<Row> rows{{-900, 2e6, 3e6, 0},
                                {-500, 4e5, 6e5, 0},
                                {-150, 2e5, 3e5, 0},
                                {200, 5e6, 5.5e6, 0},
                                {800, 9e6, 9.5e6, 0}};
    std::vector<Row> turned;
    for (const Row &row : rows)
        turned.insert(turned.begin(), {-row.speed, row.kx, row.ky, row.c});
    model::Case negative = tests::written_case(stiff_shaft + range(1500, 1));
    model::Case positive = negative;
    negative.speeds = model::SpeedRange{-1500, 0, 2};
    for (std::size_t i = 0; i < 2; ++i) {
        set_table(negative.rotor.bearings[i], rows);
        set_table(positive.rotor.bearings[i], turned);
    }
    const Speeds expected = dense_undamped(positive);
    ASSERT_GE(expected.size(), 4U);
    Speeds found = listed(negative);
    std::ranges::reverse(found);
    for (double &speed : found)
        speed = -speed;
    expect_all(found, expected, 1e-6);
}

} // namespace

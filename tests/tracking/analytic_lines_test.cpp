// Following, crossings and locked whirl where every line is a formula: rigid rotors on two equal
// bearings, and modes of two planes made up as bases.

#include "support/scenes.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossings.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace whirl::tracking {

namespace {

using results::Form;

constexpr double mass = 40;
constexpr double Id = 2;
constexpr double Ip = 1.2;
constexpr double l = 0.5; ///< from the centre of mass to each bearing

model::Rotor rigid_rotor(double kx, double ky, double tilt_inertia = Id) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(2 * l, 0.02, tests::weightless_steel());
    rotor.shaft.rigid = true;
    rotor.discs = {tests::disc_at(l, mass, tilt_inertia, Ip * tilt_inertia / Id)};
    rotor.bearings = {tests::isotropic_bearing(0, kx), tests::isotropic_bearing(2 * l, kx)};
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows[0].k(1, 1) = ky;
    return rotor;
}

/// The four frequencies, each a smooth line: bounce in x and in y, and with
/// Id^2 w^4 - (Id (Kx + Ky) + W^2 Ip^2) w^2 + Kx Ky = 0 the slower and the faster tilt.
std::array<double, 4> lines_at(double W, double kx, double ky) {
    const double Kx = 2 * kx * l * l;
    const double Ky = 2 * ky * l * l;
    const double b = Id * (Kx + Ky) + W * W * Ip * Ip;
    const double root = std::sqrt(b * b - 4 * Id * Id * Kx * Ky);
    return {std::sqrt(2 * kx / mass), std::sqrt(2 * ky / mass),
            std::sqrt((b - root) / (2 * Id * Id)), std::sqrt((b + root) / (2 * Id * Id))};
}

struct Swept {
    std::vector<modes::Spectrum> spectra;
    Tracking tracking;
};

Swept swept(const modes::SpectrumSolver &solver, const std::vector<double> &speeds) {
    Swept out;
    for (const double speed : speeds)
        out.spectra.push_back(solver.at(speed, 4));
    out.tracking = track(solver, out.spectra, 4);
    return out;
}

std::vector<double> crossing_speeds(const model::Rotor &rotor, Form form, double from, double to,
                                    const std::vector<double> &multiples) {
    const modes::SpectrumSolver solver(rotor, form, 1);
    const Swept sweep = swept(solver, {from, to});
    const Crossings found = crossings(solver, sweep.tracking, sweep.spectra, multiples);
    EXPECT_TRUE(found.unsettled.empty());
    std::vector<double> out;
    for (const results::Crossing &crossing : found.found) {
        EXPECT_NEAR(crossing.frequency / (crossing.multiple * crossing.speed), 1, 1e-12);
        out.push_back(crossing.speed);
    }
    return out;
}

void expect_speeds(const std::vector<double> &found, const std::vector<double> &expected,
                   double relative) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i] / expected[i], 1, relative) << i;
}

/// Bearings whose stiffness is such that the bounce has w^2 = W^2 - (W - first)(W - second) between
/// the rows at 80 and 200 rad/s; the tilt is ten times faster.
model::Rotor twice_crossing(double first, double second) {
    model::Rotor rotor = rigid_rotor(1, 1, 0.1);
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.speeds = {80, 200};
        bearing.rows.resize(2, bearing.rows[0]);
        for (const std::size_t row : {0U, 1U})
            bearing.rows[row].k = mass / 2 *
                                  (bearing.speeds[row] * (first + second) - first * second) *
                                  Eigen::Matrix2d::Identity();
    }
    return rotor;
}

/// Two modes with right vectors S R, left ones S^-T R, R a turn: bi-orthogonal, and the right ones
/// nearly parallel where the columns of S are.
Snapshot skew_modes(double angle, double first, double second) {
    Eigen::Matrix2d S;
    S << 1, 1, 0, 1e-3;
    Eigen::Matrix2d R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    Snapshot out;
    out.spectrum.modes.resize(2);
    out.spectrum.modes[0].eigenvalue = {-1, first};
    out.spectrum.modes[1].eigenvalue = {-1, second};
    out.spectrum.complete_radius = 1000;
    out.basis.complex_right = (S * R).cast<std::complex<double>>();
    out.basis.complex_left = (S.inverse().transpose() * R).cast<std::complex<double>>();
    out.basis.rate_below = out.basis.rate_above = Eigen::VectorXcd::Zero(2);
    return out;
}

} // namespace

TEST(BiorthogonalMatching, OverlapsOfNearlyParallelVectorsAreThoseOfTheTurn) {
    for (const double angle : {0.0, 0.2, 0.7, 1.4}) {
        const Eigen::MatrixXd found =
            modes::overlaps(skew_modes(0, 50, 51).basis, skew_modes(angle, 50, 51).basis);
        const double own = std::cos(angle) * std::cos(angle);
        Eigen::Matrix2d expected;
        expected << own, 1 - own, 1 - own, own;
        EXPECT_LT((found - expected).norm(), 1e-9) << angle; // 1e6 times the rounding: S is skew
    }
}

TEST(BiorthogonalMatching, ClosePairsGoWhereTheirVectorsGo) {
    // Their frequencies cross; their vectors, 0.06 degrees apart, tell which is which.
    const Snapshot before = skew_modes(0, 50, 50.001);
    for (const double angle : {0.0, 0.3, -0.3}) {
        const Matching matching = match_by_vectors(before, skew_modes(angle, 50.001, 50), 2);
        EXPECT_FALSE(matching.ambiguous) << angle;
        EXPECT_EQ(matching.to, (std::vector<int>{0, 1})) << angle;
    }
    constexpr double quarter = 1.57079632679489662;
    const Matching exchanged = match_by_vectors(before, skew_modes(quarter, 50, 50.001), 2);
    EXPECT_FALSE(exchanged.ambiguous);
    EXPECT_EQ(exchanged.to, (std::vector<int>{1, 0}));
    EXPECT_EQ(exchanged.from, (std::vector<int>{1, 0}));
    EXPECT_TRUE(match_by_vectors(before, skew_modes(quarter / 2, 50, 50.001), 2).ambiguous);
}

TEST(Track, LinesOfARigidRotorAreItsFormulas) {
    const double kx = 1e5;
    const double ky = 1.3e5;
    const modes::SpectrumSolver hyperbolic(rigid_rotor(kx, ky), Form::hyperbolic, 1);
    const modes::SpectrumSolver general(rigid_rotor(kx, ky), Form::general, 1);
    for (const modes::SpectrumSolver *solver : {&hyperbolic, &general})
        for (const std::vector<double> &speeds :
             {std::vector<double>{1, 700},
              std::vector<double>{1, 60, 130, 700, 90, 20, -20, -90, -200}}) {
            const Swept sweep = swept(*solver, speeds);
            EXPECT_TRUE(sweep.tracking.gaps.empty());
            ASSERT_EQ(sweep.tracking.lines.size(), 4U);
            std::array<int, 4> taken{};
            for (const Line &line : sweep.tracking.lines) {
                std::size_t which =
                    4; // the formula that it follows from the first speed to the last
                for (std::size_t i = 0; i < 4; ++i) {
                    bool all = true;
                    for (std::size_t k = 0; k < speeds.size() && all; ++k) {
                        ASSERT_NE(line.place[k], Line::absent);
                        const auto place = static_cast<std::size_t>(line.place[k]);
                        const double found = sweep.spectra[k].modes[place].eigenvalue.imag();
                        all = std::abs(found / lines_at(speeds[k], kx, ky)[i] - 1) < 1e-9;
                    }
                    which = all ? i : which;
                }
                ASSERT_LT(which, 4U) << "a line that changes from one formula to another";
                ++taken[which];
            }
            EXPECT_EQ(taken, (std::array<int, 4>{1, 1, 1, 1}));
        }
}

/// Isotropic: bounce at w0 forward and backward, tilt n^2 Id -+ n Ip = K/W^2; the tilt's forward
/// line exists for n > Ip/Id.
TEST(CrossingsOfLines, MultiplesInOneStep) {
    const double k = 1e5;
    const double K = 2 * k * l * l;
    const double bounce = std::sqrt(2 * k / mass);
    std::vector<double> expected;
    for (const double n : {0.5, 1.0, 2.0}) {
        std::vector<double> own{bounce / n, bounce / n, std::sqrt(K / (n * n * Id + n * Ip))};
        if (n > Ip / Id)
            own.push_back(std::sqrt(K / (n * n * Id - n * Ip)));
        std::sort(own.begin(), own.end());
        expected.insert(expected.end(), own.begin(), own.end());
    }
    for (const Form form : {Form::planar, Form::hyperbolic, Form::general})
        expect_speeds(crossing_speeds(rigid_rotor(k, k), form, 1, 1000, {0.5, 1, 2}), expected,
                      1e-9);
}

/// Of unequal stiffnesses: bounces at their frequencies, tilts where
/// (Id^2 - Ip^2) W^4 - Id (Kx + Ky) W^2 + Kx Ky = 0; turning either way. The step is so long that
/// every line is far below the speed at both of its ends: the speed has its kink at rest.
TEST(CrossingsOfLines, OnBothSidesOfRestInOneStep) {
    const double kx = 1e5;
    const double ky = 1.3e5;
    const double Kx = 2 * kx * l * l;
    const double Ky = 2 * ky * l * l;
    const double a = Id * Id - Ip * Ip;
    const double b = Id * (Kx + Ky);
    const double root = std::sqrt(b * b - 4 * a * Kx * Ky);
    std::vector<double> expected;
    for (const double squared :
         {2 * kx / mass, 2 * ky / mass, (b - root) / (2 * a), (b + root) / (2 * a)})
        for (const double side : {-1, 1})
            expected.push_back(side * std::sqrt(squared));
    std::ranges::sort(expected);
    for (const Form form : {Form::hyperbolic, Form::general}) {
        const modes::SpectrumSolver solver(rigid_rotor(kx, ky), form, 1);
        const Swept sweep = swept(solver, {-1500, 1500});
        const Crossings crossed = crossings(solver, sweep.tracking, sweep.spectra, {1});
        EXPECT_TRUE(crossed.unsettled.empty());
        std::vector<double> found;
        for (const results::Crossing &crossing : crossed.found) {
            EXPECT_NEAR(crossing.frequency / std::abs(crossing.speed), 1, 1e-12);
            found.push_back(crossing.speed);
        }
        std::ranges::sort(found);
        expect_speeds(found, expected, 1e-9);
    }
}

/// The bounces of a rotor with unequal diametral inertias, in rotating axes, are those of a round
/// one: two lines at w0, whichever way it turns and however long the step is.
TEST(CrossingsOfLines, OfAnAsymmetricRotorOnBothSidesOfRestInOneStep) {
    const double k = 1e5;
    const double bounce = std::sqrt(2 * k / mass);
    model::Rotor rotor = rigid_rotor(k, k);
    for (const double dI : {0.04, 0.2}) {
        rotor.anisotropies = {{"", l, dI, 0.4}};
        const modes::SpectrumSolver solver(rotor, Form::rotating, 1);
        for (const auto &[from, to] : {std::pair(-3.8, 3.0), {-20.2, 17.7}, {-30.4, 25.3}}) {
            const Swept sweep = swept(solver, {from * bounce, to * bounce});
            const Crossings crossed = crossings(solver, sweep.tracking, sweep.spectra, {2, 5});
            for (const double multiple : {2.0, 5.0})
                for (const double side : {-1.0, 1.0})
                    EXPECT_EQ(std::ranges::count_if(crossed.found,
                                                    [&](const results::Crossing &crossing) {
                                                        return crossing.multiple == multiple &&
                                                               std::abs(crossing.speed * multiple *
                                                                            side / bounce -
                                                                        1) < 1e-9;
                                                    }),
                              2)
                        << multiple * side << " from " << from << " with " << dI;
        }
    }
}

TEST(CrossingsOfLines, TwoOfOneLineInOneStep) {
    for (const double half : {15.0, 1.0, 1e-2}) {
        const double a = 105 - half;
        const double b = 105 + half;
        // Both bounces. A distance of 1e-11 x 105 is zero, and it changes by 2 half/210 a rad/s.
        const double sharp = 1e-11 * 105 / half;
        expect_speeds(crossing_speeds(twice_crossing(a, b), Form::planar, 80, 200, {1}),
                      {a, a, b, b}, 1e-10 + 1.1 * sharp);
    }
}

TEST(CrossingsOfLines, ALineThatTurnsBackBeforeCrossesNothing) {
    // w^2 = W^2 - (W - 100)^2 - gap: first and second are 100 +- i sqrt(gap).
    for (const double gap : {100.0, 1.0, 1e-4}) {
        model::Rotor rotor = twice_crossing(100, 100);
        for (model::Bearing &bearing : rotor.bearings)
            for (model::BearingCoefficients &row : bearing.rows)
                row.k -= mass / 2 * gap * Eigen::Matrix2d::Identity();
        EXPECT_TRUE(crossing_speeds(rotor, Form::planar, 80, 200, {1}).empty()) << gap;
    }
}

TEST(CrossingsOfLines, ATangentIsMetWhereItTouches) {
    // The distance is (W - 100)^2/200: zero to 1e-9 within 5e-4 rad/s. Each of the two bounces is
    // met there, and at most at both ends of that interval.
    const auto found = crossing_speeds(twice_crossing(100, 100), Form::planar, 80, 200, {1});
    EXPECT_GE(found.size(), 2U);
    EXPECT_LE(found.size(), 4U);
    for (const double speed : found)
        EXPECT_NEAR(speed, 100, 5e-4);
}

/// Tilt of a rigid rotor with unequal diametral inertias: it stands still in the rotor between
/// sqrt(K/(Id - Ip + dI)) and sqrt(K/(Id - Ip - dI)).
TEST(LockedWhirl, OverTheBandBetweenTheTwoCriticalSpeeds) {
    const double k = 1e5;
    const double K = 2 * k * l * l;
    for (const double dI : {0.2, 0.01}) {
        model::Rotor rotor = rigid_rotor(k, k);
        rotor.anisotropies = {{"", l, dI, 0.4}};
        const modes::SpectrumSolver solver(rotor, Form::rotating, 1);
        const double low = std::sqrt(K / (Id - Ip + dI));
        const double high = std::sqrt(K / (Id - Ip - dI));
        for (const double sense : {1.0, -1.0}) {
            std::vector<LockEnd> ends = sense > 0 ? lock_ends_over(solver, 200, 320, 4)
                                                  : lock_ends_over(solver, -320, -200, 4);
            std::ranges::sort(ends, {}, [](const LockEnd &end) { return std::abs(end.speed); });
            ASSERT_EQ(ends.size(), 2U) << dI;
            EXPECT_NEAR(ends[0].speed / (sense * low), 1, 1e-9);
            EXPECT_NEAR(ends[1].speed / (sense * high), 1, 1e-9);
            EXPECT_LT(std::abs(ends[0].outside), low);
            EXPECT_GT(std::abs(ends[1].outside), high);
            for (const double share : {-0.1, 0.1, 0.5, 0.9, 1.1}) {
                const double speed = sense * (low + share * (high - low));
                const modes::Spectrum spectrum = solver.at(speed, 4);
                EXPECT_EQ(std::any_of(spectrum.modes.begin(), spectrum.modes.end(),
                                      [&](const auto &mode) { return locked(mode, speed); }),
                          share > 0 && share < 1)
                    << dI << " " << share;
            }
        }
    }
}

/// The same on a massless elastic shaft that is 1e8 times as stiff as its bearings: K to that part.
/// Rounding of the stiff entries moves the ends by about epsilon times that ratio, and steps of an
/// iteration get no smaller.
TEST(LockedWhirl, OverItsBandWhereRoundingHidesDigits) {
    const double dI = 0.2;
    model::Rotor rotor = rigid_rotor(1, 1);
    rotor.shaft.rigid = false;
    // Simply supported with a moment at mid-span: tilt L/(12 EI), without shear.
    const double EI = 2e11 * std::pow(0.02, 4) * std::numbers::pi / 64;
    const double K = 1e-8 * 12 * EI / (2 * l);
    for (model::Bearing &bearing : rotor.bearings)
        bearing.rows[0].k = K / (2 * l * l) * Eigen::Matrix2d::Identity();
    rotor.anisotropies = {{"", l, dI, 0.4}};
    const double low = std::sqrt(K / (Id - Ip + dI));
    const double high = std::sqrt(K / (Id - Ip - dI));
    const modes::SpectrumSolver solver(rotor, Form::rotating, 4);
    const std::vector<LockEnd> ends = lock_ends_over(solver, 0.8 * low, 1.2 * high, 4);
    ASSERT_EQ(ends.size(), 2U);
    EXPECT_NEAR(ends[0].speed / low, 1, 1e-6);
    EXPECT_NEAR(ends[1].speed / high, 1, 1e-6);
}

} // namespace whirl::tracking

// Whirl speeds and critical speeds of scenes drawn at random, of kinds that were once wrong: damped
// shafts, free rotors, shafts without mass, growing modes, lines over several grids of speeds.
// Oracles: two-node elements of tests/oracles, which read the case file by themselves, and closed
// forms.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "oracles/case_rotor.h"
#include "oracles/dense_rotor.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "support/random.h"
#include "support/written_case.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace whirl_scenes {

using namespace whirl;
using Complex = std::complex<double>;

/// The same file as written_case() wrote.
std::filesystem::path file_of_test() {
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) /
           (std::string(test->test_suite_name()) + "_" + test->name() + ".toml");
}

/// Two cylinders with a disc between them, bearings at the ends.
std::string rotor_text(tests::Random &random, const std::string &shaft, bool isotropic) {
    const double first = random(0.3, 0.6);
    const double second = random(0.3, 0.6);
    std::string out = fmt::format(
        "[shaft]\norder = 1\nelements = 3\n{}segments = [{{length = {}, "
        "outer = {}, material = \"s\"}}, {{length = {}, outer = {}, material = \"s\"}}]\n",
        shaft, first, random(0.03, 0.06), second, random(0.03, 0.06));
    const double Id = random(0.05, 0.3);
    out += fmt::format("[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n", first, random(10, 40), Id,
                       Id * random(1.2, 1.9));
    for (const double z : {0.0, first + second}) {
        const double kxx = random(3e6, 2e7);
        const double cxx = random(100, 1000);
        const double ratio = isotropic ? 1 : random(0.3, 0.9);
        out += fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\ncxx = {}\ncyy = {}\n", z, kxx,
                           ratio * kxx, cxx, cxx);
    }
    return out;
}

std::string speeds(double to, int count) {
    return fmt::format("[speeds]\nfrom = 0\nto = {}\ncount = {}\n", to, count);
}

bool found(const std::vector<Complex> &all, Complex value) {
    constexpr double same = 1e-6; // one matrix, assembled by two programs, of condition 1e8
    return std::ranges::any_of(
        all, [value](Complex other) { return std::abs(other - value) < same * std::abs(value); });
}

/// Whirl of a shaft whose damping lets motions come to rest at `rate` in axes that turn with
/// `turning` of the spin speed: the lowest six are on lines, and nothing that is no whirl.
void expect_whirl(const results::CampbellResult &result, oracles::DenseRotor dense, bool turns,
                  double rate) {
    if (!turns)
        dense.Kc.setZero(); // C = beta K alone
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        const double speed = result.speeds[k];
        std::vector<Complex> printed;
        for (const results::CampbellMode &mode : result.modes)
            if (mode.frequency[k])
                printed.emplace_back(*mode.real[k], *mode.frequency[k]);
        const std::vector<Complex> right = oracles::whirl_eigenvalues(dense, speed);
        for (const Complex value : printed) {
            EXPECT_TRUE(found(right, value)) << value << " at " << speed;
            EXPECT_FALSE(turns && std::abs(value - Complex(-rate, speed)) < 0.05 * rate)
                << value << " stands in the rotor at " << speed;
        }
        int low = 0;
        for (const Complex value : right) {
            const bool whirls = value.imag() > 0.02 * std::abs(value);
            if (low == 6 || !whirls || std::abs(value) > 0.8 * rate)
                continue;
            ++low;
            EXPECT_TRUE(found(printed, value)) << value << " is missing at " << speed;
        }
    }
}

TEST(DampedShaft, internal_damping_leaves_the_whirl_modes) {
    tests::Random random(3201);
    for (int i = 0; i < 24; ++i) {
        const double eta = std::pow(10, random(-4.2, -3.2));
        const std::string text =
            rotor_text(random, fmt::format("internal_damping = {}\n", eta), i % 3 == 0) +
            speeds(random(800, 3000), 4);
        SCOPED_TRACE(text);
        const model::Case scene = tests::written_case(text);
        expect_whirl(analyses::campbell(scene),
                     oracles::dense_rotor(oracles::read_case(file_of_test(), {})), true, 1 / eta);
    }
}

TEST(DampedShaft, damping_that_stands_leaves_them_too) {
    tests::Random random(3202);
    for (int i = 0; i < 24; ++i) {
        const double beta = std::pow(10, random(-4, -3));
        const std::string kind = rotor_text(random, "DAMPING", i % 3 == 0) + speeds(1500, 4);
        const auto with = [&](const std::string &key) {
            std::string out = kind;
            return out.replace(out.find("DAMPING"), 7, fmt::format("{} = {}\n", key, beta));
        };
        const model::Case internal = tests::written_case(with("internal_damping"));
        const oracles::DenseRotor dense =
            oracles::dense_rotor(oracles::read_case(file_of_test(), {}));
        SCOPED_TRACE(with("beta"));
        const model::Case scene = tests::written_case(with("beta"));
        expect_whirl(analyses::campbell(scene), dense, false, 1 / beta);
    }
}

/// (K - w^2 (M -+ G)) q = 0 of the free rotor, its zero roots left out: lifted by a multiple of M
/// -+ G, which is positive definite as a disc has Ip < Id here.
std::vector<double> free_crossings(const oracles::DenseRotor &dense, double top) {
    const Eigen::Index n = dense.planar();
    const Eigen::MatrixXd K = dense.K.topLeftCorner(n, n);
    const Eigen::MatrixXd M = dense.M.topLeftCorner(n, n);
    const Eigen::MatrixXd G = dense.G.topRightCorner(n, n);
    std::vector<double> out;
    for (const double sign : {1.0, -1.0}) {
        const Eigen::MatrixXd A = M - sign * G;
        const double lift = 1e4;
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> roots(A, K + lift * A);
        for (const double mu : roots.eigenvalues()) {
            const double square = mu > 0 ? 1 / mu - lift : -1;
            if (square > 1e-4 * lift && std::sqrt(square) <= top)
                out.push_back(std::sqrt(square));
        }
    }
    std::ranges::sort(out);
    return out;
}

TEST(FreeRotor, every_crossing_in_the_range_is_listed) {
    tests::Random random(3203);
    for (int i = 0; i < 22; ++i) {
        const double top = random(400, 1500);
        std::string text = fmt::format("[shaft]\norder = 1\nelements = 12\nsegments = [{{length = "
                                       "1.2, outer = {}, material = \"s\"}}]\n",
                                       random(0.012, 0.03));
        for (const double z : {0.0, random(0.4, 0.8), 1.2}) {
            const double Id = random(0.005, 0.03);
            text += fmt::format("[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n", z, random(2, 6),
                                Id, Id * random(0.3, 0.9));
        }
        text += speeds(top, 21);
        text += "[campbell]\nmodes = 4\n"; // fewer than cross
        SCOPED_TRACE(text);
        const results::CampbellResult result = analyses::campbell(tests::written_case(text));
        const std::vector<double> right =
            free_crossings(oracles::dense_rotor(oracles::read_case(file_of_test(), {})), top);
        std::vector<double> listed;
        for (const results::Crossing &crossing : result.crossings)
            listed.push_back(crossing.speed);
        // As many as three times the modes asked for are looked at.
        ASSERT_EQ(listed.size(), right.size());
        for (std::size_t k = 0; k < right.size(); ++k)
            EXPECT_NEAR(listed[k] / right[k], 1, 1e-7);
    }
}

/// A name stands for the same motion at the speeds that two diagrams share.
TEST(Names, are_the_same_on_every_grid) {
    tests::Random random(3204);
    for (int i = 0; i < 24; ++i) {
        std::string text = rotor_text(random, i % 2 == 0 ? "" : "internal_damping = 2e-6\n", false);
        if (i % 3 == 0) // on bearings almost alike lines cross, or nearly do
            text =
                rotor_text(random, "", true) + fmt::format("[[seal]]\nz = 0.2\nkxy = {}\nk = {}\n",
                                                           random(0, 1e5), random(1e3, 1e5));
        if (i % 4 == 0) // heavily damped: pairs turn real
            text += fmt::format("[[seal]]\nz = 0.25\nc = {}\nkxy = {}\n", random(1e4, 1e5),
                                random(0, 1e6));
        const double top = random(500, 4000);
        SCOPED_TRACE(text);
        const auto diagram = [&](int count) {
            return analyses::campbell(tests::written_case(text + speeds(top, count)));
        };
        const results::CampbellResult coarse = diagram(3);
        for (const int count : {13, 61}) {
            const results::CampbellResult fine = diagram(count);
            for (const results::CampbellMode &one : coarse.modes)
                for (const results::CampbellMode &other : fine.modes)
                    for (const std::size_t k : {0U, 1U, 2U}) {
                        const std::size_t at = k * static_cast<std::size_t>(count - 1) / 2;
                        if (one.label != other.label || !one.frequency[k] || !other.frequency[at])
                            continue;
                        // Both are the solver's: its rounding.
                        EXPECT_NEAR(*one.frequency[k], *other.frequency[at],
                                    1e-6 * *one.frequency[k])
                            << one.label << " at " << coarse.speeds[k] << ", " << count;
                    }
        }
    }
}

/// k = 48 E I/L^3 in series with the two bearings carries the disc; m l^2 + c l + k = 0.
TEST(ShaftWithoutMass, critical_speed_of_its_disc) {
    tests::Random random(3205);
    for (int i = 0; i < 20; ++i) {
        const double d = random(0.01, 0.04);
        const double mass = i % 4 == 3 ? 1e9 : random(2, 50);
        const double rho = i % 4 == 3 ? 7800 : std::pow(10, random(-12, -2));
        const double kb = std::pow(10, random(6, 9));
        const double shaft = 48 * 2.1e11 * std::numbers::pi * std::pow(d, 4) / 64;
        const double k = 1 / (1 / shaft + 1 / (2 * kb));
        const double c = random(0.01, 0.2) * 2 * std::sqrt(k * mass);
        const std::string text = fmt::format(
            "[material.light]\nE = 2.1e11\nnu = 0.3\nrho = {}\n[shaft]\nshear = 1e9\norder = 4\n"
            "elements = 2\nsegments = [{{length = 1, outer = {}, material = "
            "\"light\"}}]\n[[disc]]\n"
            "z = 0.5\nmass = {}\n[[seal]]\nz = 0.5\nc = {}\n[[bearing]]\nz = 0\nk = {}\n"
            "[[bearing]]\nz = 1\nk = {}\n",
            rho, d, mass, c, kb, kb);
        SCOPED_TRACE(text);
        const auto critical = analyses::critical_speeds(tests::written_case(text)).critical_speeds;
        ASSERT_GE(critical.size(), 2U);
        for (const std::size_t way : {0U, 1U}) { // backward and forward
            // The shaft's own mass, 1e-2 kg/m3 at most, is below 1e-6 of the disc's.
            EXPECT_NEAR(critical[way].speed / std::sqrt(k / mass - std::pow(c / (2 * mass), 2)), 1,
                        2e-6);
            EXPECT_NEAR(*critical[way].damping.ratio, c / (2 * std::sqrt(k * mass)), 2e-6);
        }
    }
}

/// m z'' + c z' + (k - i kxy) z = 0 grows where kxy > c sqrt(k/m): such a mode does not pass.
TEST(Margins, of_a_growing_mode_fail) {
    tests::Random random(3206);
    int growing = 0;
    for (int i = 0; i < 24; ++i) {
        const double mass = random(50, 200);
        const double k = random(2e6, 2e7);
        const double c = random(0.01, 0.04) * 2 * std::sqrt(k * mass);
        const double share = random(0.3, 2.5); // of the coupling at which it begins to grow
        const double speed = std::sqrt(k / mass);
        const std::string text = fmt::format(
            "[shaft]\nrigid = true\nsegments = [{{length = 1, outer = 0.01}}]\n[[disc]]\nz = 0.5\n"
            "mass = {}\nId = 1e3\nIp = 1\n[[bearing]]\nz = 0\nk = {}\nc = {}\n[[bearing]]\nz = 1\n"
            "k = {}\nc = {}\n[[seal]]\nz = 0.5\nkxy = {}\n[operation]\nfrom = {}\nto = {}\n",
            mass, k / 2, c / 2, k / 2, c / 2, share * c * speed, 3 * speed, 4 * speed);
        SCOPED_TRACE(text);
        const results::CriticalResult result = analyses::critical_speeds(tests::written_case(text));
        ASSERT_TRUE(result.margins);
        bool seen = false;
        for (const results::SeparationMargin &margin : *result.margins) {
            // The mass of the thin shaft, 0.6 kg, moves the speed by 1 %.
            if (margin.whirl != results::Whirl::forward ||
                std::abs(margin.speed / speed - 1) > 0.05)
                continue;
            seen = true;
            growing += share > 1.05 ? 1 : 0;
            if (std::abs(share - 1) > 0.05) {
                EXPECT_EQ(margin.passes, share < 1) << share;
                EXPECT_EQ(margin.amplification.has_value(), share < 1) << share;
            }
        }
        EXPECT_TRUE(seen);
    }
    EXPECT_GE(growing, 8);
}

} // namespace whirl_scenes

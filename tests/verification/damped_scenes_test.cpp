// Critical speeds and lines of damped rotors drawn at random, of kinds that were once wrong or
// slow: damping of the shaft's material, bearings far softer than the shaft, bearings that overdamp
// a motion between two speeds of the grid, asymmetric shafts with internal damping. Oracles: dense
// matrices of tests/oracles, which read the case file by themselves, and rigid bodies.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "input/case_file.h"
#include "oracles/case_rotor.h"
#include "oracles/dense_rotor.h"
#include "oracles/rigid_rotor.h"
#include "oracles/rotating_state.h"
#include "oracles/wide_algebra.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "support/random.h"
#include "support/written_case.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace damped_scenes {

using namespace whirl;
using Complex = std::complex<double>;

/// What a test writes, without the ending: written_case() adds .toml.
std::filesystem::path file_of_test(const std::string &ending) {
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) /
           (std::string(test->test_suite_name()) + "_" + test->name() + ending);
}

oracles::CaseRotor read_by_oracle() { return oracles::read_case(file_of_test(".toml"), {}); }

/// Two cylinders of two-node elements, as the oracles have them, with a disc between.
/// @param thick  factor of their diameters
/// @returns text, and where the shaft ends, m
std::pair<std::string, double> shaft_text(tests::Random &random, const std::string &keys,
                                          double thick = 1) {
    const double first = random(0.3, 0.6);
    const double second = random(0.3, 0.6);
    const double Id = random(0.05, 0.3);
    return {
        fmt::format("[shaft]\norder = 1\nelements = 2\n{}segments = [{{length = {}, outer = {}, "
                    "material = \"s\"}}, {{length = {}, outer = {}, material = \"s\"}}]\n"
                    "[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n",
                    keys, first, thick * random(0.03, 0.06), second, thick * random(0.03, 0.06),
                    first, random(10, 40), Id, Id * random(1.2, 1.9)),
        first + second};
}

/// @param kind  of this number: alike in all directions, with cross coupling, neither
std::string bearing_text(tests::Random &random, double z, int kind) {
    const double k = random(3e6, 2e7);
    const double c = random(100, 1000);
    const double ratio = kind % 3 == 2 ? random(0.3, 0.9) : 1;
    const double cross = kind % 3 == 1 ? random(-0.2, 0.2) * k : 0;
    return fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\nkxy = {}\nkyx = {}\ncxx = {}\n"
                       "cyy = {}\n",
                       z, k, ratio * k, cross, -cross, c, c);
}

/// Of many scenes the critical speeds alone, of some with their errors and names.
results::CriticalResult critical(const model::Case &scene, int number) {
    return number % 5 == 0 ? analyses::critical_speeds(scene)
                           : analyses::unjudged_critical_speeds(scene);
}

/// Those listed are the lowest, as many as were asked for or as there are in the range.
void expect_critical(const results::CriticalResult &result, const std::vector<Complex> &right,
                     int wanted, double top) {
    const auto in_range = static_cast<int>(
        std::ranges::count_if(right, [top](Complex l) { return l.imag() <= top; }));
    const auto expected =
        std::min(right.size(), static_cast<std::size_t>(std::max(wanted, in_range)));
    ASSERT_EQ(result.critical_speeds.size(), expected);
    for (std::size_t i = 0; i < expected; ++i) {
        const Complex printed(result.critical_speeds[i].real, result.critical_speeds[i].speed);
        // One matrix, assembled by two programs, of condition 1e8.
        EXPECT_LT(std::abs(printed - right[i]), 1e-6 * std::abs(right[i]))
            << printed << " for " << right[i];
    }
}

TEST(MaterialDamping, critical_speeds_with_damping_that_turns) {
    tests::Random random(3211);
    for (int i = 0; i < 24; ++i) {
        const double eta = std::pow(10, random(-4.5, -3));
        auto [text, length] = shaft_text(random, fmt::format("internal_damping = {}\n", eta));
        text += bearing_text(random, 0, i) + bearing_text(random, length, i);
        text += "[speeds]\nto = 1500\ncount = 3\n[campbell]\nmodes = 6\n";
        SCOPED_TRACE(text);
        const model::Case scene = tests::written_case(text);
        expect_critical(analyses::critical_speeds(scene),
                        oracles::synchronous_eigenvalues(oracles::dense_rotor(read_by_oracle())), 6,
                        1500);
    }
}

TEST(MaterialDamping, critical_speeds_with_damping_that_stands) {
    tests::Random random(3212);
    for (int i = 0; i < 24; ++i) {
        const double beta = std::pow(10, random(-4.5, -3));
        auto [text, length] = shaft_text(random, "DAMPING");
        text += bearing_text(random, 0, i) + bearing_text(random, length, i);
        text += "[speeds]\nto = 1500\ncount = 3\n[campbell]\nmodes = 6\n";
        const auto with = [&text = text, beta](const std::string &key) {
            std::string out = text;
            return out.replace(out.find("DAMPING"), 7, fmt::format("{} = {}\n", key, beta));
        };
        // The oracle knows damping that turns: what its turning adds is taken away.
        (void)tests::written_case(with("internal_damping"));
        oracles::DenseRotor dense = oracles::dense_rotor(read_by_oracle());
        dense.Kc.setZero();
        SCOPED_TRACE(with("beta"));
        expect_critical(critical(tests::written_case(with("beta")), i),
                        oracles::synchronous_eigenvalues(dense), 6, 1500);
    }
}

constexpr double scale = 1000; ///< rad/s

/// Of l^2 M + l C + K = 0 the matrix with the eigenvalues scale / l.
/// @param rates, masses  K^-1 C and K^-1 M
template <class Matrix> Matrix inverse_state(const Matrix &rates, const Matrix &masses) {
    const Eigen::Index n = rates.rows();
    Matrix out = Matrix::Zero(2 * n, 2 * n);
    for (Eigen::Index column = 0; column < n; ++column) {
        for (Eigen::Index row = 0; row < n; ++row) {
            out(row, column) = -scale * rates(row, column);
            out(row, n + column) = -scale * scale * masses(row, column);
        }
        out(n + column, column) = 1;
    }
    return out;
}

/// The same on bearings alike from every direction, in x + i y: half the unknowns. Of forward
/// motion l^2 (M - G) + l (C - Kc) + K, where internal damping drops out; of backward motion its
/// conjugate l^2 (M + G) + l (C* + Kc) + K*.
std::vector<Complex> planar_synchronous(const oracles::DenseRotor &dense) {
    const Eigen::Index n = dense.planar();
    const auto planar = [n](const Eigen::MatrixXd &A, double sign) {
        Eigen::MatrixXcd out(n, n);
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index i = 0; i < n; ++i)
                out(i, j) = {A(i, j), -sign * A(i, n + j)};
        return out;
    };
    std::vector<Complex> out;
    for (const double sign : {1.0, -1.0}) {
        const Eigen::PartialPivLU<Eigen::MatrixXcd> stiffness(planar(dense.K, sign));
        Eigen::MatrixXcd inertia = planar(dense.M, sign);
        Eigen::MatrixXcd damping = planar(dense.C, sign);
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index i = 0; i < n; ++i) {
                inertia(i, j) -= sign * dense.G(i, n + j);
                damping(i, j) -= sign * dense.Kc(i, n + j);
            }
        const Eigen::MatrixXcd state =
            inverse_state<Eigen::MatrixXcd>(stiffness.solve(damping), stiffness.solve(inertia));
        const Eigen::VectorXcd all =
            Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(state, false).eigenvalues();
        for (const Complex mu : all)
            if (-mu.imag() > std::abs(mu.real()))
                out.push_back(scale / mu);
    }
    std::ranges::sort(out, {}, [](Complex l) { return l.imag(); });
    return out;
}

// Motions that come to rest by the material's damping, infinitely many, stand beside four critical
// speeds. Two-node elements, each cut into one, two and four, to the square of their length.
TEST(MaterialDamping, critical_speeds_of_a_stout_rotor_and_their_errors) {
    const std::string file = WHIRL_ROOT "/tests/verification/scenes/critical_slow_2058.toml";
    const oracles::CaseRotor rotor = oracles::read_case(file, {});
    std::vector<std::vector<Complex>> cut;
    for (const int parts : {1, 2, 4})
        cut.push_back(planar_synchronous(oracles::dense_rotor(rotor, parts)));
    const auto found = analyses::critical_speeds(input::load_case(file)).critical_speeds;
    ASSERT_EQ(found.size(), 4U);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Complex before = (4.0 * cut[1].at(i) - cut[0].at(i)) / 3.0;
        const Complex right = (4.0 * cut[2].at(i) - cut[1].at(i)) / 3.0;
        const double size = std::abs(right);
        const double off = std::abs(right - before); // what is left is a sixteenth of it
        EXPECT_LT(off, 1e-3 * size);
        const Complex printed(found[i].real, found[i].speed);
        EXPECT_LT(std::abs(printed - right), off) << i;
        ASSERT_TRUE(std::isfinite(found[i].error)) << i;
        EXPECT_LT(found[i].error, 1e-4);
        EXPECT_LT(std::abs(printed - right), found[i].error * size + off);
    }
}

/// The rotor as a rigid body: x, slope in x, y, slope in y about its centre of mass.
oracles::DenseRotor as_rigid_body(const oracles::CaseRotor &rotor) {
    oracles::CaseRotor free = rotor; // its mass alone; the oracle takes isotropic supports
    free.supports.clear();
    free.tables.clear();
    free.mounts.clear();
    const oracles::RigidRotor body = oracles::bare_rotor(free);
    oracles::DenseRotor out;
    for (Eigen::MatrixXd *matrix : {&out.M, &out.C, &out.G, &out.K, &out.Kc})
        *matrix = Eigen::MatrixXd::Zero(4, 4);
    for (const Eigen::Index plane : {0, 2}) {
        out.M(plane, plane) = static_cast<double>(body.mass);
        out.M(plane + 1, plane + 1) = static_cast<double>(body.A);
    }
    out.G(1, 3) = static_cast<double>(body.C);
    out.G(3, 1) = -out.G(1, 3);
    for (const oracles::Support &support : rotor.supports) {
        const double arm = support.z - static_cast<double>(body.centre);
        for (const std::size_t plane : {0U, 1U}) {
            Eigen::Matrix2d lever;
            lever << 1, arm, arm, arm * arm;
            const auto at = static_cast<Eigen::Index>(2 * plane);
            out.K.block<2, 2>(at, at) += support.k[plane][plane] * lever;
            out.C.block<2, 2>(at, at) += support.c[plane][plane] * lever;
        }
    }
    return out;
}

// The slow motions of a shaft that its bearings cannot bend: those of a rigid body. Each once.
TEST(SoftBearings, critical_speeds_are_those_of_the_rigid_body_each_once) {
    tests::Random random(3213);
    int damped = 0;
    for (int i = 0; i < 24; ++i) {
        const double softer = std::pow(10, random(-10, -6)); // than the shaft, 1e6 to 1e7 N/m
        auto [text, length] = shaft_text(random, "");
        for (const double z : {0.0, length}) {
            const double k = 5e6 * softer * random(0.5, 2);
            const double c =
                i % 3 == 0 ? 1e-5 * k : 0.01 * k * std::sqrt(random(0.1, 1) / softer) * 1e-3;
            const double ratio = i % 2 == 0 ? 1 : random(0.4, 0.9);
            text += fmt::format("[[bearing]]\nz = {}\nkxx = {}\nkyy = {}\ncxx = {}\ncyy = {}\n", z,
                                k, ratio * k, c, c);
        }
        text += "[campbell]\nmodes = 4\n";
        SCOPED_TRACE(text);
        const results::CriticalResult result = analyses::critical_speeds(tests::written_case(text));
        const std::vector<Complex> right =
            oracles::synchronous_eigenvalues(as_rigid_body(read_by_oracle()));
        std::vector<results::CriticalSpeed> slow;
        for (const results::CriticalSpeed &critical : result.critical_speeds)
            if (critical.speed < 3 * right.back().imag())
                slow.push_back(critical);
        ASSERT_EQ(slow.size(), right.size());
        for (std::size_t k = 0; k < right.size(); ++k) {
            const double size = std::abs(right[k]);
            // What the bearings bend the shaft, and what rounding of its stiffness leaves, which
            // the program says.
            const double off = std::max(slow[k].error, 100 * softer);
            EXPECT_LT(off, 1e-3);
            EXPECT_NEAR(slow[k].speed, right[k].imag(), off * size);
            const double ratio = -right[k].real() / size;
            if (slow[k].damping.ratio && *slow[k].damping.ratio != 0) {
                ++damped;
                EXPECT_NEAR(*slow[k].damping.ratio, ratio, off);
                EXPECT_GT(*slow[k].damping.ratio, 0); // only dampers
            } else {
                EXPECT_LT(ratio, off); // not to be told from none
            }
        }
    }
    EXPECT_GE(damped, 20);
}

/// All whirl at a speed.
std::vector<Complex> whirl_at(const oracles::CaseRotor &rotor, double speed) {
    std::vector<Complex> out;
    for (const Complex l :
         oracles::whirl_eigenvalues(oracles::dense_rotor(rotor.at_speed(speed)), speed))
        if (l.imag() > 0.02 * std::abs(l)) // docs/theory.md: no whirl below
            out.push_back(l);
    return out;
}

// Bearings that damp heavily within one step of the grid, where motions cease to whirl and begin
// again: crossings beside the step are listed, and no others; a line ends there and another begins.
TEST(OverdampedBetweenSpeeds, crossings_beside_the_step_are_those_of_the_oracle) {
    tests::Random random(3214);
    constexpr int steps = 8;
    std::size_t crossed = 0;
    int ended = 0;
    for (int i = 0; i < 20; ++i) {
        const double top = random(300, 800);
        const double step = top / steps;
        const double from = step * (static_cast<int>(random(2, 6)) + random(0.05, 0.2));
        const double to = from + step * random(0.5, 0.7);  // within the step
        auto [text, length] = shaft_text(random, "", 2.5); // damped by its bearings, not bent
        const std::filesystem::path table = file_of_test(".csv");
        const double k = random(5e5, 3e6);
        const double ratio = random(0.4, 0.9);
        std::ofstream out(table);
        out << "speed [rad/s],kxx,kyy,cxx,cyy\n";
        const double heavy = random(4e4, 2e5);
        const double ramp = 0.1 * (to - from);
        for (const auto &[speed, c] :
             {std::pair(0.0, 300.0), std::pair(from, 300.0), std::pair(from + ramp, heavy),
              std::pair(to - ramp, heavy), std::pair(to, 300.0), std::pair(top, 300.0)})
            out << fmt::format("{},{},{},{},{}\n", speed, k, ratio * k, c, c);
        out.close();
        for (const double z : {0.0, length})
            text += fmt::format("[[bearing]]\nz = {}\ntable = \"{}\"\n", z, table.string());
        text +=
            fmt::format("[speeds]\nto = {}\ncount = {}\n[campbell]\nmodes = 4\n", top, steps + 1);
        SCOPED_TRACE(text);
        const results::CampbellResult result = analyses::campbell(tests::written_case(text));
        const oracles::CaseRotor rotor = read_by_oracle();
        const auto first = static_cast<std::size_t>(from / step);
        const double a = result.speeds[first];
        const double b = result.speeds[first + 1];
        // Lines through the step: no more than there are motions of such frequencies on the way.
        std::ptrdiff_t through = 0;
        double highest = 0;
        for (const results::CampbellMode &mode : result.modes)
            if (mode.frequency[first] && mode.frequency[first + 1]) {
                ++through;
                highest = std::max({highest, *mode.frequency[first], *mode.frequency[first + 1]});
            }
        const auto up_to = [&](double speed) {
            return std::ranges::count_if(whirl_at(rotor, speed), [highest](Complex l) {
                return l.imag() < 1.2 * highest; // frequencies change with the damping
            });
        };
        const std::ptrdiff_t on_the_way = up_to((from + to) / 2);
        EXPECT_LE(through, on_the_way);
        ended += on_the_way < up_to(a) ? 1 : 0;
        // Crossings with 1x outside that step: Im l passes the speed.
        for (const auto &[low, high] : {std::pair(0.0, a), std::pair(b, top)}) {
            std::vector<double> right;
            constexpr int parts = 40;
            std::vector<Complex> before = whirl_at(rotor, low + 1e-9 * top);
            for (int n = 1; n <= parts; ++n) {
                const double last = low + (high - low) * (n - 1) / parts;
                const double speed = low + (high - low) * n / parts;
                const std::vector<Complex> now = whirl_at(rotor, speed);
                for (const Complex l : before) {
                    const auto next = std::ranges::min_element(
                        now, {}, [l](Complex other) { return std::abs(other - l); });
                    if (next == now.end())
                        continue;
                    const double off = l.imag() - last;
                    const double then = next->imag() - speed;
                    if (off > 0 && then <= 0)
                        right.push_back(last + (speed - last) * off / (off - then));
                }
                before = now;
            }
            std::vector<double> listed;
            for (const results::Crossing &crossing : result.crossings)
                if (crossing.multiple == 1 && crossing.speed > low && crossing.speed < high)
                    listed.push_back(crossing.speed);
            std::ranges::sort(right);
            std::ranges::sort(listed);
            crossed += right.size();
            ASSERT_EQ(listed.size(), right.size()) << low << " to " << high;
            for (std::size_t n = 0; n < right.size(); ++n) // by a straight line between short steps
                EXPECT_NEAR(listed[n], right[n], 1e-3 * right[n]);
        }
    }
    EXPECT_GE(crossed, 20U);
    EXPECT_GE(ended, 10);
}

/// What the shaft's damping, which turns with it, brings to rest in the rotor.
bool at_rest_in_rotor(Complex seen, double eta) {
    return -seen.real() > 0.5 / eta && std::abs(seen.imag()) <= 0.1 * std::abs(seen);
}

/// Eigenvalues in axes that turn with the rotor, Im >= 0, in double precision: where many come to
/// rest at one rate, QR steps in long double without balancing may not end.
std::vector<Complex> seen_from_rotor(const oracles::RotatingRotor &rotor, double speed) {
    using oracles::real_form;
    const oracles::Real W = speed;
    const oracles::Complex i(0, 1);
    const auto wide = [](const oracles::RealMatrix &A) {
        return oracles::ComplexMatrix(A.cast<oracles::Complex>());
    };
    const Eigen::MatrixXd M = real_form(wide(rotor.M), rotor.Ma).cast<double>();
    const Eigen::MatrixXd D =
        real_form(2.0L * i * W * wide(rotor.M) - i * W * wide(rotor.G) + wide(rotor.Ce + rotor.Ci),
                  rotor.Cia)
            .cast<double>();
    const Eigen::MatrixXd K =
        real_form(wide(rotor.K - W * W * rotor.M + W * W * rotor.G) + i * W * wide(rotor.Ce),
                  W * W * rotor.Ma + rotor.Ka)
            .cast<double>();
    const Eigen::PartialPivLU<Eigen::MatrixXd> stiffness(K);
    const Eigen::MatrixXd state =
        inverse_state<Eigen::MatrixXd>(stiffness.solve(D), stiffness.solve(M));
    const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(state, false).eigenvalues();
    std::vector<Complex> out;
    for (const Complex mu : all)
        if (mu.imag() <= 0)
            out.push_back(scale / mu);
    return out;
}

// Motions that come to rest in the rotor by its internal damping are no whirl, and what looks like
// their frequency in fixed axes, the spin speed, crosses nothing.
TEST(AsymmetricShaft, internal_damping_leaves_whirl_and_its_crossings) {
    tests::Random random(3215);
    int crossed = 0;
    for (int i = 0; i < 20; ++i) {
        const double eta = std::pow(10, random(-4.3, -3.3));
        const double asymmetry = random(0.02, 0.15);
        const double top = random(800, 1500);
        auto [text, length] = shaft_text(random, fmt::format("internal_damping = {}\n", eta));
        for (std::size_t at = 0; (at = text.find("material = \"s\"}", at)) != std::string::npos;
             at += 20)
            text.insert(at + 14, fmt::format(", asymmetry = {}", asymmetry));
        for (const double z : {0.0, length})
            text += fmt::format("[[bearing]]\nz = {}\nk = {}\nc = {}\n", z, random(3e6, 2e7),
                                random(100, 1000));
        text += fmt::format("[speeds]\nto = {}\ncount = 4\n[campbell]\nmodes = 8\n", top);
        SCOPED_TRACE(text);
        const results::CampbellResult result = analyses::campbell(tests::written_case(text));
        const oracles::RotatingRotor rotor = oracles::rotating_shaft(read_by_oracle());
        const auto seen = [&rotor](double speed) { return seen_from_rotor(rotor, speed); };
        for (std::size_t k = 0; k < result.speeds.size(); ++k) {
            const double speed = result.speeds[k];
            const std::vector<Complex> right = seen(speed);
            std::vector<Complex> printed;
            double fastest = 0;
            for (const results::CampbellMode &mode : result.modes) {
                if (!mode.frequency[k])
                    continue;
                fastest = std::max(fastest, *mode.frequency[k]);
                const double turned = std::abs(*mode.frequency_rotating[k]);
                printed.emplace_back(*mode.real[k], turned);
                EXPECT_TRUE(std::ranges::any_of(right,
                                                [&](Complex l) {
                                                    return std::abs(l - printed.back()) <
                                                           1e-6 * std::abs(l) + 1e-6 * speed;
                                                }))
                    << printed.back() << " at " << speed;
                EXPECT_FALSE(at_rest_in_rotor(printed.back(), eta))
                    << mode.label << " at " << speed;
                // In fixed axes it turns by the spin speed more or less.
                EXPECT_LT(std::min(std::abs(turned + speed - *mode.frequency[k]),
                                   std::abs(std::abs(turned - speed) - *mode.frequency[k])),
                          1e-9 * (speed + turned));
            }
            for (const Complex l : right) // surely among the slowest, whichever way it whirls
                if (-l.real() < 0.5 / eta && l.imag() + speed < fastest) {
                    EXPECT_TRUE(std::ranges::any_of(
                        printed,
                        [l](Complex other) { return std::abs(l - other) < 1e-6 * std::abs(l); }))
                        << l << " is missing at " << speed;
                }
        }
        // At a crossing with 1x a motion stands still in the rotor, or turns back at twice the
        // speed.
        for (const results::Crossing &crossing : result.crossings) {
            if (crossing.multiple != 1)
                continue;
            ++crossed;
            const double near = 1e-3 * crossing.speed; // two that meet part like a root
            EXPECT_TRUE(std::ranges::any_of(
                seen(crossing.speed),
                [&](Complex l) {
                    return (l.imag() < near || std::abs(l.imag() - 2 * crossing.speed) < near) &&
                           -l.real() < 0.5 / eta;
                }))
                << "no whirl at " << crossing.speed;
        }
        // Where motions begin or cease to stand still a crossing is listed, or the end of a lock.
        const auto standing = [&](double speed) {
            return std::ranges::count_if(
                seen(speed), [eta](Complex l) { return l.imag() == 0 && -l.real() < 0.3 / eta; });
        };
        constexpr int parts = 40;
        auto before = standing(top / parts / 2);
        for (int n = 1; n < parts; ++n) {
            const double low = top * (n - 0.5) / parts;
            const double high = top * (n + 0.5) / parts;
            const auto now = standing(high);
            const auto within = [low, high](double speed) { return speed > low && speed < high; };
            if (now != before) {
                const bool listed =
                    std::ranges::any_of(
                        result.crossings,
                        [&](const auto &c) { return c.multiple == 1 && within(c.speed); }) ||
                    std::ranges::any_of(result.locked, [&](const results::Locked &l) {
                        return l.multiple == 1 && (within(l.from) || within(l.to));
                    });
                EXPECT_TRUE(listed) << before << " to " << now << ", " << low << " to " << high;
            }
            before = now;
        }
    }
    EXPECT_GE(crossed, 20);
}

} // namespace damped_scenes

// Axes of [map] and [sweep] over dimensionless numbers of the rotor, and values of an axis that no
// rotor has.

#include "analyses/show.h"
#include "analyses/stability.h"
#include "analyses/sweep.h"
#include "input/case_file.h"
#include "results/show.h"
#include "results/stability.h"
#include "results/sweep.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace dimensionless_test {

using namespace whirl;

/// Units of mass, length and time over kg, m and s.
struct Scale {
    double mass = 1, length = 1, time = 1;
    [[nodiscard]] double inertia() const { return mass * length * length; }
    [[nodiscard]] double stiffness() const { return mass / time / time; }
};

// Gorbenko's base set: the rotor around the balls, two of them in the plane of a point mass.
constexpr double M_r = 57.83;
constexpr double A_r = 0.413;
constexpr double C_r = 0.289;
constexpr double n = 2;
constexpr double R = 0.2;
constexpr double m_0 = 2;
constexpr double z_GA = 0.1;
constexpr double k = 2e6; // of each of two bearings
// The shaft weighs 1e-12 of it: what follows leaves it out.
constexpr double without_shaft = 1e-11;

/// The set in other units, rigid on two bearings.
/// @param rest  further sections; {t} of it are rad/s
std::string base_set(const std::string &rest, const Scale &s = {}) {
    return fmt::format("format = 1\n[material.weightless]\nE = {}\nnu = 0.3\nrho = "
                       "{}\n[shaft]\nrigid = true\n"
                       "segments = [{{length = {}, outer = {}}}]\n"
                       "[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n"
                       "[[balancer]]\nz = {}\nkind = \"ball\"\nn = 2\nmass = {}\nradius = {}\n"
                       "damping = {}\nimbalance = {}\nimbalance_radius = {}\n",
                       2e11 * s.stiffness() / s.length, 1e-8 * s.mass / std::pow(s.length, 3),
                       0.9 * s.length, 0.08 * s.length, 0.4 * s.length, M_r * s.mass,
                       A_r * s.inertia(), C_r * s.inertia(), (0.4 + z_GA) * s.length, 2 * s.mass,
                       R * s.length, 20 * s.mass / s.time, m_0 * R * s.mass * s.length,
                       R * s.length) +
           fmt::format("[[bearing]]\nz = {0}\nk = {2}\nc = {3}\n[[bearing]]\nz = {1}\nk = {2}\n"
                       "c = {3}\n",
                       0.1 * s.length, 0.8 * s.length, k * s.stiffness(), 500 * s.mass / s.time) +
           rest;
}

class Dimensionless : public testing::Test {
  protected:
    /// The file of a case, for this test alone.
    [[nodiscard]] static input::CaseFile case_file(const std::string &text) {
        const auto *test = testing::UnitTest::GetInstance()->current_test_info();
        const auto file = std::filesystem::path(testing::TempDir()) /
                          fmt::format("dimensionless_{}.toml", test->name());
        std::ofstream(file) << text;
        return input::CaseFile(file);
    }
    [[nodiscard]] static results::StabilityResult stability_of(const std::string &text) {
        const input::CaseFile file = case_file(text);
        return analyses::stability(
            file.load(), [&file](const std::vector<std::string> &more) { return file.load(more); });
    }
    [[nodiscard]] static results::StabilityMap map_of(const std::string &text) {
        return stability_of(text).map.value();
    }
};

const std::string speeds = "[speeds]\nfrom = 100\nto = 900\ncount = 3\n";

/// Mass of a ball with which n m is that share of the composite rotor's mass, theory 5.1.
double ball_mass(double share) { return share * (M_r + m_0) / (1 - share) / n; }

double omega_0(double share) { return std::sqrt(2 * k / (M_r + m_0 + n * ball_mass(share))); }

// Roots are found to 1e-10 of the number; the growth follows the masses no more than as steeply,
// near its zeros by their size.
constexpr double found = 1e-9;

void expect_same(const std::vector<double> &a, const std::vector<double> &b, double scale = 1) {
    ASSERT_EQ(a.size(), b.size());
    double largest = 0;
    for (const double value : b)
        largest = std::max(largest, std::abs(value));
    ASSERT_GT(largest, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i] * scale, b[i], found * largest) << i;
}

TEST_F(Dimensionless, map_over_share_of_balls_is_that_over_their_masses) {
    const std::array shares{0.04, 0.12};
    const std::string speed = "[map]\nx = {path = \"speed\", from = 100, to = 900, count = 5}\n";
    const auto over = map_of(
        base_set(speeds + speed +
                 "y = {path = \"balancer[*].mass\", dimensionless = \"m\", from = 0.04, to = 0.12, "
                 "count = 2}\n"));
    const auto plain = map_of(
        base_set(speeds + speed +
                 fmt::format("y = {{path = \"balancer[*].mass\", from = {}, to = {}, count = 2}}\n",
                             ball_mass(shares[0]), ball_mass(shares[1]))));
    ASSERT_EQ(over.growth.size(), 2U);
    for (std::size_t j = 0; j < 2; ++j) {
        EXPECT_NEAR(over.y.values[j], shares[j], 1e-15);
        EXPECT_NEAR(over.y_changes[j][0] / ball_mass(shares[j]), 1, 1e-10 + without_shaft);
        expect_same(over.growth[j], plain.growth[j]);
    }
}

TEST_F(Dimensionless, speeds_are_over_omega_0_of_each_rotor) {
    const std::array shares{0.04, 0.12};
    const auto over = map_of(
        base_set(speeds + "[map]\nx = {path = \"speed\", dimensionless = \"Omega\", from = 0.5, "
                          "to = 4, count = 4}\n"
                          "y = {path = \"balancer[0].mass\", dimensionless = \"m\", from = 0.04, "
                          "to = 0.12, count = 2}\n"));
    for (std::size_t j = 0; j < 2; ++j) {
        const double w0 = omega_0(shares[j]);
        const auto plain = map_of(base_set(
            speeds +
            fmt::format("[map]\nx = {{path = \"speed\", from = {}, to = {}, count = 4}}\n"
                        "y = {{path = \"balancer[0].mass\", from = {}, to = {}, count = 2}}\n",
                        0.5 * w0, 4 * w0, ball_mass(shares[0]), ball_mass(shares[1]))));
        expect_same(over.growth[j], plain.growth[j]);
        expect_same(over.x_changes[j], plain.x.values);
    }
    // The same with the speed upwards.
    const auto turned = map_of(
        base_set(speeds + "[map]\ny = {path = \"speed\", dimensionless = \"Omega\", from = 0.5, "
                          "to = 4, count = 4}\n"
                          "x = {path = \"balancer[0].mass\", dimensionless = \"m\", from = 0.04, "
                          "to = 0.12, count = 2}\n"));
    for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(turned.growth[i][j], over.growth[j][i]);
            EXPECT_EQ(turned.y_changes[i][j], over.x_changes[j][i]);
            EXPECT_EQ(turned.x_changes[i][j], over.y_changes[j][i]);
        }
}

/// C/A_Sigma of the composite rotor, theory 5.1.
double polar_over_diametral(double Ip, double mass) {
    const double added = m_0 + n * mass;
    const double M = M_r + added;
    const double z_A = M_r * z_GA / M;
    const double z_G = -added * z_GA / M;
    const double on_circle = (m_0 + n * mass) * R * R;
    return (Ip + on_circle) / (A_r + M_r * z_G * z_G + added * z_A * z_A + on_circle / 2);
}

TEST_F(Dimensionless, two_numbers_are_had_together) {
    const auto map = map_of(base_set(
        speeds + "[map]\nx = {path = \"disc[0].Ip\", dimensionless = \"C\", from = 0.8, to = 1.1, "
                 "count = 3}\n"
                 "y = {path = \"balancer[0].mass\", dimensionless = \"m\", from = 0.04, to = 0.12, "
                 "count = 2}\n"));
    for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
            const double mass = map.y_changes[j][i];
            EXPECT_NEAR(n * mass / (M_r + m_0 + n * mass), map.y.values[j], found);
            EXPECT_NEAR(polar_over_diametral(map.x_changes[j][i], mass), map.x.values[i], found);
            EXPECT_TRUE(std::isfinite(map.growth[j][i]));
        }
}

TEST_F(Dimensionless, map_of_a_rotor_in_other_units_is_the_same) {
    const Scale scale{3.7, 0.23, 1.9};
    const auto text = [](const Scale &s) {
        return base_set(
            fmt::format("[speeds]\nfrom = {}\nto = {}\ncount = 3\n", 100 / s.time, 900 / s.time),
            s);
    };
    // Balls and the point mass together: E stays.
    const std::string together =
        "path = [\"balancer[0].mass\", \"balancer[0].imbalance\"], change = \"factor\", "
        "dimensionless = \"m\", from = 0.02, to = 0.2, count = 3}\n";
    for (const std::string &x :
         {"x = {path = \"speed\", dimensionless = \"Omega\", from = 0.5, to = 4, count = 5}\n",
          "x = {path = \"disc[0].Ip\", dimensionless = \"C\", from = 1, to = 1.2, count = 2}\n",
          "x = {path = \"balancer[0].z\", dimensionless = \"z_A\", from = 0.2, to = 1, count = "
          "2}\n",
          "x = {path = \"bearing[*].c\", dimensionless = \"h_x\", from = 0.01, to = 0.1, "
          "count = 2}\n"}) {
        const auto own = map_of(text({}) + "[map]\n" + x + "y = {" + together);
        const auto other = map_of(text(scale) + "[map]\n" + x + "y = {" + together);
        ASSERT_EQ(own.growth.size(), other.growth.size());
        for (std::size_t j = 0; j < own.growth.size(); ++j) {
            expect_same(other.growth[j], own.growth[j], scale.time);
            expect_same(other.y_changes[j], own.y_changes[j]); // factors
        }
    }
}

/// Over the place of a bearing that begins near the other one p2 has its least in between, which
/// both sides of a dip that is hardly deep enough must show: the rotor found has the number.
TEST_F(Dimensionless, numbers_beyond_a_dip_are_found) {
    std::string set = base_set(speeds);
    const std::string bearing = "[[bearing]]\nz = 0.1\n";
    ASSERT_NE(set.find(bearing), std::string::npos);
    set.replace(set.find(bearing), bearing.size(), "[[bearing]]\nz = 0.5\n");
    const input::CaseFile file =
        case_file(set + "[map]\nx = {path = \"speed\", from = 100, to = 900, count = 2}\n"
                        "y = {path = \"bearing[0].z\", dimensionless = \"p2\", from = 8.3, "
                        "to = 8.73, count = 24}\n");
    const auto with = [&file](const std::vector<std::string> &more) { return file.load(more); };
    const results::StabilityMap map = analyses::stability(file.load(), with).map.value();
    const auto p2_at = [&](double z) {
        const auto shown = analyses::show(with({fmt::format("bearing[0].z={:.17g}", z)}));
        return shown.dimensionless.p2.value();
    };
    // It dips: less in between than where the bearing begins and at the largest of the map.
    EXPECT_LT(p2_at(map.y_changes.front()[0]), p2_at(0.5));
    for (std::size_t j = 0; j < 24; ++j) {
        ASSERT_TRUE(std::isfinite(map.y_changes[j][0])) << map.y.values[j];
        EXPECT_NEAR(p2_at(map.y_changes[j][0]) / map.y.values[j], 1, found);
    }
}

TEST_F(Dimensionless, sweep_over_the_polar_inertia) {
    const input::CaseFile file = case_file(base_set(
        speeds + "[sweep]\nof = [\"critical\"]\nx = {path = \"disc[0].Ip\", dimensionless = \"C\", "
                 "values = [0.6, 0.9]}\n"));
    const auto with = [&file](const std::vector<std::string> &more) { return file.load(more); };
    const results::SweepResult result = analyses::sweep(file.load(), with);
    ASSERT_EQ(result.changes.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const double Ip = result.changes[i].at(0);
        EXPECT_NEAR(polar_over_diametral(Ip, 2), result.axes[0].values[i], found);
        const auto shown = analyses::show(with({fmt::format("disc[0].Ip={}", Ip)}));
        EXPECT_NEAR(shown.balancers.at(0).dimensionless.rotor.C, result.axes[0].values[i], found);
    }
}

TEST_F(Dimensionless, states_are_followed_over_a_number) {
    const std::string states = speeds + "[states]\nspeeds = [600]\n[map]\nx = {";
    const auto over = stability_of(
        base_set(states + "path = \"balancer[0].mass\", dimensionless = \"m\", from = 0.05, "
                          "to = 0.1, count = 2}\n"));
    const auto plain = stability_of(
        base_set(states + fmt::format("path = \"balancer[0].mass\", from = {}, to = {}, count = "
                                      "2}}\n",
                                      ball_mass(0.05), ball_mass(0.1))));
    ASSERT_TRUE(over.states && plain.states);
    ASSERT_EQ(over.states->states.size(), plain.states->states.size());
    for (std::size_t i = 0; i < plain.states->states.size(); ++i) {
        const auto &a = over.states->states[i];
        const auto &b = plain.states->states[i];
        EXPECT_NEAR(ball_mass(a.value) / b.value, 1, found);
        EXPECT_EQ(a.kind, b.kind);
        EXPECT_EQ(a.stable, b.stable);
        EXPECT_NEAR(a.growth, b.growth, found * std::abs(b.growth) + b.growth_error);
    }
    ASSERT_EQ(over.states->changes.size(), 2U);
    EXPECT_NEAR(over.states->changes[1] / ball_mass(0.1), 1, found);
}

bool has_note(const results::StabilityResult &result, const std::string &words) {
    for (const model::Sentence &note : result.model.notes)
        if (note.find(words) != std::string::npos)
            return true;
    return false;
}

TEST_F(Dimensionless, states_leave_out_values_that_the_model_refuses) {
    const auto over = [](const std::string &speed, const std::string &range) {
        return stability_of(base_set(speeds + "[states]\nspeeds = [" + speed +
                                     "]\n[map]\nx = {path = \"balancer[0].mass\", " + range +
                                     ", count = 2}\n"));
    };
    const auto some = over("600", "from = 0, to = 2"); // no ball has no mass
    const auto both = over("600", "from = 1.5, to = 2");
    ASSERT_TRUE(some.states && both.states);
    std::size_t at_two = 0;
    for (const auto &state : both.states->states)
        at_two += state.value == 2 ? 1 : 0;
    EXPECT_GT(at_two, 0U);
    EXPECT_EQ(some.states->states.size(), at_two);
    for (const auto &state : some.states->states)
        EXPECT_EQ(state.value, 2);
    EXPECT_EQ(some.states->refused, std::vector{0.0});
    EXPECT_TRUE(has_note(some, "balancer[0].mass = 0 kg, there is no such rotor"));
    EXPECT_FALSE(over("600", "from = -2, to = -1").states);
    // At rest: named by the key that was given.
    const auto at_rest = over("0", "from = 1.5, to = 2");
    EXPECT_FALSE(at_rest.states);
    EXPECT_TRUE(has_note(at_rest, "states.speeds: expected a spin speed other than 0"));
    EXPECT_FALSE(has_note(at_rest, "speeds.from"));
}

TEST_F(Dimensionless, number_out_of_reach_leaves_its_points_empty_and_says_the_range) {
    const auto map =
        map_of(base_set(speeds + "[map]\nx = {path = \"speed\", from = 100, to = 900, count = 2}\n"
                                 "y = {path = \"balancer[0].mass\", dimensionless = \"m\", from = "
                                 "0.1, to = 1.2, count = 2}\n"));
    EXPECT_TRUE(std::isfinite(map.growth[0][0]));
    EXPECT_TRUE(std::isnan(map.growth[1][0]));
    EXPECT_TRUE(std::isnan(map.y_changes[1][0]));
    for (const char *word : {"dimensionless_number_out_of_reach", ".toml:", "map.y.dimensionless: ",
                             "expected m from ", " to 1,", "got 1.2"})
        EXPECT_NE(map.why.find(word), std::string::npos) << word << " in " << map.why;
}

TEST_F(Dimensionless, anisotropic_rotor_without_balancers) {
    // p^2 = c_beta M/(A c_x), A = dI/Id, h_x = 2c/(M omega_0) of a disc between two equal bearings.
    const double M = 10;
    const double Id = 0.2;
    const double half = 0.3;
    const std::string rotor = fmt::format(
        "format = 1\n[material.weightless]\nE = 2e11\nnu = 0.3\nrho = 1e-8\n[shaft]\nrigid = true\n"
        "segments = [{{length = {0}, outer = 0.05}}]\n[[disc]]\nz = {1}\nmass = {2}\nId = {3}\n"
        "Ip = 0.16\n[[anisotropy]]\nz = {1}\ndI = 0.02\n[[bearing]]\nz = 0\nk = 1e6\nc = 100\n"
        "[[bearing]]\nz = {0}\nk = 1e6\nc = 100\n",
        2 * half, half, M, Id);
    const auto shown = analyses::show(case_file(rotor).load());
    const results::RotorNumbers &numbers = shown.dimensionless;
    const double w0 = std::sqrt(2e6 / M);
    constexpr double rounding = 1e-9; // what the shaft weighs beside the disc: 1e-12
    EXPECT_NEAR(numbers.C, 0.16 / Id, rounding);
    EXPECT_NEAR(numbers.A.value(), 0.02 / Id, rounding);
    EXPECT_NEAR(numbers.p2.value(), M * half * half / Id, rounding);
    EXPECT_NEAR(numbers.c_y.value(), 0, rounding);
    EXPECT_NEAR(numbers.h_x.value(), 200 / (M * w0), rounding);
    EXPECT_NEAR(numbers.h_beta.value(), 200 * half * half / (Id * w0), rounding);
    EXPECT_NEAR(numbers.omega_0.value() / w0, 1, rounding);
    // From none: the least anisotropy at which it grows is that of the closed form, theory 5.2, in
    // units of omega_0.
    const double Omega = 4;
    const double p2 = M * half * half / Id;
    const double h = 200 * half * half / (Id * w0);
    const double limit = std::hypot(p2 / (Omega * Omega) - 0.2, h / Omega);
    const auto map = map_of(
        rotor + speeds +
        fmt::format("[map]\nx = {{path = \"speed\", dimensionless = \"Omega\", from = 2, to = {}, "
                    "count = 2}}\ny = {{path = \"anisotropy[0].dI\", dimensionless = \"A\", from = "
                    "0, to = {}, count = 3}}\n",
                    Omega, 2 * limit * (1 + 1e-6)));
    EXPECT_NEAR(map.y_changes[0][1], 0, 1e-15);
    EXPECT_LE(map.growth[0][1], 0);
    EXPECT_GT(map.growth[1][1], 0);
    const auto below = map_of(
        rotor + speeds +
        fmt::format("[map]\nx = {{path = \"speed\", dimensionless = \"Omega\", from = 2, to = {}, "
                    "count = 2}}\ny = {{path = \"anisotropy[0].dI\", dimensionless = \"A\", from = "
                    "0, to = {}, count = 3}}\n",
                    Omega, 2 * limit * (1 - 1e-6)));
    EXPECT_LT(below.growth[1][1], 0);
}

} // namespace dimensionless_test

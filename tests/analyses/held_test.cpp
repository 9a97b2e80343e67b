// Balancers with held = true: every command against the same rotor with discs, anisotropies and
// imbalances by hand; against Lagrange's equations of all balls and rings; against closed forms.

#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/rigid_limit.h"
#include "analyses/show.h"
#include "analyses/stability.h"
#include "cases/program_run.h"
#include "input/case_file.h"
#include "oracles/carried.h"
#include "oracles/rotating_state.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <unistd.h>

namespace {

using namespace whirl;
using nlohmann::json;
using std::numbers::pi;
using Complex = std::complex<double>;

/// A case file of this test.
std::string written(const std::string &text, const std::string &name) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / fmt::format("held_{}_{}.toml", getpid(), name);
    std::ofstream(file) << "format = 1\n" << text;
    return file.string();
}

// --- every command, by hand ---------------------------------------------------------------------

const std::string elastic_rotor = R"(
[material.steel]
E = 2.1e11
nu = 0.3
rho = 7800
[shaft]
order = 3
segments = [{length = 0.3, outer = "40 mm"}, {length = 0.3, outer = "50 mm"}, {length = 0.4, outer = "40 mm"}]
[[disc]]
z = 0.3
mass = 12
Id = 0.06
Ip = 0.1
[[bearing]]
z = 0
k = 2e7
c = 2000
[[bearing]]
z = 1
k = 3e7
c = 3000
[[plane]]
z = 0.3
[[plane]]
z = 0.6
[[imbalance]]
z = 0.3
mr = 2e-4
phase = 0.5
[speeds]
from = 20
to = 900
count = 12
)";
const std::string settings = R"(
[samples]
count = 3
seed = 5
of = ["critical"]
[[samples.vary]]
path = "bearing[0].k"
distribution = "uniform"
from = 1.9e7
to = 2.1e7
)";

/// Balls off balance, pendulums off their rest and rings, held; of the balancers the same kinds of
/// free ones are nowhere.
const std::string held_balancers = R"(
[[balancer]]
z = 0.6
n = 3
mass = 0.4
radius = 0.12
damping = 5
imbalance = 0.02
imbalance_radius = 0.1
imbalance_phase = 0.3
held = true
[[balancer]]
kind = "pendulum4"
z = 0.45
mass = 0.2
arm = 0.06
pivot = 0.02
damping = 0.1
held = true
[[balancer]]
kind = "ring"
z = 0.75
n = 2
mass = 0.5
journal_radius = 0.03
clearance = 0.01
outer_radius = 0.06
damping = 1
drag = 0.01
imbalance = 0.004
held = true
)";
const std::string held_start = R"(
[simulate]
time = 0.4
ball_angles = [[0.2, 1.9, 4.0], [0.4, -0.3], [2.0, -1.0]]
)";
const std::string by_hand_start = "[simulate]\ntime = 0.4\n";

/// What is fixed in the rotor, in TOML, from its point masses.
class ByHand {
  public:
    void add(double m, double r, double angle) {
        _mass += m;
        _inertia += m * r * r;
        _second += m * r * r * std::polar(1.0, 2 * angle);
        _moment += m * r * std::polar(1.0, angle);
    }
    void add_own(double inertia) { _inertia += inertia; }
    void add_eccentricity(double mr) { _moment += mr; }
    [[nodiscard]] std::string text(double z) const {
        return fmt::format("[[disc]]\nz = {0}\nmass = {1:.17g}\nId = {2:.17g}\nIp = {3:.17g}\n"
                           "[[anisotropy]]\nz = {0}\ndI = {4:.17g}\nangle = {5:.17g}\n"
                           "[[imbalance]]\nz = {0}\nmr = {6:.17g}\nphase = {7:.17g}\n",
                           z, _mass, _inertia / 2, _inertia, std::abs(_second) / 2,
                           std::arg(_second) / 2, std::abs(_moment), std::arg(_moment));
    }

  private:
    double _mass = 0, _inertia = 0;
    Complex _second, _moment;
};

std::string parts_by_hand() {
    ByHand balls;
    for (const double angle : {0.2, 1.9, 4.0})
        balls.add(0.4, 0.12, angle);
    balls.add(0.02 / 0.1, 0.1, 0.3);
    ByHand pendulums;
    for (const auto &[line, f] : {std::pair(0.0, 0.4), std::pair(pi / 2, -0.3)})
        for (const double side : {1.0, -1.0}) {
            const Complex place =
                (side * (0.02 + 0.06 * std::cos(f)) + Complex(0, 0.06 * std::sin(f))) *
                std::polar(1.0, line);
            pendulums.add(0.2, std::abs(place), std::arg(place));
        }
    ByHand rings;
    for (const double angle : {2.0, -1.0}) {
        rings.add(0.5, 0.01, angle);
        rings.add_own(0.5 * (0.04 * 0.04 + 0.06 * 0.06) / 2);
    }
    rings.add_eccentricity(0.004);
    return balls.text(0.6) + pendulums.text(0.45) + rings.text(0.75);
}

/// Paths at which two results differ by more than `tolerance`: relative, of a list to its largest.
/// Names, notes, times, errors and residuals are not compared.
class Differences {
  public:
    explicit Differences(double tolerance) : _tolerance(tolerance) {}

    void compare(const json &a, const json &b, const std::string &path, double scale = 0) {
        if (a.is_number() && b.is_number()) {
            const auto x = a.get<double>();
            const auto y = b.get<double>();
            scale = std::max({scale, std::abs(x), std::abs(y)});
            if (!(std::abs(x - y) <= _tolerance * scale))
                _found += fmt::format("{}: {:.17g} {:.17g}\n", path, x, y);
            return;
        }
        if (a.type() != b.type() || a.size() != b.size()) {
            _found += path + ": unlike\n";
            return;
        }
        if (a.is_object())
            for (const auto &[key, value] : a.items()) {
                static const std::vector<std::string> left_out{
                    "notes", "provenance", "case", "seconds", "residual", "balancers", "title",
                    "findings", "why", "steps", "rate_evaluations", "audit",
                    // differences of the size of rounding, and what a step of the integrator,
                    // which rounding moves, sees of an amplitude
                    "rounding", "relative_difference", "rate", "series"};
                // A deviation is made of differences of values next to their mean: it takes up
                // 1e-15 of that, a millionth of the tolerance.
                const bool spread =
                    key == "deviation" && a.contains("mean") && a["mean"].is_number();
                if (std::ranges::find(left_out, key) == left_out.end() &&
                    key.find("error") == std::string::npos)
                    compare(value, b.contains(key) ? b[key] : json(), path + "/" + key,
                            spread ? 1e-6 * std::abs(a["mean"].get<double>()) : 0);
            }
        else if (a.is_array())
            for (std::size_t i = 0; i < a.size(); ++i)
                compare(a[i], b[i], fmt::format("{}/{}", path, i), largest(a));
        else if (a.is_string() ? without_error(a) != without_error(b) : a != b)
            _found += fmt::format("{}: {} {}\n", path, a.dump(), b.dump());
        ++_compared;
    }
    [[nodiscard]] const std::string &found() const { return _found; }
    [[nodiscard]] int compared() const { return _compared; }

  private:
    double _tolerance;
    std::string _found;
    int _compared = 0;

    /// `accuracy` says an error in the sentence on its reference, of the size of rounding.
    static std::string without_error(const std::string &text) {
        constexpr std::string_view before = " differs from it by ";
        const std::size_t place = text.find(before);
        return text.substr(0, place == std::string::npos ? place : place + before.size());
    }

    static double largest(const json &list) {
        double out = 0;
        for (const json &item : list)
            if (item.is_number())
                out = std::max(out, std::abs(item.get<double>()));
        return out;
    }
};

json result_of(const std::string &command, const std::string &file,
               const std::vector<std::string> &options = {}) {
    std::vector<std::string> arguments{command, file, "--json", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const std::string errors = testing::TempDir() + fmt::format("held_errors_{}", getpid());
    const tests::ProgramRun run = tests::run_program(WHIRL_PROGRAM, arguments, errors);
    std::remove(errors.c_str());
    EXPECT_EQ(run.status, 0) << run.errors;
    return run.status == 0 ? json::parse(run.output) : json();
}

class HeldInCommand : public testing::TestWithParam<const char *> {};

// The two files describe one rotor up to the rounding of its numbers, some 1e-16 of them, which
// eigenvalues and motions take up some hundred times; the motion in time is integrated to 1e-8.
TEST_P(HeldInCommand, is_the_rotor_by_hand) {
    const std::string command = GetParam();
    const std::string held =
        written(elastic_rotor + held_balancers + held_start + settings, "held_" + command);
    const std::string by_hand =
        written(elastic_rotor + parts_by_hand() + by_hand_start + settings, "by_hand_" + command);
    std::vector<std::string> options;
    if (command == "simulate")
        options = {"--set", "speeds.count=1", "--set", "speeds.from=300"};
    const json a = result_of(command, held, options);
    const json b = result_of(command, by_hand, options);
    Differences differences(command == "simulate" ? 1e-6 : 1e-9);
    differences.compare(a, b, "");
    EXPECT_EQ(differences.found(), "");
    EXPECT_GT(differences.compared(), 10);
}

INSTANTIATE_TEST_SUITE_P(Commands, HeldInCommand,
                         testing::Values("show", "campbell", "critical", "stability", "response",
                                         "balance", "rigid-limit", "simulate", "modes", "samples",
                                         "accuracy"),
                         [](const auto &test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

// --- against Lagrange's equations ---------------------------------------------------------------

/// Rigid rotors with balls and rings, some held, some free, drawn at random.
class DrawnRotor {
  public:
    explicit DrawnRotor(unsigned seed) : _generator(seed) {}

    double draw(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(_generator);
    }
    int pick(int from, int to) { return std::uniform_int_distribution<int>(from, to)(_generator); }

    [[nodiscard]] std::string rotor(double speed) {
        return fmt::format(
            "[material.weightless]\nE = 2e11\nnu = 0.3\nrho = 1e-8\n"
            "[shaft]\nrigid = true\nsegments = [{{length = 1, outer = 0.04, material = "
            "\"weightless\"}}]\n"
            "[[disc]]\nz = {}\nmass = 8\nId = {}\nIp = {}\n"
            "[[bearing]]\nz = {}\nk = {}\nc = {}\n[[bearing]]\nz = {}\nk = {}\nc = {}\n"
            "[speeds]\nfrom = {:.17g}\ncount = 1\n",
            draw(0.3, 0.7), draw(0.2, 0.5), draw(0.05, 0.38), draw(0, 0.2), draw(2e4, 8e4),
            draw(20, 200), draw(0.8, 1), draw(2e4, 8e4), draw(20, 200), speed);
    }
    /// One ball or ring that balances exactly; or two balls.
    [[nodiscard]] std::string free_balancer(int kind) {
        const double imbalance = draw(0.002, 0.02);
        const double z = draw(0.1, 0.9);
        if (kind == 1) {
            const double clearance = draw(0.005, 0.02);
            return fmt::format("[[balancer]]\nkind = \"ring\"\nz = {}\nn = 1\nmass = {:.17g}\n"
                               "journal_radius = 0.03\nclearance = {:.17g}\nouter_radius = 0.08\n"
                               "damping = {}\ndrag = {}\nimbalance = {:.17g}\n",
                               z, imbalance / clearance, clearance, draw(0.5, 5),
                               draw(0.0005, 0.01), imbalance);
        }
        const int n = kind == 0 ? 1 : 2;
        const double E = kind == 0 ? 1 : draw(1.1, 3);
        const double radius = draw(0.05, 0.2);
        return fmt::format("[[balancer]]\nz = {}\nn = {}\nmass = {:.17g}\nradius = {:.17g}\n"
                           "damping = {}\nimbalance = {:.17g}\n",
                           z, n, E * imbalance / (n * radius), radius, draw(0.2, 3), imbalance);
    }
    /// With more mass, on or off balance.
    [[nodiscard]] std::string held_balancer(bool point_mass) {
        const std::string imbalance = point_mass
                                          ? fmt::format("imbalance = {}\nimbalance_radius = {}\n",
                                                        draw(0.01, 0.05), draw(0.05, 0.2))
                                          : "imbalance = 0.01\n";
        if (pick(0, 2) == 0)
            return fmt::format("[[balancer]]\nkind = \"ring\"\nz = {}\nn = 2\nmass = {}\n"
                               "journal_radius = 0.03\nclearance = 0.02\nouter_radius = 0.08\n"
                               "held = true\n{}",
                               draw(0.1, 0.9), draw(2.5, 6), imbalance);
        return fmt::format("[[balancer]]\nz = {}\nn = {}\nmass = {}\nradius = {}\nheld = true\n{}",
                           draw(0.1, 0.9), pick(2, 4), draw(0.5, 1.5), draw(0.1, 0.2), imbalance);
    }

  private:
    std::mt19937 _generator;
};

/// Largest real part by Lagrange's equations of all balls and rings, 1/s. Where a free ring has
/// turned to is of no account: a root 0 each, left out.
double growth_by_lagrange(const std::string &file) {
    const oracles::CaseRotor rotor = oracles::read_case(file, {});
    const oracles::CarriedRotor carried(rotor, rotor.speed_from);
    std::vector<oracles::Complex> all = carried.eigenvalues(oracles::balanced_angles(rotor));
    std::ranges::sort(all, {}, [](const oracles::Complex &lambda) { return std::abs(lambda); });
    const auto turned = std::ranges::count_if(
        carried.beads(), [](const oracles::Bead &bead) { return bead.ring && !bead.held; });
    double out = -HUGE_VAL;
    for (auto lambda = all.begin() + turned; lambda != all.end(); ++lambda)
        out = std::max(out, static_cast<double>(lambda->real()));
    return out;
}

double growth_of(const std::string &file) {
    const model::Case scene = input::load_case(file);
    const results::StabilityResult result = analyses::stability(scene, {});
    return result.growth.at(0);
}

class HeldByLagrange : public testing::TestWithParam<int> {};

// Nothing is free: eigenvalues of the body with all its points, on balance and off it.
TEST_P(HeldByLagrange, rotors_with_held_balancers_alone) {
    DrawnRotor drawn(static_cast<unsigned>(100 + GetParam()));
    const double speed = drawn.draw(30, 400);
    std::string text = drawn.rotor(speed) + drawn.held_balancer(GetParam() % 2 == 0) +
                       drawn.held_balancer(GetParam() % 3 == 0);
    const std::string file = written(text, "alone");
    EXPECT_NEAR(growth_of(file), growth_by_lagrange(file), 1e-9 * speed);
}

// One ball or one ring that balances exactly moves across its diameter alone; beside balancers
// that are held, and beside two balls that are free.
TEST_P(HeldByLagrange, one_ball_or_ring_at_capacity_one) {
    DrawnRotor drawn(static_cast<unsigned>(500 + GetParam()));
    const double speed = drawn.draw(60, 400);
    std::string text = drawn.rotor(speed) + drawn.free_balancer(GetParam() % 2);
    if (GetParam() % 3 == 1)
        text += drawn.held_balancer(GetParam() % 4 == 0);
    if (GetParam() % 3 == 2)
        text += drawn.free_balancer(GetParam() % 4);
    const std::string file = written(text, "one");
    EXPECT_NEAR(growth_of(file), growth_by_lagrange(file), 1e-9 * speed);
}

INSTANTIATE_TEST_SUITE_P(Drawn, HeldByLagrange, testing::Range(0, 24));

// The eigenvalues in planes that are printed as a verdict: those of the balls' papers, -4.978 and
// -4.207 1/s by Lagrange's equations.
TEST(OneBall, dies_out_and_is_not_neutral) {
    const std::string rotor = R"([material.weightless]
E = 2e11
nu = 0.3
rho = 1e-8
[shaft]
segments = [{length = 1, outer = "40 mm", material = "weightless"}]
rigid = true
[[disc]]
z = 0.5
mass = 10
Id = 0.5
Ip = 0.2
[[bearing]]
z = 0
k = 5e4
c = 50
[[bearing]]
z = 1
k = 5e4
c = 50
[speeds]
from = 200
count = 1
)";
    const std::string ring = R"([[balancer]]
kind = "ring"
z = 0.5
n = 1
mass = 0.1
journal_radius = "40 mm"
clearance = "10 mm"
outer_radius = "60 mm"
damping = 2
drag = 0.001
imbalance = 0.001
)";
    const auto ball = [](int n) {
        return fmt::format("[[balancer]]\nz = 0.5\nn = {}\nmass = {}\nradius = 0.1\ndamping = {}\n"
                           "imbalance = 0.005\n",
                           n, 0.05 / n, 1.0 / n);
    };
    for (const std::string &one : {ring, ball(1)}) {
        const std::string file = written(rotor + one, "one_alone");
        const results::StabilityResult result = analyses::stability(input::load_case(file), {});
        EXPECT_EQ(result.verdict.at(0), results::Verdict::stable);
        EXPECT_NEAR(result.growth.at(0), growth_by_lagrange(file), 1e-9);
        EXPECT_EQ(result.neutral_pairs, 0);
        EXPECT_LT(result.growth.at(0), -4);
    }
    // Two halves of the ball in one place can roll apart: to first order nothing holds them.
    const results::StabilityResult two =
        analyses::stability(input::load_case(written(rotor + ball(2), "two")), {});
    EXPECT_EQ(two.verdict.at(0), results::Verdict::neutral);
    EXPECT_EQ(two.growth.at(0), 0);
    EXPECT_EQ(two.neutral_pairs, 1);
}

// --- the composite rotor whose balls sit still --------------------------------------------------

/// The composite rotor of Gorbenko's figures with six balls, in numbers: M_s, A_Sigma, C and the
/// anisotropy by sums over its points about its centre of mass.
struct SixBalls {
    double mass = 57.83 + 4 + 2;
    double centre = (57.83 * 0.4 + 6 * 0.5) / mass;
    double A = 0.413 + 57.83 * std::pow(centre - 0.4, 2) + 6 * std::pow(0.5 - centre, 2) +
               (4 + 2) * 0.04 / 2;
    double polar; ///< with that of the disc
    double a = 0.5 * (2 * 0.04 + 4 * 0.04 * 0.5);

    explicit SixBalls(double disc) : polar(disc + 6 * 0.04) {}
};

/// Where [p^2 - (1 - C) x]^2 + h^2 x < a^2 x^2, x the squared speed: by bisection of the sign.
std::vector<double> signs_change(const std::function<double(double)> &f, double to) {
    std::vector<double> out;
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        double low = to * i / steps;
        double high = to * (i + 1) / steps;
        if (f(low) * f(high) > 0)
            continue;
        for (int k = 0; k < 60; ++k) {
            const double middle = (low + high) / 2;
            (f(low) * f(middle) > 0 ? low : high) = middle;
        }
        out.push_back((low + high) / 2);
    }
    return out;
}

const std::string six_balls = WHIRL_ROOT "/cases/six_balls/case.toml";

// S1's condition with the composite rotor's numbers: `stability`, the chart of `show` and both
// sides of `rigid-limit`.
TEST(SixBallsHeld, are_unstable_where_the_closed_form_says) {
    for (const auto &[Ip, c] : {std::pair(0.289, 500.0), std::pair(0.1, 100.0)}) {
        const SixBalls body(Ip);
        const double p2 = 2 * 2e6 * 0.35 * 0.35 / body.A;
        const double h = 2 * c * 0.35 * 0.35 / body.A;
        const double C = body.polar / body.A;
        const double a = body.a / body.A;
        const auto a4 = [&](double speed) {
            const double x = speed * speed;
            return std::pow(p2 - (1 - C) * x, 2) + h * h * x - a * a * x * x;
        };
        const double to = 24000 * pi / 30;
        std::vector<double> ends = signs_change(a4, to);
        ASSERT_EQ(ends.size(), Ip > 0.2 ? 1U : 2U);
        if (ends.size() == 1)
            ends.push_back(to);
        const std::vector<std::string> set{"balancer[*].held=true",
                                           fmt::format("disc[0].Ip={}", Ip),
                                           fmt::format("bearing[*].c={}", c)};
        const model::Case scene = input::load_case(six_balls, set);
        const auto unstable = analyses::stability(scene, {}).unstable;
        ASSERT_EQ(unstable.size(), 1U);
        EXPECT_NEAR(unstable[0].from, ends[0], 1e-9 * ends[0]);
        EXPECT_NEAR(unstable[0].to, ends[1], 1e-9 * ends[1]);
        const results::ShowResult shown = analyses::show(scene);
        ASSERT_TRUE(shown.anisotropy && shown.anisotropy->unstable);
        EXPECT_NEAR(shown.anisotropy->unstable->from, ends[0], 1e-9 * ends[0]);
        EXPECT_EQ(shown.anisotropy->unstable->to.has_value(), Ip < 0.2);
        EXPECT_TRUE(shown.balancers.at(0).held);
        EXPECT_NEAR(shown.balancers.at(0).dA.value(), 0.08, 1e-14);
        EXPECT_NEAR(shown.dI.value(), 0.08, 1e-14);
        // The same on an elastic shaft that stiffens.
        std::vector<std::string> elastic = set;
        elastic.emplace_back("shaft.rigid=false");
        const results::RigidLimitResult limit =
            analyses::rigid_limit(input::load_case(six_balls, elastic));
        int found = 0;
        for (const results::RigidLimitRow &row : limit.rows) {
            if (!row.elements.empty() || !row.quantity.starts_with("unstable"))
                continue;
            const double end =
                row.quantity.text() == "unstable range, upper end" ? ends[1] : ends[0];
            EXPECT_NEAR(row.closed_form, end, 1e-9 * end) << row.quantity;
            EXPECT_LT(std::abs(row.relative_difference.back().value()), 1e-5) << row.quantity;
            EXPECT_LT(row.rate.value(), -0.9) << row.quantity; // falls as 1/stiffness
            ++found;
        }
        EXPECT_EQ(found, Ip > 0.2 ? 1 : 2);
    }
}

// Held at their balanced position, `critical` of an undamped rotor is what it is with free balls,
// which it holds by itself.
TEST(SixBallsHeld, have_the_critical_speeds_of_free_balls) {
    const std::vector<std::string> undamped{"bearing[*].c=0", "shaft.rigid=false",
                                            "disc[0].Ip=0.1"};
    std::vector<std::string> held = undamped;
    held.emplace_back("balancer[*].held=true");
    const auto free = analyses::critical_speeds(input::load_case(six_balls, undamped));
    const auto fixed = analyses::critical_speeds(input::load_case(six_balls, held));
    ASSERT_GE(free.critical_speeds.size(), 3U);
    ASSERT_EQ(free.critical_speeds.size(), fixed.critical_speeds.size());
    for (std::size_t i = 0; i < free.critical_speeds.size(); ++i)
        EXPECT_NEAR(fixed.critical_speeds[i].speed / free.critical_speeds[i].speed, 1, 1e-10);
}

// Two balls at E = 2 leave no anisotropy: the rotor is axisymmetric, in the planar form.
TEST(Held, without_anisotropy_is_an_axisymmetric_rotor) {
    const std::string file = WHIRL_ROOT "/cases/composite_rotor/case.toml";
    const model::Case scene =
        input::load_case(file, {"balancer[*].held=true", "bearing[*].c=0", "speeds.count=5"});
    EXPECT_FALSE(scene.rotor.rotating_anisotropy());
    const results::CampbellResult held = analyses::campbell(scene);
    EXPECT_TRUE(results::is_planar(held.model.formulation.form));
    const std::string rotor = R"([material.weightless]
E = 2e11
nu = 0.3
rho = 1e-8
[shaft]
segments = [{length = 0.9, outer = "80 mm"}]
rigid = true
[[disc]]
z = 0.4
mass = 57.83
Id = 0.413
Ip = 0.289
[[disc]]
z = 0.5
mass = 6
Id = 0.12
Ip = 0.24
[[bearing]]
z = 0.1
k = 2e6
[[bearing]]
z = 0.8
k = 2e6
[speeds]
from = 0
to = "6000 rpm"
count = 5
)";
    const results::CampbellResult by_hand =
        analyses::campbell(input::load_case(written(rotor, "triangle")));
    ASSERT_EQ(held.modes.size(), by_hand.modes.size());
    for (std::size_t i = 0; i < held.modes.size(); ++i)
        for (std::size_t k = 0; k < held.speeds.size(); ++k)
            EXPECT_NEAR(held.modes[i].frequency[k].value(), by_hand.modes[i].frequency[k].value(),
                        1e-9);
}

} // namespace

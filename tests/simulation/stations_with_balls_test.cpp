// Stations of motions with balancers: as without them, and balanced at the stations too; against
// two-node elements of the oracles with the balls fixed where they ended.

#include "analyses/simulate.h"
#include "input/case_file.h"
#include "oracles/dense_rotor.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <unistd.h>

namespace whirl::simulation::stations_with_balls_test {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using results::SimulateResult;

std::string written(const std::string &text) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                       fmt::format("stations_with_balls_{}.toml", getpid());
    std::ofstream(file) << "format = 1\n" << text;
    return file.string();
}

SimulateResult motion_of(const std::string &text, const std::vector<std::string> &set = {}) {
    return analyses::simulate(input::load_case(written(text), set));
}

// --- drawn rotors -------------------------------------------------------------------------------

struct DrawnBalancer {
    double z, imbalance, ball, radius;
};

/// An elastic shaft with two discs on two bearings, one or two balancers whose balls and imbalance
/// do not resist tilting, and imbalances elsewhere, which leave couples.
struct DrawnRotor {
    std::string shaft, balancers;
    std::vector<DrawnBalancer> drawn;

    explicit DrawnRotor(unsigned seed) {
        std::mt19937 generator(seed);
        const auto draw = [&](double from, double to) {
            return std::uniform_real_distribution<double>(from, to)(generator);
        };
        const bool both = seed % 2 == 0;
        const double k = draw(1e5, 4e5);
        const double ky = seed % 3 == 0 ? 1.3 * k : k;
        shaft = fmt::format(
            "[material.steel]\nE = 2.1e11\nnu = 0.3\nrho = 7800\n[shaft]\norder = 1\n"
            "segments = [{{length = 0.3, outer = 0.04, material = \"steel\", elements = 2}}, "
            "{{length = 0.3, outer = 0.05, material = \"steel\", elements = 2}}, "
            "{{length = 0.4, outer = 0.04, material = \"steel\", elements = 2}}]\n"
            "[[disc]]\nz = 0.3\nmass = {}\nId = 0.05\nIp = 0.08\n"
            "[[disc]]\nz = 0.6\nmass = {}\nId = 0.05\nIp = 0.08\n"
            "[[bearing]]\nz = 0\nkxx = {}\nkyy = {}\ncxx = 500\ncyy = 500\n"
            "[[bearing]]\nz = 1\nkxx = {}\nkyy = {}\ncxx = 600\ncyy = 600\n"
            "[speeds]\nfrom = {}\ncount = 1\n",
            draw(6, 12), draw(6, 12), k, ky, 1.2 * k, 1.2 * ky, draw(450, 600));
        if (seed % 4 != 1) // what balls at the balancers cannot take, small or large
            shaft += fmt::format("[[imbalance]]\nz = 0.15\nmr = {:.17g}\nphase = {}\n",
                                 draw(0, 1.5e-3), draw(-pi, pi));
        for (int i = 0; i <= (both ? 1 : 0); ++i) {
            const double imbalance = draw(1e-3, 3e-3);
            const double radius = draw(0.06, 0.1);
            drawn.push_back(
                {i == 0 ? 0.3 : 0.6, imbalance, draw(1.5, 2.5) * imbalance / (2 * radius), radius});
            const DrawnBalancer &b = drawn.back();
            balancers += fmt::format("[[balancer]]\nz = {}\nn = 2\nmass = {:.17g}\n"
                                     "radius = {:.17g}\ndamping = {:.17g}\nimbalance = {:.17g}\n"
                                     "tilt_inertia = false\n",
                                     b.z, b.ball, b.radius, 40 * b.ball, b.imbalance);
        }
        balancers += fmt::format(
            "[simulate]\ntime = 10\nreduction_tolerance = 1e-5\nball_angles = [[{}, {}]{}]\n",
            draw(0, 3), draw(3, 6), both ? fmt::format(", [{}, {}]", draw(0, 3), draw(3, 6)) : "");
    }

    /// Balls as masses on the axis and what they and the imbalances of their balancers leave.
    [[nodiscard]] std::string with_balls_at(const std::vector<std::vector<double>> &angles) const {
        std::string text = shaft;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            Complex left = drawn[i].imbalance;
            for (const double angle : angles[i])
                left += std::polar(drawn[i].ball * drawn[i].radius, angle);
            text += fmt::format("[[disc]]\nz = {0}\nmass = {1:.17g}\n"
                                "[[imbalance]]\nz = {0}\nmr = {2:.17g}\nphase = {3:.17g}\n",
                                drawn[i].z, 2 * drawn[i].ball, std::abs(left), std::arg(left));
        }
        return text;
    }
    [[nodiscard]] std::string without_balls() const {
        std::string text = shaft;
        for (const DrawnBalancer &b : drawn)
            text += fmt::format("[[imbalance]]\nz = {}\nmr = {:.17g}\n", b.z, b.imbalance);
        return text;
    }
};

class StationsWithBalls : public testing::TestWithParam<int> {};

TEST_P(StationsWithBalls, are_judged_as_with_the_balls_fixed_where_they_end) {
    const DrawnRotor drawn(static_cast<unsigned>(GetParam()));
    const SimulateResult result = motion_of(drawn.shaft + drawn.balancers);
    std::vector<std::vector<double>> angles;
    for (const results::BalancerMotion &b : result.balancers)
        angles.push_back(b.angles);
    const auto fixed = oracles::read_case(written(drawn.with_balls_at(angles)), {});
    const auto bare = oracles::read_case(written(drawn.without_balls()), {});
    double left = 0;
    double without = 0;
    ASSERT_GE(result.stations.size(), 4U); // ends and discs at least
    for (const results::StationMotion &station : result.stations) {
        const double frozen = oracles::semi_major(fixed, result.speed, station.z);
        const double alone = oracles::semi_major(bare, result.speed, station.z);
        left = std::max(left, frozen);
        without = std::max(without, alone);
        ASSERT_TRUE(station.steady) << station.z;
        EXPECT_NEAR(*station.steady, alone, 1e-8 * alone) << station.z;
        if (station.with_balls) { // angles are printed to the last digit
            EXPECT_NEAR(*station.with_balls, frozen, 1e-6 * without) << station.z;
        }
        EXPECT_GE(station.peak.value, station.amplitude * (1 - 1e-3)) << station.z;
    }
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        EXPECT_NEAR(result.balancers[i].reference,
                    oracles::semi_major(bare, result.speed, drawn.drawn[i].z), 1e-8 * without);
    const std::string word = results::outcome_name(result.outcome);
    if (word != "balanced" && word != "offset")
        return;
    // The reduced shaft is good to 1e-5 of the largest response to forces, of which imbalance and
    // balls, far larger than what they leave together, are some hundreds.
    for (const results::StationMotion &station : result.stations)
        EXPECT_NEAR(station.amplitude, *station.with_balls, 5e-3 * without) << station.z;
    if (std::abs(left / without - 0.1) > 0.01) {
        EXPECT_EQ(word, left / without < 0.1 ? "balanced" : "offset") << result.evidence;
    }
}

INSTANTIATE_TEST_SUITE_P(Drawn, StationsWithBalls, testing::Range(0, 24));

// --- a drum with stiff ends ---------------------------------------------------------------------

SimulateResult drum_at(const char *speed) {
    return analyses::simulate(
        input::load_case(std::filesystem::path(WHIRL_ROOT) / "cases" / "extractor_two_plane",
                         {"speeds.count=1", std::string("speeds.from=") + speed}));
}

// The few shapes of a motion in time against the steady motion of the whole rotor with the balls
// fixed where they end, at every station: also at those at which the orbit is a fourth of the
// largest. What is left is the balls' approach to their places.
TEST(StationsOfADrum, move_as_those_of_the_whole_rotor) {
    const SimulateResult result = drum_at("1562.5");
    EXPECT_EQ(result.outcome, results::Outcome::offset);
    ASSERT_GE(result.stations.size(), 6U);
    for (const results::StationMotion &station : result.stations) {
        ASSERT_TRUE(station.with_balls) << station.z;
        EXPECT_NEAR(station.amplitude, *station.with_balls, 3e-4 * *station.with_balls)
            << station.z;
    }
}

// Small motions about the balanced position die out by 5.1 1/s: e^-20 of them is left after 4 s.
// Shapes that only carry deflections must not ring on.
TEST(StationsOfADrum, come_to_rest_as_fast_as_the_eigenvalues_say) {
    const SimulateResult result = drum_at("562.5");
    EXPECT_EQ(result.outcome, results::Outcome::balanced);
    ASSERT_TRUE(result.linear_growth && result.residual_ratio && result.station_ratio);
    EXPECT_LT(*result.linear_growth, -5);
    const double left = 100 * std::exp(*result.linear_growth * result.time);
    EXPECT_LT(*result.residual_ratio, left);
    EXPECT_LT(*result.station_ratio, left);
}

// --- the same rotor with balls that weigh nothing -----------------------------------------------

// Balls of a nanogram change nothing: the peaks and steady values of the rotor without balancers,
// in a run-up (explicit steps) and at constant speed (long steps in turning axes).
TEST(StationsWithBallsAlone, are_those_of_the_rotor_without) {
    const std::string rotor = R"([material.steel]
E = 2.1e11
nu = 0.3
rho = 7800
[shaft]
segments = [{length = 0.5, outer = 0.03}, {length = 0.5, outer = 0.03}]
order = 3
[[disc]]
name = "wheel"
z = 0.5
mass = 10
Id = 0.05
Ip = 0.1
[[bearing]]
name = "left"
z = 0
k = 5e6
c = 500
[[bearing]]
z = 1
k = 5e6
c = 500
[[imbalance]]
z = 0.5
mr = 1e-4
[[probe]]
z = 0.8
)";
    const std::string ball = "[[balancer]]\nz = 0.5\nn = 2\nmass = 1e-12\nradius = 0.1\n"
                             "damping = 1e-11\n";
    for (const bool run_up : {true, false}) {
        const std::string drive = run_up
                                      ? "[simulate]\ntime = 4\nrun_up = {to = 500, duration = 4}\n"
                                      : "[speeds]\nfrom = 200\ncount = 1\n[simulate]\ntime = 2\n";
        const std::vector<std::string> closely{"simulate.reduction_tolerance=1e-6"};
        const SimulateResult with = motion_of(rotor + ball + drive, closely);
        const SimulateResult without = motion_of(rotor + drive, closely);
        ASSERT_EQ(with.stations.size(), without.stations.size());
        double largest = 0;
        for (const results::StationMotion &station : without.stations)
            largest = std::max(largest, station.peak.value);
        for (std::size_t i = 0; i < with.stations.size(); ++i) {
            const results::StationMotion &a = with.stations[i];
            const results::StationMotion &b = without.stations[i];
            EXPECT_EQ(a.z, b.z);
            EXPECT_EQ(a.name, b.name);
            // What the two reductions differ by, relative to the largest motion as they are.
            EXPECT_NEAR(a.peak.value, b.peak.value, 1e-5 * largest) << a.z;
            EXPECT_NEAR(a.peak.time, b.peak.time, 1e-3) << a.z;
            EXPECT_NEAR(a.amplitude / b.amplitude, 1, 2e-3) << a.z; // parts of steps
            ASSERT_EQ(a.steady.has_value(), b.steady.has_value());
            EXPECT_NEAR(*a.steady / *b.steady, 1, 1e-8) << a.z;
            ASSERT_EQ(a.steady_peak.has_value(), b.steady_peak.has_value());
            if (a.steady_peak) {
                EXPECT_NEAR(*a.steady_peak / *b.steady_peak, 1, 1e-8) << a.z;
            }
        }
        EXPECT_EQ(with.steady.speeds.size(), without.steady.speeds.size());
        EXPECT_EQ(with.waterfall.has_value(), without.waterfall.has_value());
        EXPECT_EQ(with.series.amplitude.size(), 1U); // of the balancer's plane, as ever
    }
}

// --- a rig with washers in one plane, and one slow approach of balls -----------------------------

/// S. Rodrigues et al., single-plane rig: two washers, an imbalance in the disc and a couple of
/// 3.2028e-6 x 0.2 kg m2 that they cannot take.
const std::string rig = R"([material.weightless]
E = 2e11
G = 7.7e10
rho = 1e-9
[shaft]
segments = [{length = 0.36, outer = 0.01}]
rigid = true
[[disc]]
z = 0.2
mass = 1.28
Id = 0.0138
Ip = 0.00124
[[bearing]]
name = "B1"
z = 0.31
kxx = 21500.0
kyy = 15800.0
cxx = 5.375
cyy = 3.95
[[bearing]]
name = "B2"
z = 0.05
kxx = 21500.0
kyy = 15800.0
cxx = 5.375
cyy = 3.95
[[imbalance]]
z = 0.2
mr = 2.48e-05
phase = 4.34586983746588
[[imbalance]]
z = 0.3
mr = 3.2028e-06
[[imbalance]]
z = 0.1
mr = -3.2028e-06
[[balancer]]
z = 0.18
n = 2
mass = 0.00044
radius = 0.0428
damping = 0.007717845952318927
tilt_inertia = false
[speeds]
from = "4000 rpm"
count = 1
[simulate]
time = 8
ball_angles = [[4.3468698374658805, 4.34486983746588]]
)";

TEST(Rig, is_not_balanced_where_a_couple_is_left_at_the_bearings) {
    const SimulateResult result = motion_of(rig);
    EXPECT_EQ(results::outcome_name(result.outcome), "offset") << result.evidence;
    EXPECT_LT(result.residual_ratio.value(), 0.01);
    EXPECT_GT(result.station_ratio.value(), 0.3);
    ASSERT_TRUE(result.at_rest);
    // By hand: U = sum mr, couple sum mr (z - z_c), z_c of disc and washers.
    const double centre = (1.28 * 0.2 + 2 * 0.00044 * 0.18) / (1.28 + 2 * 0.00044);
    const Complex e = std::polar(1.0, 4.34586983746588);
    Complex washers = 0;
    for (const double angle : result.balancers[0].angles)
        washers += std::polar(0.00044 * 0.0428, angle);
    const Complex U = 2.48e-5 * e + washers;
    const Complex couple = 2.48e-5 * e * (0.2 - centre) + 3.2028e-6 * (0.3 - centre) -
                           3.2028e-6 * (0.1 - centre) + washers * (0.18 - centre);
    EXPECT_NEAR(result.at_rest->imbalance, std::abs(U), 1e-9 * 2.48e-5);
    EXPECT_NEAR(result.at_rest->couple, std::abs(couple), 1e-9 * 6.4e-7);
    EXPECT_NE(result.evidence.find("a couple of"), std::string::npos) << result.evidence;
    const auto station = [&](double z) {
        return *std::ranges::find(result.stations, z, &results::StationMotion::z);
    };
    // The oracle has no elements of a rigid shaft: one of 1e6 times the stiffness.
    std::string frozen = rig.substr(0, rig.find("[[balancer]]"));
    frozen.replace(frozen.find("rigid = true"), 12, "order = 1");
    frozen.replace(frozen.find("2e11"), 4, "2e17");
    frozen.replace(frozen.find("7.7e10"), 6, "7.7e16");
    frozen.replace(frozen.find("outer = 0.01}"), 13, "outer = 0.01, material = \"weightless\"}");
    frozen += fmt::format("[[disc]]\nz = 0.18\nmass = 0.00088\n[[imbalance]]\nz = 0.18\n"
                          "mr = {:.17g}\nphase = {:.17g}\n[speeds]\nfrom = 1\n",
                          std::abs(washers), std::arg(washers));
    const auto fixed = oracles::read_case(written(frozen), {});
    for (const double z : {0.05, 0.31}) {
        const double stays = oracles::semi_major(fixed, result.speed, z);
        EXPECT_GT(stays, 9e-6);
        EXPECT_NEAR(station(z).with_balls.value(), stays, 1e-5 * stays) << z;
        EXPECT_NEAR(station(z).amplitude, stays, 0.01 * stays) << z;
    }
}

/// Two races on orthotropic bearings far below balance: their balls leave the start slowly and come
/// together, after some 4e4 s.
const std::string slow = R"([material.weightless]
E = 2e11
G = 7.7e10
rho = 1e-12
[shaft]
segments = [{length = 8.0, outer = 0.01}]
rigid = true
[[disc]]
z = 4.0
mass = 1
Id = 3.25
Ip = 0.5
[[bearing]]
z = 7.0
kxx = 0.5
kyy = 2.5
cxx = 0.01
cyy = 0.05
[[bearing]]
z = 1.0
kxx = 0.5
kyy = 2.5
cxx = 0.01
cyy = 0.05
[[balancer]]
z = 6.0
n = 2
mass = 0.0001
radius = 1
damping = 1.0000000000000002e-06
imbalance = 5.2299954237177545e-05
imbalance_phase = 0.41395469681563923
tilt_inertia = false
[[balancer]]
z = 2.0
n = 2
mass = 0.0001
radius = 1
damping = 1.0000000000000002e-06
imbalance = 2.9630997904038515e-05
imbalance_phase = 2.352153575996712
tilt_inertia = false
[speeds]
from = 0.4
count = 1
[simulate]
time = 1
ball_angles = [[1.5707963267948966, -1.5707963267948966], [1.5707963267948966, -1.5707963267948966]]
)";

class SlowApproach : public testing::TestWithParam<double> {};

TEST_P(SlowApproach, has_one_word_whatever_the_time) {
    const SimulateResult result = motion_of(slow, {fmt::format("simulate.time={}", GetParam())});
    EXPECT_EQ(results::outcome_name(result.outcome), "undecided") << result.evidence;
}

INSTANTIATE_TEST_SUITE_P(Times, SlowApproach,
                         testing::Values(100.0, 300.0, 700.0, 1500.0, 3000.0, 5000.0, 6500.0,
                                         9000.0, 14000.0, 22000.0));

/// Between two times the balls still move, but slowly: neither the one word nor the other is true
/// yet, whichever of the two times the run ended at.
class DrawnSlowApproach : public testing::TestWithParam<int> {};

TEST_P(DrawnSlowApproach, is_undecided_while_the_balls_move) {
    tests::Random draw(static_cast<unsigned>(3300 + GetParam()));
    const double ball = draw(0.5e-4, 2e-4);
    std::vector<std::string> set;
    for (const int i : {0, 1}) {
        const auto key = [i](const std::string &name) {
            return fmt::format("balancer[{}].{}", i, name);
        };
        set.push_back(fmt::format("{}={}", key("mass"), ball));
        set.push_back(fmt::format("{}={}", key("damping"), 0.01 * ball));
        // What the balls can balance, 2 m R at most.
        set.push_back(fmt::format("{}={}", key("imbalance"), draw(0.2, 0.8) * 2 * ball));
        set.push_back(fmt::format("{}={}", key("imbalance_phase"), draw(-pi, pi)));
        set.push_back(fmt::format("bearing[{}].kxx={}", i, draw(0.4, 0.8)));
        set.push_back(fmt::format("bearing[{}].kyy={}", i, draw(1.5, 3)));
    }
    const double time = draw(200, 2000);
    const auto at = [&set](double end) {
        std::vector<std::string> all = set;
        all.push_back(fmt::format("simulate.time={}", end));
        return motion_of(slow, all);
    };
    const SimulateResult first = at(time);
    const SimulateResult later = at(1.5 * time);
    double moved = 0;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            moved = std::max(
                moved, std::abs(std::remainder(
                           later.balancers[i].angles[j] - first.balancers[i].angles[j], 2 * pi)));
    ASSERT_GT(moved, 1e-3);
    for (const SimulateResult *result : {&first, &later})
        EXPECT_EQ(results::outcome_name(result->outcome), "undecided") << result->evidence;
}

INSTANTIATE_TEST_SUITE_P(Drawn, DrawnSlowApproach, testing::Range(0, 20));

TEST(SlowApproachEnd, is_an_offset) {
    const SimulateResult result = motion_of(slow, {"simulate.time=60000"});
    EXPECT_EQ(results::outcome_name(result.outcome), "offset") << result.evidence;
    for (const results::BalancerMotion &b : result.balancers)
        EXPECT_NEAR(b.angles[0], b.angles[1], 1e-3);
}

} // namespace

} // namespace whirl::simulation::stations_with_balls_test

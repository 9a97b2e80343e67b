// Balls that stand and slip in turn, on a flexible rotor.

#include "analyses/simulate.h"
#include "input/case_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace whirl::simulation::dry_drum_test {
namespace {

/// A drum in soft bearings, and one start of many of four balls in each of two races.
constexpr const char *drum = R"(format = 1
[material.steel]
E = "206 GPa"
nu = 0.3
rho = 7850
[shaft]
order = 5
segments = [{length = 0.25, outer = 0.1}, {length = 1.7, outer = 0.24, inner = 0.22},
            {length = 0.25, outer = 0.1}]
[[disc]]
z = 0.25
outer = 0.36
inner = 0.1
width = 0.015
[[disc]]
z = 1.95
outer = 0.36
inner = 0.1
width = 0.03
[[bearing]]
z = 0.05
k = 1.5e6
c = 1500
[[bearing]]
z = 2.15
k = 2e6
c = 2000
[speeds]
from = "7500 rpm"
count = 1
[simulate]
time = 0.6
reduction_tolerance = 3e-3 # the shapes in which it happened
ball_angles = [[0.6978319591103511, "100 deg", 3.002410105684052, "280 deg"],
               [-0.07471498318986597, "110 deg", "200 deg", "290 deg"]]
)";

constexpr const char *race = R"(
n = 4
mass = 0.05
radius = 0.16
damping = 1
imbalance = 0.01
rolling_resistance = 0.5e-6
contact = true
)";

// One ball is let go at the limit of its friction while another one moves slower than can be told
// from rest: whether the first one moves depends on the second. Decided one after the other they
// were let go and held again without end, at 0.31 s.
TEST(Rolling, DecidesTogetherWhichBallsAreLetGo) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "dry_drum";
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / "case.toml");
    file << drum;
    for (const char *z : {"0.28", "1.92"})
        file << "[[balancer]]\nz = " << z << race;
    file.close();
    const model::Case scene = input::load_case(folder);
    const results::SimulateResult result = analyses::simulate(scene);
    EXPECT_EQ(result.time, scene.simulate.time);
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-8 * result.audit.energy_scale);
    // Little momentum is left where balls stand: a thousand steps of the tolerance 1e-8.
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-5 * result.audit.momentum_scale);
}

} // namespace
} // namespace whirl::simulation::dry_drum_test

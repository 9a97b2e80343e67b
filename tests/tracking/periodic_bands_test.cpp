// Diagrams of rotors whose equations stay periodic in time: by the rotor on few shapes against
// Hill's series of the whole one, and over grids.

#include "analyses/campbell.h"
#include "modes/spectrum.h"
#include "results/campbell.h"
#include "support/written_case.h"
#include "tracking/bands/locked_whirl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace periodic_bands_test {

using namespace whirl;

/// A drum with a ball balancer at its front end, whose bearings differ between their directions.
constexpr const char *drum = R"(
[shaft]
order = 3
segments = [
  {length = 0.25, outer = 0.1, material = "s"},
  {length = 1.7, outer = 0.24, inner = 0.22, material = "s"},
  {length = 0.25, outer = 0.1, material = "s"},
]
[[disc]]
z = 0.25
mass = 12
Id = 0.1
Ip = 0.2
[[disc]]
z = 1.95
mass = 24
Id = 0.2
Ip = 0.4
[[bearing]]
z = 0.05
kxx = 1.5e6
kyy = 2e6
cxx = 1500
cyy = 1500
[[bearing]]
z = 2.15
kxx = 2e6
kyy = 2.5e6
cxx = 2000
cyy = 2000
[[balancer]]
z = 0.28
kind = "ball"
n = 2
mass = 0.05
radius = 0.16
damping = 1
imbalance = 0.01
[campbell]
modes = 4
[speeds]
from = 100
to = 500
count = 3
)";

constexpr int order = 3;

results::CampbellResult diagram(int count) {
    model::Case scene = tests::written_case(drum);
    scene.speeds->count = count;
    return analyses::campbell(scene);
}

TEST(PeriodicBands, AreTheSameOnEveryGrid) {
    const results::CampbellResult coarse = diagram(3);
    ASSERT_GE(coarse.locked.size(), 3U);
    for (const int count : {6}) {
        const results::CampbellResult other = diagram(count);
        ASSERT_EQ(other.locked.size(), coarse.locked.size()) << count;
        for (std::size_t i = 0; i < coarse.locked.size(); ++i) {
            EXPECT_NEAR(other.locked[i].from / coarse.locked[i].from, 1, 1e-8) << count;
            EXPECT_NEAR(other.locked[i].to / coarse.locked[i].to, 1, 1e-8) << count;
        }
        ASSERT_EQ(other.crossings.size(), coarse.crossings.size()) << count;
        for (std::size_t i = 0; i < coarse.crossings.size(); ++i)
            EXPECT_NEAR(other.crossings[i].speed / coarse.crossings[i].speed, 1, 1e-8) << count;
    }
}

/// As many bands cover a speed as motions of the whole rotor's Hill series stand still there, just
/// inside and just outside every end too.
TEST(PeriodicBands, CoverASpeedAsOftenAsMotionsStandStillThere) {
    const model::Case scene = tests::written_case(drum);
    const std::vector<results::Locked> locked = diagram(3).locked;
    const modes::SpectrumSolver whole(scene.rotor, results::Form::hill, order);
    std::vector<double> speeds;
    for (int k = 0; k < 12; ++k) // off every grid that the search may use
        speeds.push_back(100 + 400 * (k + 0.37) / 12.2);
    constexpr double beside = 1e-6;
    for (const results::Locked &band : locked)
        for (const double end : {band.from, band.to})
            for (const double side : {-beside, beside})
                if (end > 100 && end < 500)
                    speeds.push_back(end * (1 + side));
    for (const double speed : speeds) {
        const auto covering =
            std::count_if(locked.begin(), locked.end(), [speed](const results::Locked &band) {
                return band.multiple == 1 && band.from <= speed && speed <= band.to;
            });
        EXPECT_EQ(covering, tracking::locked_motions(whole.at(speed, 10))) << speed;
    }
}

TEST(PeriodicLines, AreModesOfTheWholeRotorsSeries) {

    const results::CampbellResult result = diagram(3);
    const model::Case scene = tests::written_case(drum);
    const modes::SpectrumSolver whole(scene.rotor, results::Form::hill, order);
    for (std::size_t k = 0; k < result.speeds.size(); ++k) {
        const modes::Spectrum all = whole.at(result.speeds[k], 16);
        for (const results::CampbellMode &mode : result.modes) {
            if (!mode.frequency[k])
                continue;
            const std::complex<double> value(*mode.real[k], *mode.frequency[k]);
            double nearest = HUGE_VAL;
            for (const modes::WhirlMode &other : all.modes)
                nearest = std::min(nearest, std::abs(other.eigenvalue - value));
            EXPECT_LT(nearest, 1e-9 * std::abs(value)) << mode.label << " " << result.speeds[k];
        }
    }
}

/// Next to rest half a turn takes so long that the matrix knows nothing of damped motions: lines
/// are not followed through speeds there that nobody asked for.
TEST(PeriodicLines, AreNotLookedForWhereTheMatrixCannotTell) {
    const model::Case scene = tests::written_case(drum);
    const modes::SpectrumSolver whole(scene.rotor, results::Form::hill, order);
    const auto few = whole.by_monodromy(100, 500, 10);
    EXPECT_TRUE(few->by_matrix());
    EXPECT_TRUE(few->by_matrix(500, 10));
    EXPECT_FALSE(few->by_matrix(0.2, 10));
    EXPECT_FALSE(few->by_matrix(0, 10));
    EXPECT_FALSE(whole.by_matrix(500, 10));
}

} // namespace periodic_bands_test

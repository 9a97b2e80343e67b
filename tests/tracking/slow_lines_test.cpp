// Diagrams of rotors whose equations stay periodic in time, far below all frequencies, where
// motions may not be found: by a series with many more harmonics; and crossings in the form with
// constant coefficients where there is one.

#include "analyses/campbell.h"
#include "modes/spectrum.h"
#include "results/campbell.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

namespace slow_lines_test {

using namespace whirl;

/// Within half a turn the tilt's frequencies change by hundreds of rad/s.
constexpr const char *unlike = R"(
[shaft]
rigid = true
segments = [{length = 1.5, outer = 0.1, material = "s"}]
[[disc]]
z = 0.7
mass = 120
Id = 6
Ip = 4.5
[[anisotropy]]
z = 0.7
dI = 0.9
[[bearing]]
z = 0
kxx = 3e7
kyy = 1.2e7
cxx = 9000
cyy = 9000
[[bearing]]
z = 1.5
kxx = 1.5e7
kyy = 0.9e7
cxx = 7000
cyy = 5000
[campbell]
modes = 4
[speeds]
from = 5
to = 10
count = 2
)";

bool has_note(const results::CampbellResult &result, const std::string &words) {
    return std::ranges::any_of(result.model.notes, [&words](const std::string &note) {
        return note.find(words) != std::string::npos;
    });
}

/// From the nearest of these motions or of their copies, as large as it itself.
double off(std::complex<double> value, const modes::Spectrum &motions) {
    double least = HUGE_VAL;
    for (const modes::WhirlMode &motion : motions.modes)
        for (const std::complex<double> other :
             {motion.rotating_value, std::conj(motion.rotating_value)}) {
            const std::complex<double> apart = value - other;
            least = std::min(
                least, std::hypot(apart.real(), std::remainder(apart.imag(), 2 * motions.speed)));
        }
    return least / std::abs(value);
}

/// The frequencies from the fixed frame differ from those in rotating axes by the spin speed.
void expect_errors_that_hold(bool reduction) {
    constexpr int harmonics = 40;
    model::Case scene = tests::written_case(unlike);
    scene.reduction = reduction;
    const modes::SpectrumSolver many(scene.rotor, results::Form::hill, 1, 1, harmonics);
    const modes::Spectrum motions = many.at(scene.speeds->from, 4);
    for (const int count : {2, 3}) {
        scene.speeds->count = count;
        const results::CampbellResult result = analyses::campbell(scene);
        int without = 0;
        for (const results::CampbellMode &mode : result.modes) {
            if (!mode.frequency.front())
                continue;
            const std::complex<double> value(*mode.real.front(),
                                             *mode.frequency.front() + motions.speed);
            if (mode.error.front())
                EXPECT_LE(off(value, motions), *mode.error.front() + 1e-9) << mode.label;
            else
                ++without;
        }
        // Hill's series alone does not find all so near to rest.
        EXPECT_EQ(without, reduction ? 0 : 2) << count;
        EXPECT_NE(has_note(result, "modes may be missing"), reduction);
    }
}

TEST(SlowLines, AreWithinTheirErrorsOrHaveNone) { expect_errors_that_hold(true); }
TEST(SlowLines, AreWithinTheirErrorsOrHaveNoneWithoutReduction) { expect_errors_that_hold(false); }

/// Bearings that differ, and nothing that turns does.
constexpr const char *round_rotor = R"(
[shaft]
order = 3
segments = [
  {length = 0.5, outer = 0.05, material = "s"},
  {length = 0.5, outer = 0.05, material = "s"},
]
[[disc]]
z = 0.5
mass = 14
Id = 0.06
Ip = 0.11
[[bearing]]
z = 0
kxx = 2.4e7
kyy = 1.9e7
cxx = 1500
cyy = 1100
[[bearing]]
z = 1
k = 3e7
c = 800
[campbell]
modes = 2
[speeds]
from = 300
to = 420
count = 2
)";

TEST(PeriodicCrossings, OfARoundRotorAreThoseOfTheConstantForm) {
    model::Case scene = tests::written_case(round_rotor);
    scene.formulation = model::FormChoice::general;
    const results::CampbellResult constant = analyses::campbell(scene);
    scene.formulation = model::FormChoice::hill;
    const results::CampbellResult periodic = analyses::campbell(scene);
    ASSERT_EQ(constant.crossings.size(), 2U);
    ASSERT_EQ(periodic.crossings.size(), constant.crossings.size());
    for (std::size_t i = 0; i < constant.crossings.size(); ++i)
        EXPECT_NEAR(periodic.crossings[i].speed / constant.crossings[i].speed, 1, 1e-11);
    EXPECT_FALSE(has_note(periodic, "could be verified"));
    EXPECT_FALSE(has_note(periodic, "not confirmed"));
}

} // namespace slow_lines_test

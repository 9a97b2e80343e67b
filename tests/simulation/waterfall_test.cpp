// Spectra of windows of a motion that is made of circles at frequencies of the spectrum.

#include "simulation/stations/waterfall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::simulation {
namespace {

/// Circles forward and backward at the same frequency are an ellipse, of which the spectrum gives
/// the larger semi-axis; Hann's window shows half of it at the frequencies next to it.
TEST(Waterfall, GivesTheLargerSemiAxisAtEachFrequency) {
    constexpr double end = 20; ///< s: long enough for windows of 512 samples
    constexpr double fastest = 300;
    constexpr std::size_t slow = 20; ///< of the frequencies
    constexpr std::size_t fast = 90;
    WindowSamples samples(1, end, fastest);
    const auto motion = [&](double t) {
        const double w = 2 * std::numbers::pi / samples.window() * t;
        return 3e-4 * std::polar(1.0, slow * w + 0.4) + 1e-4 * std::polar(1.0, -(slow * w) + 1.1) +
               2e-4 * std::polar(1.0, -(fast * w));
    };
    for (const auto &wanted : samples.between(0, end)) {
        const std::complex<double> w = motion(wanted.time);
        samples.set(0, wanted.window, wanted.sample, {w.real(), w.imag()});
    }
    const results::Waterfall found = samples.spectra(0);
    ASSERT_GT(found.amplitude.size(), 10U);
    ASSERT_GT(found.frequencies.size(), fast + 1);
    EXPECT_NEAR(found.frequencies[slow] * samples.window() / (2 * std::numbers::pi), slow, 1e-12);
    EXPECT_GT(found.frequencies.back(), 3.9 * fastest);
    for (std::size_t k = 0; k < found.amplitude.size(); ++k) {
        // The window stands about the time that is told; a sample's time less of it is looked at.
        EXPECT_GE(found.times[k], found.window / 2);
        EXPECT_LE(found.times[k], end - 0.49 * found.window);
        for (std::size_t i = 0; i < found.frequencies.size(); ++i) {
            const auto near = [i](std::size_t at) {
                return i == at ? 1 : i + 1 == at || i == at + 1 ? 0.5 : 0;
            };
            // Rounding of the phases, some hundred turns, in a sum of some hundred terms.
            EXPECT_NEAR(found.amplitude[k][i], 4e-4 * near(slow) + 2e-4 * near(fast), 1e-14)
                << k << ' ' << i;
        }
    }
}

} // namespace
} // namespace whirl::simulation

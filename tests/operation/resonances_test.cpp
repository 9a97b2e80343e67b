#include "results/resonances.h"

#include <gtest/gtest.h>

#include <limits>

namespace resonances_test {

using namespace whirl;
using results::PeakKind;
using results::Resonance;
using results::ResponsePeak;

ResponsePeak peak(const char *of, int place, double speed, double value,
                  std::optional<double> factor = {}, const std::string &mode = "") {
    ResponsePeak out;
    out.of = of;
    out.place = place;
    out.speed = speed;
    out.value = value;
    out.mode = mode;
    if (factor) {
        out.amplification = factor;
        out.lower = speed * (1 - 0.5 / *factor);
        out.upper = speed * (1 + 0.5 / *factor);
    }
    return out;
}

std::vector<std::size_t> of(const std::vector<ResponsePeak> &peaks) {
    std::vector<std::size_t> out;
    for (const ResponsePeak &one : peaks)
        out.push_back(one.resonance.value_or(99));
    return out;
}

/// Peaks of four places between 596 and 617 with factors of 4 to 5 are one resonance, whose factor
/// is that of the station that moves most, and not of the probe that reads most.
TEST(Resonances, OneFactorForAllPlaces) {
    std::vector<ResponsePeak> peaks{
        peak("station", 0, 600, 2e-6, 4.6), peak("station", 1, 603, 5e-6, 4.7),
        peak("bearing", 0, 606, 300, 4.4), peak("probe", 0, 596, 9e-6, 4.8),
        peak("probe", 1, 617, 1e-6, 3.9)};
    const std::vector<Resonance> found = results::resonances_of(peaks);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].peak.amplification, 4.7);
    EXPECT_EQ(found[0].peak.kind, PeakKind::resonance);
    EXPECT_EQ(found[0].peaks, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(of(peaks), (std::vector<std::size_t>{0, 0, 0, 0, 0}));
}

/// Two peaks of one curve are two resonances, however near; so are two of different modes.
TEST(Resonances, NeverTwoOfOnePlaceOrOfTwoModes) {
    std::vector<ResponsePeak> peaks{
        peak("station", 0, 600, 2e-6, 5), peak("station", 0, 640, 1e-6, 5),
        peak("station", 1, 642, 3e-6, 5), peak("station", 1, 599, 4e-6, 5)};
    EXPECT_EQ(results::resonances_of(peaks).size(), 2U);
    EXPECT_EQ(of(peaks), (std::vector<std::size_t>{0, 1, 1, 0}));
    peaks = {peak("station", 0, 600, 2e-6, 5, "1B"), peak("station", 1, 601, 3e-6, 5, "1F"),
             peak("station", 2, 602, 1e-6, 5, "1B"), peak("station", 3, 602, 1e-7, 5)};
    EXPECT_EQ(results::resonances_of(peaks).size(), 2U);
    EXPECT_EQ(of(peaks).at(2), of(peaks).at(0));
    EXPECT_NE(of(peaks).at(1), of(peaks).at(0));
}

TEST(Resonances, OthersAreNamedForWhatTheyAre) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    std::vector<ResponsePeak> peaks{
        peak("station", 0, 300, 1e-6, 2.4),  // below 2.5: heavily damped
        peak("station", 0, 1000, 5e-6, 20),  //
        peak("station", 0, 1400, 4e-6),      // no half-power point on either side
        peak("station", 1, 3000, 1e-6),      // the only one of its curve
        peak("station", 0, 9000, unlimited), // without damping
        peak("probe", 0, 1001, 1e-7)};       // without a factor, at a resonance
    const std::vector<Resonance> found = results::resonances_of(peaks);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(peaks[0].kind, PeakKind::heavily_damped);
    EXPECT_EQ(peaks[1].kind, PeakKind::resonance);
    EXPECT_EQ(peaks[2].kind, PeakKind::flank);
    EXPECT_EQ(peaks[3].kind, PeakKind::plateau);
    EXPECT_EQ(peaks[4].kind, PeakKind::resonance);
    EXPECT_FALSE(found[2].peak.amplification.has_value());
    EXPECT_EQ(of(peaks), (std::vector<std::size_t>{0, 1, 99, 99, 2, 1}));
}

} // namespace resonances_test

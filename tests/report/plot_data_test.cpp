#include "report/plot_campbell.h"
#include "report/plot_modes.h"
#include "report/plot_style.h"
#include "sample_results.h"

namespace whirl::report {

TEST(PlotData, GrowingModesAreThoseBeyondTheirOwnError) {
    analyses::CampbellMode mode = sample_campbell().modes[1];
    EXPECT_FALSE(grows(mode, 0)) << "decays";
    EXPECT_FALSE(grows(mode, 1)) << "not a number";
    mode.error[2] = 1e-3;
    EXPECT_TRUE(grows(mode, 2)) << "2/110 of the modulus against an error of 1e-3";
    mode.error[2] = 1e-1;
    EXPECT_FALSE(grows(mode, 2)) << "within its error";
}

TEST(PlotData, SpreadKeepsGapOrderAndRange) {
    const auto places = spread({0.01, 0.0, 0.02, 0.9, 1.0}, 0.1, {0.05, 0.95});
    EXPECT_LT(places[1], places[0]);
    EXPECT_LT(places[0], places[2]);
    auto sorted = places;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        EXPECT_GE(sorted[i] - sorted[i - 1], 0.1 - 1e-9);
    EXPECT_GE(sorted.front(), 0.05 - 1e-12);
    EXPECT_LE(sorted.back(), 0.95 + 1e-12);
}

TEST(PlotData, MissingValuesLeaveGaps) {
    EXPECT_EQ(data_block("a", {{{1, 2.5}, {2, std::nullopt}}}),
              "$a << EOD\n1 2.5\n2 NaN\n\nNaN NaN\nEOD\n");
}

TEST(PlotData, ForwardModeHasEqualCurvesBackwardMirroredOnes) {
    const auto modes = sample_modes().modes;
    const ModeCurves backward = mode_curves(modes[0]);
    const ModeCurves forward = mode_curves(modes[1]);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(backward.x[i], -backward.y[i], 1e-15);
        EXPECT_NEAR(forward.x[i], forward.y[i], 1e-15);
        EXPECT_NEAR(forward.envelope[i], std::abs(modes[1].x[i]), 1e-15) << "circle";
    }
    EXPECT_NEAR(forward.x[1], 1, 1e-15);
}

TEST(PlotData, EnvelopeOfAStraightOrbitIsItsHalfLength) {
    analyses::ModeShape mode;
    mode.x = {0.6};
    mode.y = {0.8}; // in phase: a straight line of half length 1
    EXPECT_NEAR(mode_curves(mode).envelope[0], 1, 1e-15);
}

} // namespace whirl::report

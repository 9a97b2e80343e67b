#include "report/pictures/figures.h"
#include "report/pictures/mode_curves.h"
#include "report/pictures/style.h"
#include "results/campbell.h"
#include "results/modes.h"
#include "results/response.h"
#include "sample_results.h"

#include <random>

namespace whirl::report {

TEST(PlotData, GrowingModesAreThoseBeyondTheirOwnError) {
    results::CampbellMode mode = sample_campbell().modes[1];
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

TEST(PlotData, StationsWithoutNamesAreDrawnBesideNamedOnes) {
    results::ResponseResult result;
    result.nodes.resize(4);
    result.nodes[2].name = result.nodes[3].name = "bearing";
    EXPECT_EQ(drawn_nodes(result), (std::vector<std::size_t>{0, 1, 2, 3}));
    // Of many, eight: the named ones and six of the others, with the first and the last of them.
    result.nodes.resize(30);
    const std::vector<std::size_t> drawn = drawn_nodes(result);
    EXPECT_EQ(drawn.size(), 8U);
    EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
    for (const std::size_t i : {0, 2, 3, 29})
        EXPECT_EQ(std::count(drawn.begin(), drawn.end(), i), 1) << i;
    for (auto &node : result.nodes)
        node.name = "station";
    EXPECT_EQ(drawn_nodes(result).size(), 8U);
    result.nodes.clear();
    EXPECT_TRUE(drawn_nodes(result).empty());
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

TEST(PlotData, ModesAreDrawnWhenMostOfThemIsSeen) {
    const std::complex<double> i(0, 1);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto any = [&] { return std::complex<double>(normal(random), normal(random)); };
    const std::vector<double> bow{0.3, 1, -0.4};
    std::vector<results::ModeShape> modes(6);
    for (std::size_t k = 0; k < 3; ++k) {
        modes[0].x.push_back(1e-14 * any()); // in one plane
        modes[0].y.emplace_back(bow[k]);
        modes[1].x.emplace_back(i * bow[k]);
        modes[1].y.push_back(1e-14 * any());
        modes[2].x.emplace_back(i * bow[k]); // in a plane aslant
        modes[2].y.emplace_back(-i * bow[k]);
        modes[3].x.emplace_back(bow[k]); // an ellipse
        modes[3].y.emplace_back(0.2 * i * bow[k]);
        for (std::size_t m = 4; m < 6; ++m) {
            modes[m].x.push_back(any());
            modes[m].y.push_back(any());
        }
    }
    const auto drawn = [](const results::ModeShape &mode, double phase, bool at_one_instant) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum +=
                std::pow((mode.x[k] * std::polar(1.0, phase)).real(), 2) +
                std::pow(
                    (mode.y[k] * std::polar(1.0, phase + (at_one_instant ? 0 : pi / 2))).real(), 2);
        return sum;
    };
    for (const results::ModeShape &mode : modes) {
        double most = 0;
        for (int step = 0; step < 1000; ++step)
            for (const bool at_one_instant : {false, true})
                most = std::max(most, drawn(mode, step * pi / 1000, at_one_instant));
        const ModeCurves curves = mode_curves(mode);
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += curves.x[k] * curves.x[k] + curves.y[k] * curves.y[k];
        EXPECT_NEAR(sum, most, 2e-5 * most) << &mode - modes.data(); // of steps of pi/1000
    }
    EXPECT_NEAR(mode_curves(modes[0]).y[1], 1, 1e-12);
    EXPECT_FALSE(mode_curves(modes[0]).at_one_instant);
    EXPECT_TRUE(mode_curves(modes[2]).at_one_instant);
    EXPECT_FALSE(mode_curves(modes[3]).at_one_instant);
}

TEST(PlotData, EnvelopeOfAStraightOrbitIsItsHalfLength) {
    results::ModeShape mode;
    mode.x = {0.6};
    mode.y = {0.8}; // in phase: a straight line of half length 1
    EXPECT_NEAR(mode_curves(mode).envelope[0], 1, 1e-15);
}

} // namespace whirl::report

#include "report/pictures/campbell_panel.h"
#include "report/pictures/figures.h"
#include "report/pictures/labels.h"
#include "report/pictures/style.h"
#include "report/response/marks.h"
#include "results/campbell.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/stability.h"
#include "sample_results.h"

#include <complex>
#include <random>
#include <sstream>

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

// Of two speeds, rounded to nine digits, the lower one lay below the axis and the upper one above:
// nothing was left to draw, and the run ended.
TEST(PlotData, EndsOfALineLieWithinAnAxisThatEndsThere) {
    for (const double speed : {50., 51., 1. / 3, 8.1, 2e4 / 7}) {
        std::istringstream block(data_block("line", {{{speed * rpm, 1}}}));
        std::string text;
        std::getline(block, text);
        block >> text;
        EXPECT_EQ(std::stod(text), speed * rpm);
    }
}

// A line that springs between two speeds, from 100 to 30 and back, is two lines and a point
// between.
TEST(PlotData, SprungFrequenciesAreNotJoined) {
    results::CampbellResult result = sample_campbell();
    results::CampbellMode mode = result.modes[0];
    result.speeds = {0, 10, 20, 30, 40, 50, 60};
    mode.frequency = {100., 101., 102., 30., 103., 104., 105.};
    mode.whirl.assign(7, results::Whirl::forward);
    result.modes = {mode};
    const Panel panel{false, {0, 60}, {0, 20}};
    const auto all = [](const auto &, std::size_t) { return true; };
    const auto lines = stretches(panel, result, all);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].size(), 3U);
    EXPECT_EQ(lines[1].size(), 3U);
    const auto points = markers(panel, result, results::Whirl::forward);
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const PlotPoint &point) {
        return std::abs(point.x - 30 * rpm) < 1e-9;
    })) << "the point between is drawn";
    // So at the end of the range.
    result.modes[0].frequency = {100., 101., 102., 103., 104., 105., 30.};
    ASSERT_EQ(stretches(panel, result, all).size(), 1U);
    EXPECT_EQ(stretches(panel, result, all)[0].size(), 6U);
    // A steep line is none that springs: each step is no more than twice that before.
    result.modes[0].frequency = {1., 2., 4., 8., 16., 32., 64.};
    EXPECT_EQ(stretches(panel, result, all).size(), 1U);
}

// Two motions of a Hill series exchange their larger parts; one of their lines began just before.
TEST(PlotData, LinesThatExchangeMotionsAreNotJoined) {
    results::CampbellResult result = sample_campbell();
    result.model.formulation.form = results::Form::hill;
    result.speeds = {400, 500, 600, 700};
    results::CampbellMode mode = result.modes[0];
    mode.whirl.assign(4, results::Whirl::backward);
    mode.frequency = {684., 665., 646., 1914.};
    results::CampbellMode late = mode;
    late.frequency = {{}, {}, 1940., 626.};
    result.modes = {mode, late};
    const Panel panel{false, {0, 700 * rpm}, {0, 400}};
    const auto all = [](const auto &, std::size_t) { return true; };
    ASSERT_EQ(stretches(panel, result, all).size(), 1U);
    EXPECT_EQ(stretches(panel, result, all)[0].size(), 3U);
    result.modes[0].frequency.back() = 630.; // a steep line alone
    EXPECT_EQ(stretches(panel, result, all).size(), 2U);
}

// In rotating axes a motion at 7 rad/s is one at speed + 7 or speed - 7 in those that stand still:
// the step from one to the other is no line, however small it is beside the highest frequency.
TEST(PlotData, TheOtherOneOfTwoFrequenciesIsNotJoined) {
    results::CampbellResult result = sample_campbell();
    results::CampbellMode mode = result.modes[0];
    result.speeds = {80, 82, 84, 86, 88, 90, 92};
    mode.frequency_rotating = {7., 7., 7., 7.1, 7., 7., 7.};
    mode.frequency = {87., 89., 91., 78.9, 81., 83., 85.};
    mode.whirl.assign(7, results::Whirl::forward);
    results::CampbellMode fast = mode;
    fast.frequency.assign(7, 7000.);
    fast.frequency_rotating = {6920., 6918., 6916., 6914., 6912., 6910., 6908.};
    result.modes = {mode, fast};
    const Panel panel{false, {0, 60}, {0, 20}};
    const auto lines = stretches(panel, result, [](const auto &, std::size_t) { return true; });
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].size(), 3U);
    EXPECT_EQ(lines[1].size(), 4U);
    EXPECT_EQ(lines[2].size(), 7U);
    // Drawn apart, it goes on to where the first begins, and from where that ends.
    result.modes[0].other_frequency = {73., 75., 77., 93.1, 95., 97., 99.};
    const auto others = other_frequencies(panel, result);
    ASSERT_EQ(others.size(), 2U);
    ASSERT_EQ(others[0].size(), 4U);
    EXPECT_EQ(others[0].back().y, lines[1].front().y);
    ASSERT_EQ(others[1].size(), 5U);
    EXPECT_EQ(others[1].front().y, lines[0].back().y);
    result.modes[0].other_frequency = {{}, {}, 77., {}, {}, {}, {}};
    ASSERT_EQ(other_frequencies(panel, result).size(), 1U);
    EXPECT_TRUE(other_frequencies(Panel{true, {0, 60}, {0, 1}}, result).empty());
}

// Between two speeds the curve of growth leaves zero at the end of the band, not at the speed
// before it; numbers at its axis differ from each other.
TEST(PlotData, GrowthIsZeroAtTheEndsOfBands) {
    results::StabilityResult result;
    result.speeds = {0, 10, 20, 30};
    result.growth = {-1, -1, 4, -1};
    result.unstable = {{18 / rpm, 25 / rpm}};
    const std::string script =
        stability_figure(sample_case(), result, Units::of_readers({})).script;
    const std::string block = script.substr(script.find("$curve0"));
    const std::size_t begins = block.find("\n18 0\n");
    const std::size_t ends = block.find("\n25 0\n");
    ASSERT_NE(begins, std::string::npos) << block;
    ASSERT_NE(ends, std::string::npos) << block;
    EXPECT_LT(begins, ends);
    result.growth = {-0.003351, -0.0033515, -0.003352, -0.0033525};
    result.unstable = {};
    EXPECT_NE(stability_figure(sample_case(), result, Units::of_readers({}))
                  .script.find("set format y '%.6g'"),
              std::string::npos);
    result.growth = {-100.00001, -100.00002, -100.00003, -100.00004};
    EXPECT_NE(stability_figure(sample_case(), result, Units::of_readers({}))
                  .script.find("set format y '%.9g'"),
              std::string::npos);
}

TEST(PlotData, NumbersOfPicturesAreWrittenAsByHand) {
    EXPECT_EQ(with_powers("2e+07 N/m | 1e+10, 1.25e-09"), "2·10⁷ N/m | 10¹⁰, 1.25·10⁻⁹");
    EXPECT_EQ(with_powers("11e+06 and 0.1e+06"), "11·10⁶ and 0.1·10⁶");
    EXPECT_EQ(with_powers("stage 2e, 1e+x, e-07"), "stage 2e, 1e+x, e-07");
    EXPECT_EQ(short_speed(3.7699), "3.77");
    EXPECT_EQ(short_speed(12345.6), "12346");
    EXPECT_EQ(with_powers(short_speed(161403231)), "1.614·10⁸");
}

// One pole: the response runs through a circle. At 16 places around it, as many as a search for
// peaks looks at, straight lines lie up to 1 - cos(pi/16) = 2 % of the radius inside; the curve
// drawn an eighth of that at most.
TEST(PlotData, PolarLoopsAreRound) {
    results::ResponseResult result;
    result.nodes.resize(1);
    result.curves.values.resize(1);
    result.curves.phases.resize(1);
    constexpr double radius = 1e-3;
    for (int i = 1; i < 16; ++i) { // the circle about -i radius, from near rest to far above
        const std::complex<double> place =
            radius * std::complex<double>(0, 1) * (std::polar(1.0, -2 * pi * i / 16) - 1.0);
        result.curves.speeds.push_back(10 * i);
        result.curves.values[0].push_back(std::abs(place));
        result.curves.phases[0].push_back(std::arg(place));
    }
    result.speeds = result.curves.speeds;
    result.nodes[0].amplitude = result.curves.values[0];
    result.nodes[0].phase = result.curves.phases[0];
    const std::string script = polar_figure(sample_case(), result, Units::of_readers({})).script;
    const std::size_t from = script.find("$curve0 << EOD\n");
    ASSERT_NE(from, std::string::npos);
    std::istringstream data(script.substr(from + 15, script.find("EOD", from + 15) - from - 15));
    int points = 0;
    for (double x = 0, y = 0; data >> x >> y; ++points)
        EXPECT_NEAR(std::hypot(x, y + radius * micrometres), radius * micrometres,
                    0.0025 * radius * micrometres);
    EXPECT_GT(points, 40);
    EXPECT_NE(script.find("set xlabel 'x ("), std::string::npos);
    // A probe has a phase of its own: it is drawn in the place of the station.
    result.probes.resize(1);
    result.probes[0].name = "1Y";
    result.probes[0].angle = pi / 2;
    result.curves.values.push_back({1e-6, 2e-6, 1e-6});
    result.curves.phases.push_back({0, pi / 2, pi});
    const std::string read = polar_figure(sample_case(), result, Units::of_readers({})).script;
    EXPECT_NE(read.find("1Y, z = 0 m at 90°"), std::string::npos);
    EXPECT_NE(read.find("set xlabel 'in phase ("), std::string::npos);
    EXPECT_EQ(read.find("$curve1 << EOD"), std::string::npos);
    EXPECT_NE(read.find("$curve0 << EOD\n1 0\n"), std::string::npos) << "1 um at no angle";
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

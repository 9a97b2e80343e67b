#include "report/pictures/figures.h"
#include "report/pictures/labels.h"
#include "report/pictures/style.h"
#include "report/response/marks.h"
#include "report/response/parts.h"
#include "results/campbell.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/stability.h"
#include "results/steady_states.h"
#include "sample_results.h"

#include <algorithm>
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
        std::istringstream block(data_block("line", {{usual(Quantity::speed, speed), 1}}));
        std::string text;
        std::getline(block, text);
        block >> text;
        EXPECT_EQ(std::stod(text), usual(Quantity::speed, speed));
    }
}

namespace {

/// Speeds and frequencies of as many lists; the motions keep their sense.
results::CampbellResult campbell_of(const std::vector<double> &speeds,
                                    const std::vector<std::vector<std::optional<double>>> &modes,
                                    results::Whirl sense) {
    results::CampbellResult result = sample_campbell();
    results::CampbellMode mode = result.modes[0];
    mode.whirl.assign(speeds.size(), sense);
    mode.forward_fraction.assign(speeds.size(), 1);
    result.speeds = speeds;
    result.modes.clear();
    result.crossings.clear();
    for (const auto &frequency : modes) {
        result.modes.push_back(mode);
        result.modes.back().frequency = frequency;
    }
    return result;
}

/// The lines of one name in the upper panel.
std::vector<std::vector<PlotPoint>> lines_named(const std::string &name,
                                                const results::CampbellResult &result) {
    std::vector<std::vector<PlotPoint>> lines;
    const Chart chart = campbell_chart(sample_case(), result, usual);
    for (const ChartCurve &curve : chart.panels.front().curves)
        if (curve.name == name)
            lines.push_back(curve.points);
    return lines;
}

std::vector<std::size_t> sizes_of(const std::vector<std::vector<PlotPoint>> &lines) {
    std::vector<std::size_t> sizes;
    for (const auto &line : lines)
        sizes.push_back(line.size());
    return sizes;
}

using Sizes = std::vector<std::size_t>;

} // namespace

// A line that springs between two speeds, from 100 to 30 and back, is two lines and a point
// between.
TEST(PlotData, SprungFrequenciesAreNotJoined) {
    results::CampbellResult result =
        campbell_of({0, 10, 20, 30, 40, 50, 60}, {{100., 101., 102., 30., 103., 104., 105.}},
                    results::Whirl::forward);
    EXPECT_EQ(sizes_of(lines_named("forward", result)), (Sizes{3, 1, 3}));
    EXPECT_NEAR(lines_named("forward", result)[1][0].x, usual(Quantity::speed, 30), 1e-9);
    // So at the end of the range.
    result.modes[0].frequency = {100., 101., 102., 103., 104., 105., 30.};
    EXPECT_EQ(sizes_of(lines_named("forward", result)), (Sizes{6, 1}));
    // A steep line is none that springs: each step is no more than twice that before.
    result.modes[0].frequency = {1., 2., 4., 8., 16., 32., 64.};
    EXPECT_EQ(sizes_of(lines_named("forward", result)), (Sizes{7}));
}

// A line of one sense goes on to where that of the next one begins.
TEST(PlotData, LinesOfBothSensesMeet) {
    results::CampbellResult result =
        campbell_of({0, 10, 20, 30}, {{100., 101., 102., 103.}}, results::Whirl::forward);
    result.modes[0].whirl[2] = result.modes[0].whirl[3] = results::Whirl::backward;
    const auto before = lines_named("forward", result);
    const auto after = lines_named("backward", result);
    ASSERT_EQ(sizes_of(before), (Sizes{3}));
    ASSERT_EQ(sizes_of(after), (Sizes{2}));
    EXPECT_EQ(before[0].back().x, after[0].front().x);
    EXPECT_EQ(before[0].back().y, after[0].front().y);
}

// Two motions of a Hill series exchange their larger parts; one of their lines began just before.
TEST(PlotData, LinesThatExchangeMotionsAreNotJoined) {
    results::CampbellResult result =
        campbell_of({400, 500, 600, 700}, {{684., 665., 646., 1914.}, {{}, {}, 1940., 626.}},
                    results::Whirl::backward);
    result.model.formulation.form = results::Form::hill;
    EXPECT_EQ(sizes_of(lines_named("backward", result)), (Sizes{3, 1, 1, 1}));
    result.modes[0].frequency.back() = 630.; // a steep line alone
    EXPECT_EQ(sizes_of(lines_named("backward", result)), (Sizes{4, 2}));
}

// In rotating axes a motion at 7 rad/s is one at speed + 7 or speed - 7 in those that stand still:
// the step from one to the other is no line, however small it is beside the highest frequency.
TEST(PlotData, TheOtherOneOfTwoFrequenciesIsNotJoined) {
    results::CampbellResult result = campbell_of(
        {80, 82, 84, 86, 88, 90, 92},
        {{87., 89., 91., 78.9, 81., 83., 85.}, {7000., 7000., 7000., 7000., 7000., 7000., 7000.}},
        results::Whirl::forward);
    result.modes[0].frequency_rotating = {7., 7., 7., 7.1, 7., 7., 7.};
    result.modes[1].frequency_rotating = {6920., 6918., 6916., 6914., 6912., 6910., 6908.};
    const auto lines = lines_named("forward", result);
    ASSERT_EQ(sizes_of(lines), (Sizes{3, 4, 7}));
    // Drawn apart, it goes on to where the first begins, and from where that ends.
    const auto others = [&result] {
        std::vector<std::vector<PlotPoint>> pieces(1);
        const auto lines_of_all = lines_named("its other frequency", result);
        for (const PlotPoint &point : lines_of_all.front())
            if (point.y)
                pieces.back().push_back(point);
            else if (!pieces.back().empty())
                pieces.emplace_back();
        pieces.resize(pieces.size() - (pieces.back().empty() ? 1 : 0));
        return pieces;
    };
    result.modes[0].other_frequency = {73., 75., 77., 93.1, 95., 97., 99.};
    ASSERT_EQ(sizes_of(others()), (Sizes{4, 5}));
    EXPECT_EQ(others()[0].back().y, lines[1].front().y);
    EXPECT_EQ(others()[1].front().y, lines[0].back().y);
    result.modes[0].other_frequency = {{}, {}, 77., {}, {}, {}, {}};
    EXPECT_EQ(sizes_of(others()), (Sizes{2}));
}

// Between two speeds the curve of growth leaves zero at the end of the band, not at the speed
// before it.
TEST(PlotData, GrowthIsZeroAtTheEndsOfBands) {
    results::StabilityResult result;
    result.speeds = {0, 10, 20, 30};
    result.growth = {-1, -1, 4, -1};
    result.unstable = {{18 / usual.factor(Quantity::speed), 25 / usual.factor(Quantity::speed)}};
    const Chart chart = stability_chart(sample_case(), result, usual);
    const auto growth = std::ranges::find(chart.panels.front().curves, "growth", &ChartCurve::name);
    ASSERT_NE(growth, chart.panels.front().curves.end());
    std::vector<double> zeros;
    for (const PlotPoint &point : growth->points)
        if (point.y == 0.0)
            zeros.push_back(point.x);
    ASSERT_EQ(zeros.size(), 2U);
    EXPECT_NEAR(zeros[0], 18, 1e-12);
    EXPECT_NEAR(zeros[1], 25, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(growth->points, {}, &PlotPoint::x));
}

// Numbers at an axis differ from each other.
TEST(PlotData, NumbersAtANarrowAxisHaveTheDigitsThatTellThemApart) {
    ChartPanel panel{200, {.title = "x", .low = 0, .high = 1}, {.title = "y"}};
    panel.curves = {{"", {{0, -100.00001}, {1, -100.00004}}, {}}};
    const Chart chart{"", "", {panel}};
    EXPECT_NE(chart_figure(chart, sample_case(), usual).script.find("set format y '%.9g'"),
              std::string::npos);
}

TEST(PlotData, NumbersOfPicturesAreWrittenAsByHand) {
    EXPECT_EQ(with_powers("2e+07 N/m | 1e+10, 1.25e-09"), "2·10⁷ N/m | 10¹⁰, 1.25·10⁻⁹");
    EXPECT_EQ(with_powers("11e+06 and 0.1e+06"), "11·10⁶ and 0.1·10⁶");
    EXPECT_EQ(with_powers("stage 2e, 1e+x, e-07"), "stage 2e, 1e+x, e-07");
    const Units si;
    EXPECT_EQ(drawn_speed(si, 3.7699), "3.77");
    EXPECT_EQ(drawn_speed(si, 12345.6), "12346");
    EXPECT_EQ(drawn_speed(si, 161403231), "1.614·10⁸");
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
    const auto panel = [&result] {
        return polar_chart(sample_case(), result, usual).panels.front();
    };
    const auto points = [](const ChartPanel &panel, const std::string &name) {
        const auto curve = std::ranges::find(panel.curves, name, &ChartCurve::name);
        return curve == panel.curves.end() ? std::vector<PlotPoint>{} : curve->points;
    };
    const std::vector<PlotPoint> loop = points(panel(), "z = 0 m");
    for (const PlotPoint &at : loop)
        EXPECT_NEAR(std::hypot(at.x, *at.y + usual(Quantity::amplitude, radius)),
                    usual(Quantity::amplitude, radius),
                    0.0025 * usual(Quantity::amplitude, radius));
    EXPECT_GT(loop.size(), 40U);
    EXPECT_EQ(panel().x.title, "x (µm)");
    // A probe has a phase of its own: it is drawn in the place of the station.
    result.probes.resize(1);
    result.probes[0].name = "1Y";
    result.probes[0].angle = pi / 2;
    result.curves.values.push_back({1e-6, 2e-6, 1e-6});
    result.curves.phases.push_back({0, pi / 2, pi});
    const ChartPanel read = panel();
    EXPECT_EQ(read.x.title, "in phase (µm)");
    EXPECT_TRUE(points(read, "z = 0 m").empty());
    const std::vector<PlotPoint> probe = points(read, "1Y, z = 0 m at 90°");
    ASSERT_FALSE(probe.empty());
    EXPECT_NEAR(probe.front().x, 1, 1e-12) << "1 um at no angle";
    EXPECT_NEAR(*probe.front().y, 0, 1e-12);
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
    EXPECT_EQ(data_block("a", {{1, 2.5}, {2, std::nullopt}}),
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

// Neighbours among the speeds, but of rotors that turn in opposite senses.
TEST(PlotData, StatesAreNotJoinedThroughStandstill) {
    results::SteadyStates states;
    for (const double speed : {-100, -50, 50, 100}) {
        states.speeds.push_back(speed);
        results::SteadyState &state = states.states.emplace_back();
        state.speed = speed;
        state.stable = true;
        state.residual = 1e-6;
    }
    const Chart chart = states_chart(sample_case(), states, usual);
    std::size_t pieces = 0;
    for (const ChartCurve &curve : chart.panels.front().curves)
        for (std::size_t i = 1; i < curve.points.size() && curve.width > 0; ++i)
            if (curve.points[i - 1].y && curve.points[i].y) {
                ++pieces;
                EXPECT_GT(curve.points[i - 1].x * curve.points[i].x, 0);
            }
    EXPECT_EQ(pieces, 2U) << "of each sense one";
}

// A circle of 2 um in a clearance of 4 um. It is run through in the sense of the spin, and begins
// where the shaft is at the phase mark.
TEST(PlotData, OrbitsAreRunThroughAsTheShaftGoes) {
    results::Orbit orbit;
    orbit.of = "bearing";
    orbit.x = orbit.y = orbit.major = orbit.minor = 2e-6;
    orbit.y_phase = -pi / 2; // y = sin Ωt
    orbit.clearance = 4e-6;
    for (const double speed : {100., -100.}) {
        const Chart chart = orbits_chart(sample_case(), {{speed, {orbit}}}, usual);
        ASSERT_EQ(chart.panels.size(), 1U);
        const ChartPanel &panel = chart.panels.front();
        EXPECT_EQ(panel.labels.at(0).text, "50 % of the clearance");
        const auto named = [&panel](const std::string &name) {
            return *std::ranges::find(panel.curves, name, &ChartCurve::name);
        };
        for (const PlotPoint &point : named("radial clearance").points)
            EXPECT_NEAR(std::hypot(point.x, *point.y), 4, 1e-12);
        const std::vector<PlotPoint> path = named("orbit").points;
        double area = 0; // positive: anticlockwise
        for (std::size_t i = 1; i < path.size(); ++i)
            area += (path[i - 1].x * *path[i].y - path[i].x * *path[i - 1].y) / 2;
        EXPECT_NEAR(area, std::copysign(4 * pi, speed), 0.01 * 4 * pi) << "a polygon of 120 sides";
        EXPECT_NEAR(named("at Ωt = 0").points.at(0).x, 2, 1e-12);
        EXPECT_NEAR(*named("at Ωt = 0").points.at(0).y, 0, 1e-12);
    }
}

TEST(PlotData, EnvelopeOfAStraightOrbitIsItsHalfLength) {
    results::ModeShape mode;
    mode.x = {0.6};
    mode.y = {0.8}; // in phase: a straight line of half length 1
    EXPECT_NEAR(mode_curves(mode).envelope[0], 1, 1e-15);
}

} // namespace whirl::report

#pragma once

// Figures of panels over each other, described once: gnuplot draws them for files, Plotly on pages.

#include "model/case.h"
#include "report/common/gnuplot.h"
#include "report/common/units.h"
#include "report/pictures/style.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

struct ChartAxis {
    std::string title;                   ///< with its unit; empty: none
    std::string unit;                    ///< of its numbers
    bool spin_speed = false;             ///< the operating speeds lie behind the curves
    std::optional<double> low{}, high{}; ///< none: as the curves need it
    bool logarithmic = false;
    double step = 0; ///< between its numbers; 0: as there is room
    std::vector<std::pair<double, std::string>> names{}; ///< at places of it, for numbers
    /// At the opposite side in still pictures: the same in another unit.
    struct Second {
        std::string title;
        double factor = 1; ///< of its numbers over those of the axis
    };
    std::optional<Second> second{};
};
[[nodiscard]] ChartAxis chart_axis(const Units &units, const std::string &what, Quantity quantity);
/// From one value to another, in SI.
[[nodiscard]] ChartAxis chart_axis(const Units &units, const std::string &what, Quantity quantity,
                                   double low, double high);
/// Of angles within half a turn either way, with a number at each quarter.
[[nodiscard]] ChartAxis phase_axis(const Units &units, const std::string &what);
/// Of spin speeds, from the first to the last of them, widened where there is one.
[[nodiscard]] ChartAxis along_speeds(const Units &units, const std::vector<double> &speeds);
/// Over the values of an axis of the case: an entry in SI, or speeds.
[[nodiscard]] ChartAxis along_axis(const Units &units, const model::SweepAxis &of);

struct ChartPanel;

struct ChartCurve {
    std::string name; ///< in the legend, once in a figure; empty: not there
    std::vector<PlotPoint> points;
    LineStyle style;
    double width = 1.8;               ///< of the line; 0: none
    double marker = 0;                ///< size of the points; 0: none
    bool on_page = false;             ///< there alone: a still picture has no room for it
    std::size_t every = 1;            ///< points stand at every so many places of the line
    std::vector<std::string> texts{}; ///< what the page says of its points, in lines
    bool filled = false;              ///< what it goes around, without a line
};
/// The index-th of a row, with a dash of its own where one is given.
[[nodiscard]] ChartCurve chart_curve(const std::string &name, std::vector<PlotPoint> points,
                                     std::size_t index, double width = 1.8,
                                     const std::string &dash = "");

/// A branch of motions: solid where they are stable, dashed unstable, dotted neither, which the
/// name says too.
[[nodiscard]] ChartCurve branch_curve(const std::string &name, std::optional<bool> stable,
                                      const std::string &colour);
inline constexpr std::optional<bool> stabilities[] = {true, false, std::nullopt};
/// Goes on from the end of a line, or after a gap from elsewhere.
void add_piece(std::vector<PlotPoint> &line, const PlotPoint &from, const PlotPoint &to);

/// Lines from end to end of a panel, of which the axes have these.
[[nodiscard]] ChartCurve level_line(const ChartPanel &panel, double y, const LineStyle &style,
                                    double width = 1);
[[nodiscard]] ChartCurve upright_line(const ChartPanel &panel, double x, const LineStyle &style,
                                      double width = 1);
/// What a line goes around, filled.
[[nodiscard]] ChartCurve chart_area(const LineStyle &style, std::vector<PlotPoint> border = {});
/// A filled rectangle.
[[nodiscard]] ChartCurve chart_bar(Range x, Range y, const LineStyle &style);
/// The same over the height of a panel.
[[nodiscard]] ChartCurve upright_band(const ChartPanel &panel, Range x, const LineStyle &style);

/// Values of a map up to which something is drawn in a colour.
struct ChartLevel {
    double most;
    LineStyle style;
};
/// A map as areas, a curve for each level that there is: around each place of [y][x] up to halfway
/// to the next; nothing where there is no number, or one above the last level.
[[nodiscard]] std::vector<ChartCurve> chart_map(const std::vector<double> &x,
                                                const std::vector<double> &y,
                                                const std::vector<std::vector<double>> &values,
                                                const std::vector<ChartLevel> &levels);

/// One more of the lines or areas of a curve, after a gap.
void add_part(std::vector<PlotPoint> &curve, const std::vector<PlotPoint> &part);

/// Marks on branches of motions, if there are any.
void add_marks(ChartPanel &panel, const std::string &name, int point, std::vector<PlotPoint> at);

/// What a point is, beside it where there is room; or the name of a curve at its end.
struct ChartLabel {
    std::string text;
    double x = 0, y = 0;
    std::string colour = "#000000";
};

struct ChartPanel {
    int height = 300; ///< pixels
    ChartAxis x{}, y{};
    std::vector<ChartCurve> curves{};
    std::string title{};
    std::vector<ChartLabel> labels{};
    /// Names right of the ends of curves, apart from one another; below those that leave at the
    /// top.
    std::vector<ChartLabel> ends{};
    bool square = false; ///< as wide as high
    bool beside = false; ///< in files right of the panel before, in the same row
};

struct Chart {
    std::string title, subtitle;
    std::vector<ChartPanel> panels;
    bool apart = false; ///< on pages a figure each: on paper a page may end between two of them
};

/// A plane about the origin, with circles of the largest radius that is drawn and of half of it.
/// @param size  pixels
[[nodiscard]] ChartPanel polar_panel(int size, const ChartAxis &x, const ChartAxis &y,
                                     double largest);

/// Ends of a logarithmic axis that shows so much below the largest value of all curves, and of that
/// of the smallest curve; linear where nothing is above zero.
void span_decades(ChartAxis &axis, const std::vector<ChartCurve> &curves, double share,
                  double share_of_smallest = 0);

[[nodiscard]] Figure chart_figure(const Chart &chart, const model::Case &scene, const Units &units);
/// The same for web/chart.js.
[[nodiscard]] nlohmann::ordered_json chart_json(const Chart &chart);

} // namespace whirl::report

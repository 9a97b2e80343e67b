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

/// What a point is, beside it where there is room; or the name of a curve at its end.
struct ChartLabel {
    std::string text;
    double x = 0, y = 0;
    std::string colour = "#000000";
};

struct ChartPanel {
    int height = 300; ///< pixels
    ChartAxis x, y;
    std::vector<ChartCurve> curves;
    std::string title{};
    std::vector<ChartLabel> labels{};
    /// Names right of the ends of curves, apart from one another; below those that leave at the
    /// top.
    std::vector<ChartLabel> ends{};
    bool beside = false; ///< in files right of the panel before, each half as wide
};

struct Chart {
    std::string title, subtitle;
    std::vector<ChartPanel> panels;
    bool apart = false; ///< on pages a figure each: on paper a page may end between two of them
};

/// Ends of a logarithmic axis that shows so much below the largest value of all curves, and of that
/// of the smallest curve; linear where nothing is above zero.
void span_decades(ChartAxis &axis, const std::vector<ChartCurve> &curves, double share,
                  double share_of_smallest = 0);

[[nodiscard]] Figure chart_figure(const Chart &chart, const model::Case &scene, const Units &units);
/// The same for web/chart.js.
[[nodiscard]] nlohmann::ordered_json chart_json(const Chart &chart);

} // namespace whirl::report

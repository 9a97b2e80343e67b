#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::tests {

/// Where a number of an axis stands.
struct Tick {
    double pixel = 0, value = 0;
};

/// An axis of a panel, as its numbers and its name say.
struct Axis {
    std::string name;
    std::vector<Tick> ticks;
    bool logarithmic = false; ///< its numbers are powers of ten

    /// What a place on it says, or its logarithm; by its first and its last number.
    [[nodiscard]] double value(double pixel) const;
    [[nodiscard]] double pixel(double value) const;
    [[nodiscard]] bool readable() const { return ticks.size() >= 2; }
};

struct PlotPixel {
    double x = 0, y = 0;
};
/// Lines that hang together, and single marks, of one curve.
struct PlottedCurve {
    std::string name;                          ///< gnuplot's: "gnuplot_plot_2a"
    std::vector<std::vector<PlotPixel>> lines; ///< marks are lines of one point
    std::optional<double> name_at;             ///< height of its name in the legend

    /// Whether it is the sample beside its name.
    [[nodiscard]] bool in_legend(const std::vector<PlotPixel> &line) const;
};

/// A panel of an SVG by gnuplot.
struct Panel {
    Axis x, y;
    double left = 0, right = 0, top = 0, bottom = 0;
    std::vector<PlottedCurve> curves;

    [[nodiscard]] bool holds(const PlotPixel &at) const {
        return at.x >= left && at.x <= right && at.y >= top && at.y <= bottom;
    }
};

/// What is written in an SVG of gnuplot beside the numbers of its axes, and its panels. A panel
/// without a name below it has that of the panel under it, one without a name at its side that of
/// the panel to its left.
struct SvgPlot {
    std::vector<std::string> texts;
    std::vector<Panel> panels;
};
[[nodiscard]] SvgPlot svg_plot(const std::string &svg);

} // namespace whirl::tests

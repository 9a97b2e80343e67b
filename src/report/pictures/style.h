#pragma once

#include "report/common/words.h"
#include "results/whirl.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// Colour, dash and marker of a sense of whirl. The colours are of Okabe and Ito's set, which
/// colour-blind readers tell apart; dash and marker carry the same information without colour.
struct LineStyle {
    std::string name;   ///< for legends
    std::string colour; ///< #rrggbb
    std::string dash;   ///< gnuplot's dash type
    int point = 7;      ///< gnuplot's point type
};

/// Of critical speeds that are damped so heavily that they count as none (AF < 2.5).
inline constexpr const char *heavy_colour = "#A0A0A0";

[[nodiscard]] LineStyle whirl_style(results::Whirl whirl);
/// The index-th of a row of styles that differ in colour, dash and marker.
[[nodiscard]] LineStyle series_style(std::size_t index);

/// Number for gnuplot data; NaN where it is missing or not finite, which leaves a gap.
[[nodiscard]] std::string plot_number(std::optional<double> value);

/// One point of a polyline; a gap where y is missing.
struct PlotPoint {
    double x = 0;
    std::optional<double> y;
};
/// Named data block; each polyline is set apart from the next by an empty line.
[[nodiscard]] std::string data_block(const std::string &name,
                                     const std::vector<std::vector<PlotPoint>> &polylines);

/// `set multiplot`, the bold heading and the grey line under it.
[[nodiscard]] std::string figure_head(const std::string &title, const std::string &subtitle,
                                      int height);
/// Margins of a panel in fractions of the figure.
[[nodiscard]] std::string panel_margins(double left, double right, double bottom, double top);

constexpr double picture_font = 14; ///< of gnuplot (common/gnuplot.cpp), pixels
/// Width of the widest of some texts as they are written, in the units asked for, pixels.
[[nodiscard]] double widest_text(const std::vector<std::string> &texts);

/// A figure whose panels have their legends at their right, `set key at graph 1.02,1 left top
/// reverse Left samplen 3`: as wide as the longest name needs.
struct LegendedFigure {
    int width = 0;              ///< pixels
    double left = 0, right = 0; ///< margins of the panels, fractions of the width
};
/// @param left, right  ends of the panels, pixels
/// @param least        width of the figure where the names are short
[[nodiscard]] LegendedFigure beside_legend(double left, double right, int least,
                                           const std::vector<std::string> &names);

/// Smallest and largest of the values, widened by `share` where they are equal.
struct Range {
    double low = 0;
    double high = 1;
};
[[nodiscard]] Range range_of(const std::vector<double> &values);

/// Positions near the wanted ones that keep the gap and stay in the range; order is kept.
[[nodiscard]] std::vector<double> spread(const std::vector<double> &wanted, double gap,
                                         Range range);

/// Boxes in fractions of a panel; finds a free place for a label beside its point.
class LabelPlacer {
  public:
    struct Box {
        double x = 0, y = 0, width = 0, height = 0; ///< lower left corner and size
    };
    void block(const Box &box) { _boxes.push_back(box); }
    /// Takes this very place. @returns false where another label has it or it leaves the picture.
    bool take(const Box &box);
    /// Least covered place of a label of this size around (x, y); the place is taken from then on.
    /// Nothing where any place leaves the picture or lies on another label.
    std::optional<Box> place(double x, double y, double width, double height);

  private:
    std::vector<Box> _boxes;
    std::vector<Box> _labels;
};

/// A line from a label to what it names, at (x, y); all in parts of the graph.
[[nodiscard]] std::string leader(const LabelPlacer::Box &label, double x, double y);

} // namespace whirl::report

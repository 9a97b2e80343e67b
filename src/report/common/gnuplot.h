#pragma once

#include <string>

namespace whirl::report {

/// A picture as gnuplot commands, without terminal and output.
struct Figure {
    std::string script; ///< with its data as named data blocks
    int width = 1200;   ///< of the PNG, pixels; the SVG is drawn in the same units
    int height = 800;
};

enum class PictureFormat { svg, png };

/// All that gnuplot reads for a figure: its terminal and the script.
[[nodiscard]] std::string gnuplot_input(const Figure &figure, PictureFormat format);

/// Text as a gnuplot string that is shown letter by letter, markup off: whatever could mean
/// something to gnuplot stands there by its number. No other strings of a script are in double
/// quotation marks.
[[nodiscard]] std::string plot_text(const std::string &text);

} // namespace whirl::report

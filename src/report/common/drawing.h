#pragma once

#include "model/case.h"
#include "report/common/gnuplot.h"

#include <string>
#include <vector>

namespace whirl::report {

struct DrawPoint {
    double x = 0; ///< pixels, to the right
    double y = 0; ///< pixels, downwards
};

/// A line or area. Empty colours mean none.
struct DrawShape {
    std::vector<DrawPoint> points;
    std::string fill;
    std::string stroke;
    double width = 1; ///< of the stroke, pixels
    bool dashed = false;
    bool closed = false;
};

struct DrawText {
    DrawPoint at; ///< on the baseline, below the middle of the text
    std::string text;
    double size = 13; ///< pixels
    std::string colour = "#222222";
};

/// A picture of lines, areas and texts, later ones on top.
struct Drawing {
    double width = 0; ///< pixels
    double height = 0;
    std::vector<DrawShape> shapes;
    std::vector<DrawText> texts;
};

/// The drawing as an SVG element, ready for a file or a page.
[[nodiscard]] std::string to_svg(const Drawing &drawing);
/// The drawing as gnuplot commands, for the PNG.
[[nodiscard]] Figure to_figure(const Drawing &drawing);

} // namespace whirl::report

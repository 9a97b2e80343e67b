#pragma once

#include <array>
#include <string>
#include <vector>

namespace whirl::tests {

struct Corner {
    double x = 0, y = 0; ///< pixels, to the right and downwards
};

/// A text of a picture with the box its letters fill, turned as they are.
struct TextBox {
    std::string text;
    std::array<Corner, 4> corners; ///< in order round the box
};

/// The texts of an SVG as gnuplot and whirl::report::to_svg write them: groups moved and turned,
/// spans with their own font sizes and shifts. Widths are those of DejaVu Sans; heights those of
/// the letters there are.
[[nodiscard]] std::vector<TextBox> svg_texts(const std::string &svg);

/// Texts that leave the frame of the picture and pairs that lie on each other, by more than a
/// pixel, and numbers as programs write them (2e+07, -0), each as a sentence.
[[nodiscard]] std::vector<std::string> layout_faults(const std::string &svg);

} // namespace whirl::tests

#pragma once

#include <string>
#include <string_view>

namespace whirl::report {

/// Width of a line of text in DejaVu Sans, the first font of the pictures (others that stand in for
/// it, such as Arial, are narrower). Source: the advance widths of the font itself (table `hmtx`).
/// @param text  UTF-8; beyond Latin-1 the width that most letters of the script do not exceed
/// @param size  of the font, pixels
/// @returns pixels
[[nodiscard]] double text_width(std::string_view text, double size);

/// The text, cut with dots where it is wider than so many pixels.
[[nodiscard]] std::string fitting(std::string text, double size, double width);

/// Text as it can be shown by a page, a picture or a terminal: blanks for control characters (those
/// of a terminal move the cursor, and markup cannot hold them), U+FFFD for what is no letter.
/// @param line_ends  stay, else the text becomes one line
[[nodiscard]] std::string printable(std::string_view text, bool line_ends = false);

} // namespace whirl::report

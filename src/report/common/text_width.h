#pragma once

#include <string_view>

namespace whirl::report {

/// Width of a line of text in DejaVu Sans, the first font of the pictures (others that stand in for
/// it, such as Arial, are narrower). Source: the advance widths of the font itself (table `hmtx`).
/// @param text  UTF-8; beyond Latin-1 the width that most letters of the script do not exceed
/// @param size  of the font, pixels
/// @returns pixels
[[nodiscard]] double text_width(std::string_view text, double size);

} // namespace whirl::report

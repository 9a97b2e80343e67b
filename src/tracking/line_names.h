#pragma once

#include "tracking/tracking.h"

#include <cstddef>
#include <string>
#include <vector>

namespace whirl::tracking {

/// Places of the speeds that name lines among `count` evenly spaced ones: eleven, evenly spread
/// (all, where there are fewer), so that 11 and 101 speeds of one range name alike.
[[nodiscard]] std::vector<std::size_t> naming_places(std::size_t count);

struct LineName {
    std::string label; ///< "1B", "1F", "2B", ..., "3M"; empty: none
    /// However many speeds the line is followed over, it has this name.
    bool sure = false;
};

/// Names of lines (docs/conventions.md, Names of modes): the sense that a line has at most of the
/// naming speeds, and its number among the lines of that sense, in their order at the first of
/// these speeds; lines that begin later follow in the order in which they do. They have a name
/// where they are among the `modes` lowest at a naming speed.
/// @param naming  places of the naming speeds among those of the spectra, ascending
/// @param all     also the other lines that are among the `modes` lowest at some speed: the numbers
///                after those of their sense
[[nodiscard]] std::vector<LineName> line_names(const std::vector<Line> &lines,
                                               const std::vector<modes::Spectrum> &spectra,
                                               const std::vector<std::size_t> &naming, int modes,
                                               bool all);

} // namespace whirl::tracking

#pragma once

#include "model/case.h"
#include "tracking/tracking.h"

#include <cstddef>
#include <string>
#include <vector>

namespace whirl::tracking {

/// The speeds that name lines: eleven, evenly spread over the range however many speeds are asked
/// for there; one, where there is but one.
[[nodiscard]] std::vector<double> naming_speeds(const model::SpeedRange &range);

/// The speeds through which lines are followed: those that name them and the rows of bearing tables
/// between them, at most some forty: what begins or ends between two rows does so at other speeds
/// of the diagram too.
[[nodiscard]] std::vector<double> followed_speeds(const model::Rotor &rotor,
                                                  const model::SpeedRange &range);

struct LineName {
    std::string label; ///< "1B", "1F", "2B", ..., "3M", "e1F"; empty: none
    /// However many speeds the line is followed over, it has this name.
    bool sure = false;
};

/// Names of lines (docs/conventions.md, Names of modes): the sense that a line has at most of the
/// naming speeds, and its number among the lines of that sense, in their order at the first of
/// these speeds. Lines that begin later have numbers of their own (e1F), in the order in which they
/// begin: so no number depends on how many lines are followed. Sure are those that are among the
/// `modes` lowest at a naming speed; those that are so only between have the last numbers.
/// @param naming  places of the naming speeds among those of the spectra, ascending
[[nodiscard]] std::vector<LineName> line_names(const std::vector<Line> &lines,
                                               const std::vector<modes::Spectrum> &spectra,
                                               const std::vector<std::size_t> &naming, int modes);

} // namespace whirl::tracking

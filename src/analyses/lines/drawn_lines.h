#pragma once

#include "model/case.h"
#include "tracking/followed_lines.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace whirl::analyses {

/// The speeds of the diagram and those between them that name its lines, ascending.
[[nodiscard]] std::vector<double> with_naming_speeds(const model::SpeedRange &range);

/// Places of some of these speeds.
[[nodiscard]] std::vector<std::size_t> places_of(const std::vector<double> &some,
                                                 const std::vector<modes::Spectrum> &spectra);

/// What is drawn: the lines that are among the `modes` lowest at some speed of the diagram, there.
struct Drawn {
    std::vector<std::string> labels;
    std::vector<int> places; ///< of the lines that were found among these, or -1
};

/// Leaves the lines that are drawn.
/// @param own  places of the speeds of the diagram
/// @param all  lines that are among the lowest at other speeds are drawn too
[[nodiscard]] Drawn keep_lowest(tracking::FollowedLines &found, const model::SpeedRange &range,
                                const std::vector<std::size_t> &own, int modes, bool all);

/// Leaves the speeds of the diagram.
void keep_own(tracking::FollowedLines &found, const std::vector<std::size_t> &own);

/// Of crossings and intervals of all lines those of the lines drawn.
template <class Item> void keep_drawn(std::vector<Item> &items, const Drawn &drawn) {
    for (Item &item : items)
        item.mode = drawn.places[static_cast<std::size_t>(item.mode)];
    std::erase_if(items, [](const Item &item) { return item.mode < 0; });
}

} // namespace whirl::analyses

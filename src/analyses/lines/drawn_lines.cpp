#include "analyses/lines/drawn_lines.h"

#include "tracking/line_names.h"
#include "tracking/tracking.h"

#include <iterator>
#include <utility>

namespace whirl::analyses {

std::vector<double> with_naming_speeds(const model::SpeedRange &range) {
    const std::vector<double> own = range.values();
    const std::vector<double> naming = tracking::naming_speeds(range);
    std::vector<double> all;
    std::set_union(own.begin(), own.end(), naming.begin(), naming.end(), std::back_inserter(all));
    return all;
}

std::vector<std::size_t> places_of(const std::vector<double> &some,
                                   const std::vector<modes::Spectrum> &spectra) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < spectra.size(); ++k)
        if (std::binary_search(some.begin(), some.end(), spectra[k].speed))
            places.push_back(k);
    return places;
}

namespace {

template <class Item>
void keep_places(std::vector<Item> &items, const std::vector<std::size_t> &places) {
    std::vector<Item> kept;
    for (const std::size_t k : places)
        kept.push_back(std::move(items[k]));
    items = std::move(kept);
}

} // namespace

Drawn keep_lowest(tracking::FollowedLines &found, const model::SpeedRange &range,
                  const std::vector<std::size_t> &own, int modes, bool all) {
    std::vector<tracking::Line> &lines = found.tracking.lines;
    const std::vector<tracking::LineName> names = tracking::line_names(
        lines, found.spectra, places_of(tracking::naming_speeds(range), found.spectra), modes);
    std::vector<tracking::Line> lowest;
    Drawn out;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        tracking::Line there = lines[i];
        keep_places(there.place, own);
        const bool drawn = tracking::among_lowest(there, modes) ||
                           (all && tracking::among_lowest(lines[i], modes));
        out.places.push_back(drawn ? static_cast<int>(lowest.size()) : -1);
        if (!drawn)
            continue;
        out.labels.push_back(names[i].label);
        lowest.push_back(std::move(lines[i]));
    }
    lines = std::move(lowest);
    return out;
}

void keep_own(tracking::FollowedLines &found, const std::vector<std::size_t> &own) {
    keep_places(found.spectra, own);
    keep_places(found.tracking.rates, own);
    for (tracking::Line &line : found.tracking.lines) {
        keep_places(line.place, own);
        keep_places(line.absence, own);
    }
}

} // namespace whirl::analyses

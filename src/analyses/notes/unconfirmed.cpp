#include "analyses/notes/unconfirmed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace whirl::analyses {

void note_unconfirmed(results::ModelSummary &model, const std::vector<modes::Spectrum> &spectra,
                      bool few_shapes) {
    std::vector<double> speeds;
    for (const modes::Spectrum &spectrum : spectra)
        if (std::ranges::any_of(spectrum.modes,
                                [](const modes::WhirlMode &mode) { return !mode.confirmed; }))
            speeds.push_back(std::abs(spectrum.speed));
    if (speeds.empty())
        return;
    model.notes.push_back(fmt::format(
        "at {} of {} speeds, up to {:.6g} rad/s, but not at rest, frequencies change by far more "
        "than the spin speed within a turn: whirl speeds without an error bar there are those of "
        "{}, and may be wrong; other modes may be missing at these speeds, with faster ones in "
        "their place",
        speeds.size(), spectra.size(), *std::ranges::max_element(speeds),
        few_shapes ? "the rotor on few shapes, not confirmed by the one with all unknowns"
                   : "a series with too few harmonics"));
}

void note_unconfirmed(results::CampbellResult &result, const std::vector<double> &speeds) {
    std::set<double> listed;
    const auto is = [&speeds](double speed) { return std::ranges::count(speeds, speed) > 0; };
    for (const results::Crossing &crossing : result.crossings)
        if (is(crossing.speed))
            listed.insert(crossing.speed);
    for (const results::Locked &band : result.locked)
        for (const double end : {band.from, band.to})
            if (is(end))
                listed.insert(end);
    if (!listed.empty())
        result.model.notes.push_back(
            fmt::format("crossings and ends of intervals at {:.10g} rad/s are those of the rotor "
                        "on few shapes, not confirmed by the one with all unknowns",
                        fmt::join(listed, ", ")));
}

} // namespace whirl::analyses

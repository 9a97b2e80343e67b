#include "analyses/campbell.h"

#include "analyses/notes/campbell_notes.h"
#include "assembly/discretization.h"
#include "mesh_error/estimate.h"
#include "modes/formulation.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/campbell.h"
#include "results/damping.h"
#include "results/formulation.h"
#include "results/model_summary.h"
#include "results/whirl.h"
#include "tracking/crossings.h"
#include "tracking/followed_lines.h"
#include "tracking/hill/periodic_diagram.h"
#include "tracking/line_errors.h"
#include "tracking/line_names.h"
#include "tracking/tracking.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

/// The speeds of the diagram and those between them that name its lines, ascending.
std::vector<double> with_naming_speeds(const model::SpeedRange &range) {
    const std::vector<double> own = range.values();
    const std::vector<double> naming = tracking::naming_speeds(range);
    std::vector<double> all;
    std::ranges::set_union(own, naming, std::back_inserter(all));
    return all;
}

/// Places of some of these speeds.
std::vector<std::size_t> places_of(const std::vector<double> &some,
                                   const std::vector<modes::Spectrum> &spectra) {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < spectra.size(); ++k)
        if (std::ranges::binary_search(some, spectra[k].speed))
            places.push_back(k);
    return places;
}

template <class Item>
void keep_places(std::vector<Item> &items, const std::vector<std::size_t> &places) {
    std::vector<Item> kept;
    for (const std::size_t k : places)
        kept.push_back(std::move(items[k]));
    items = std::move(kept);
}

/// What is drawn: the lines that are among the `modes` lowest at some speed of the diagram, there.
struct Drawn {
    std::vector<std::string> labels;
    std::vector<int> places; ///< of the lines that were found among these, or -1
};

/// Leaves the lines that are drawn.
/// @param own  places of the speeds of the diagram
/// @param all  lines that are among the lowest at other speeds are drawn too
Drawn keep_lowest_lines(tracking::FollowedLines &found, const model::SpeedRange &range,
                        const std::vector<std::size_t> &own, int modes, bool all) {
    std::vector<tracking::Line> &lines = found.tracking.lines;
    const std::vector<tracking::LineName> names = tracking::line_names(
        lines, found.spectra, places_of(tracking::naming_speeds(range), found.spectra), modes);
    std::vector<tracking::Line> lowest;
    Drawn out;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        tracking::Line looked_at = lines[i];
        if (!all)
            keep_places(looked_at.place, own);
        const bool drawn = tracking::among_lowest(looked_at, modes);
        out.places.push_back(drawn ? static_cast<int>(lowest.size()) : -1);
        if (!drawn)
            continue;
        out.labels.push_back(names[i].label);
        lowest.push_back(std::move(lines[i]));
    }
    lines = std::move(lowest);
    return out;
}

/// Leaves the speeds of the diagram.
void keep_own(tracking::FollowedLines &found, const std::vector<std::size_t> &own) {
    keep_places(found.spectra, own);
    keep_places(found.tracking.rates, own);
    for (tracking::Line &line : found.tracking.lines) {
        keep_places(line.place, own);
        keep_places(line.absence, own);
    }
}

/// Of crossings or intervals of all lines those of the lines drawn.
template <class Item> void keep_drawn(std::vector<Item> &items, const Drawn &drawn) {
    for (Item &item : items)
        item.mode = drawn.places[static_cast<std::size_t>(item.mode)];
    std::erase_if(items, [](const Item &item) { return item.mode < 0; });
}

std::string word(tracking::Absence why) {
    switch (why) {
    case tracking::Absence::overdamped:
        return "overdamped";
    case tracking::Absence::divergent:
        return "diverges";
    case tracking::Absence::beyond:
        return "beyond the modes computed";
    case tracking::Absence::lost:
        return "not followed";
    default:
        return "";
    }
}

/// None where the part of the mesh is not known.
/// @param followed  the mode is continued over the speeds: its residual is what that leaves. Of an
///                  eigensolver on all unknowns it is rounding.
std::optional<results::ErrorParts> parts_of(std::optional<double> by_mesh,
                                            const modes::WhirlMode &mode, bool followed) {
    if (!by_mesh)
        return std::nullopt;
    return followed ? results::ErrorParts{*by_mesh, mode.residual, mode.rounding}
                    : results::ErrorParts{*by_mesh, 0, mode.residual + mode.rounding};
}

results::CampbellMode mode_along(const tracking::Line &line,
                                 const std::vector<modes::Spectrum> &spectra,
                                 const std::vector<std::optional<double>> &errors, bool rotating,
                                 bool followed) {
    const std::size_t speeds = spectra.size();
    results::CampbellMode out;
    for (auto *list :
         {&out.frequency, &out.real, &out.damping_ratio, &out.log_dec, &out.error, &out.residual})
        list->resize(speeds);
    for (auto *list : {&out.frequency_rotating, &out.other_frequency})
        list->resize(rotating ? speeds : 0);
    out.error_parts.resize(speeds);
    out.whirl.assign(speeds, results::Whirl::mixed);
    out.forward_fraction.assign(speeds, 0.5);
    for (std::size_t k = 0; k < speeds; ++k) {
        out.absent.push_back(word(line.absence[k]));
        if (line.place[k] == tracking::Line::absent)
            continue;
        const modes::WhirlMode &mode = spectra[k].modes[static_cast<std::size_t>(line.place[k])];
        const results::Damping damping = results::damping_of(mode.eigenvalue);
        out.frequency[k] = mode.eigenvalue.imag();
        if (rotating) {
            out.frequency_rotating[k] = mode.frequency_rotating;
            out.other_frequency[k] = mode.other_frequency;
        }
        out.real[k] = mode.eigenvalue.real();
        out.damping_ratio[k] = damping.ratio;
        out.log_dec[k] = damping.log_dec;
        out.whirl[k] = mode.whirl;
        out.forward_fraction[k] = mode.forward_fraction;
        if (mode.confirmed)
            out.residual[k] = mode.residual;
        out.error_parts[k] = parts_of(errors[k], mode, followed);
        if (out.error_parts[k])
            out.error[k] = out.error_parts[k]->sum();
    }
    return out;
}

void add_modes(const model::Case &scene, const modes::SpectrumSolver &solver,
               const tracking::FollowedLines &found, const Drawn &drawn,
               results::CampbellResult &result) {
    const std::vector<tracking::Line> &lines = found.tracking.lines;
    const tracking::LineErrors errors =
        tracking::line_errors(scene.rotor, solver, lines, found.spectra);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        result.modes.push_back(mode_along(lines[i], found.spectra, errors[i],
                                          results::in_rotating_axes(solver.form()),
                                          solver.follows()));
        result.modes.back().label = drawn.labels[i];
    }
    for (const modes::Spectrum &spectrum : found.spectra) {
        const auto largest = std::ranges::max_element(spectrum.growing);
        result.divergence.push_back(largest == spectrum.growing.end() ? std::nullopt
                                                                      : std::optional(*largest));
    }
}

} // namespace

results::CampbellResult campbell(const model::Case &scene) {
    const model::SpeedRange &range = model::required_speeds(scene);
    results::CampbellResult result;
    result.model.formulation = modes::choose_formulation(scene);
    result.model.order = mesh_error::resolve_order(scene, result.model.formulation);
    result.speeds = range.values();
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    result.model.unknowns = solver.unknowns();
    result.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    std::optional<process::Stage> stage(std::in_place, "whirl speeds", 0.0, 0.5);
    std::optional<tracking::PeriodicDiagram> periodic;
    if (scene.reduction && solver.form() == results::Form::hill)
        periodic = tracking::periodic_diagram(solver, result.speeds, tracking::naming_speeds(range),
                                              scene.campbell.modes, scene.campbell.multiples);
    tracking::FollowedLines found =
        periodic ? std::move(periodic->found)
                 : tracking::followed_lines(solver, with_naming_speeds(range), scene.campbell.modes,
                                            scene.reduction);
    if (process::process_rank() != 0)
        return result;
    // Steps longer than those between the speeds that name lines hide crossings and exchange lines:
    // then these speeds are searched too.
    const bool coarse = result.speeds.size() < tracking::naming_speeds(range).size();
    const std::vector<std::size_t> own = places_of(result.speeds, found.spectra);
    const Drawn drawn =
        keep_lowest_lines(found, range, own, scene.campbell.modes, periodic || coarse);
    tracking::Crossings crossed;
    const auto search = [&] {
        return tracking::crossings(solver, found.tracking, found.spectra, scene.campbell.multiples);
    };
    if (periodic) {
        crossed = std::move(periodic->crossed);
        keep_drawn(crossed.found, drawn);
        keep_drawn(crossed.locked, drawn);
    } else if (coarse) {
        crossed = search();
    }
    keep_own(found, own);
    stage.emplace("errors of the whirl speeds", 0.5, 0.75);
    add_modes(scene, solver, found, drawn, result);
    stage.emplace("crossings", 0.75, 1.0);
    if (!periodic && !coarse)
        crossed = search();
    result.crossings = std::move(crossed.found);
    result.locked = std::move(crossed.locked);
    add_campbell_notes(scene.campbell, found, crossed, periodic.has_value(), result);
    return result;
}

} // namespace whirl::analyses

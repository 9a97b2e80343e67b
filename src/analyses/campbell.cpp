#include "analyses/campbell.h"

#include "analyses/notes/ball_positions.h"
#include "analyses/notes/campbell_notes.h"
#include "assembly/discretization.h"
#include "mesh_error/estimate.h"
#include "mesh_error/finer_model.h"
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
#include "tracking/hill/whole_and_reduced.h"
#include "tracking/line_errors.h"
#include "tracking/line_names.h"
#include "tracking/tracking.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace whirl::analyses {

namespace {

/// The speeds of the diagram and those between them through which lines are followed, ascending.
std::vector<double> with_nodes(const model::SpeedRange &range, const std::vector<double> &nodes) {
    const std::vector<double> own = range.values();
    std::vector<double> all;
    std::ranges::set_union(own, nodes, std::back_inserter(all));
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

/// Leaves the speeds of the diagram.
void keep_own(tracking::FollowedLines &found, const std::vector<std::size_t> &own) {
    keep_places(found.spectra, own);
    keep_places(found.tracking.rates, own);
    for (tracking::Line &line : found.tracking.lines) {
        keep_places(line.place, own);
        keep_places(line.absence, own);
    }
}

/// Leaves the lines that are drawn. @returns their names
std::vector<std::string> keep_drawn(const std::vector<char> &drawn,
                                    const std::vector<tracking::LineName> &names,
                                    tracking::FollowedLines &found, tracking::Crossings &crossed) {
    std::vector<tracking::Line> lines;
    std::vector<std::string> labels;
    std::vector<int> places;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        places.push_back(drawn[i] != 0 ? static_cast<int>(lines.size()) : -1);
        if (drawn[i] == 0)
            continue;
        labels.push_back(names[i].label);
        lines.push_back(std::move(found.tracking.lines[i]));
    }
    found.tracking.lines = std::move(lines);
    for (results::Crossing &crossing : crossed.found)
        crossing.mode = places[static_cast<std::size_t>(crossing.mode)];
    for (results::Locked &band : crossed.locked)
        band.mode = places[static_cast<std::size_t>(band.mode)];
    return labels;
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
/// @param refined  from the rotor on few shapes: its residual is what that leaves. Of an
///                 eigensolver on all unknowns it is rounding.
std::optional<results::ErrorParts> parts_of(std::optional<double> by_mesh,
                                            const modes::WhirlMode &mode, bool refined) {
    if (!by_mesh)
        return std::nullopt;
    return refined ? results::ErrorParts{*by_mesh, mode.residual, mode.rounding}
                   : results::ErrorParts{*by_mesh, 0, mode.residual + mode.rounding};
}

results::CampbellMode mode_along(const tracking::Line &line,
                                 const std::vector<modes::Spectrum> &spectra,
                                 const std::vector<std::optional<double>> &errors, bool rotating,
                                 bool refined) {
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
    out.plane.resize(speeds);
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
        out.plane[k] = mode.plane;
        if (mode.confirmed)
            out.residual[k] = mode.residual;
        out.error_parts[k] = parts_of(errors[k], mode, refined);
        if (out.error_parts[k])
            out.error[k] = out.error_parts[k]->sum();
    }
    return out;
}

void add_modes(const modes::SpectrumSolver &solver, const tracking::FollowedLines &found,
               const std::vector<std::string> &labels, const tracking::LineErrors &errors,
               results::CampbellResult &result) {
    const std::vector<tracking::Line> &lines = found.tracking.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        result.modes.push_back(mode_along(lines[i], found.spectra, errors[i],
                                          results::in_rotating_axes(solver.form()),
                                          solver.refines()));
        result.modes.back().label = labels[i];
    }
    for (const modes::Spectrum &spectrum : found.spectra) {
        const auto largest = std::ranges::max_element(spectrum.growing);
        result.divergence.push_back(largest == spectrum.growing.end() ? std::nullopt
                                                                      : std::optional(*largest));
    }
}

/// Of crossings that were found on all unknowns, what finer elements change of them.
std::vector<std::optional<double>> changes_by_mesh(const model::Case &scene,
                                                   const modes::SpectrumSolver &solver,
                                                   tracking::Crossings crossed) {
    const tracking::WholeAndReduced same{
        solver, solver, tracking::modes_to_follow(scene.rotor, scene.campbell.modes)};
    const auto [low, high] = std::minmax(scene.speeds->from, scene.speeds->to);
    const mesh_error::FinerModel finer(scene.rotor, solver);
    same.improve(crossed, low, high, &finer);
    return std::move(crossed.by_mesh);
}

/// @param by_mesh  not null: crossings alone are wanted, and what finer elements change of them;
///                 lines are then as good as these need, without errors, at all speeds followed
results::CampbellResult diagram(const model::Case &scene,
                                std::vector<std::optional<double>> *by_mesh) {
    const model::SpeedRange &range = model::required_speeds(scene);
    results::CampbellResult result;
    result.model.formulation = modes::choose_formulation(scene);
    result.model.order = mesh_error::resolve_order(scene, result.model.formulation);
    result.speeds = range.values();
    const modes::SpectrumSolver solver(scene.rotor, result.model.formulation.form,
                                       result.model.order);
    note_other_positions(scene.rotor, result.model.notes);
    if (!scene.reduction)
        solver.take_all_unknowns();
    result.model.unknowns = solver.unknowns();
    result.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    std::optional<process::Stage> stage(std::in_place, "whirl speeds", 0.0, 0.5);
    std::optional<tracking::PeriodicDiagram> periodic;
    const int modes = scene.campbell.modes;
    const std::vector<double> naming = tracking::naming_speeds(range);
    if (scene.reduction && solver.form() == results::Form::hill)
        periodic = tracking::periodic_diagram(
            solver, by_mesh == nullptr ? result.speeds : std::vector<double>(), naming, modes,
            scene.campbell.multiples);
    const std::vector<double> nodes = tracking::followed_speeds(scene.rotor, range);
    int followed = modes;
    if (solver.form() != results::Form::hill && !scene.campbell.multiples.empty())
        followed = tracking::modes_below(solver, std::max(std::abs(range.from), std::abs(range.to)),
                                         std::ranges::max(scene.campbell.multiples), modes);
    tracking::FollowedLines found =
        periodic ? std::move(periodic->found)
                 : tracking::followed_lines(solver, with_nodes(range, nodes), followed,
                                            scene.reduction, nodes);
    if (process::process_rank() != 0)
        return result;
    if (periodic && by_mesh != nullptr) {
        result.speeds.clear();
        for (const modes::Spectrum &spectrum : found.spectra)
            result.speeds.push_back(spectrum.speed);
    }
    const std::vector<std::size_t> own = places_of(result.speeds, found.spectra);
    const std::vector<tracking::LineName> names = tracking::line_names(
        found.tracking.lines, found.spectra, places_of(naming, found.spectra), modes);
    // Steps longer than those between the speeds that name lines hide crossings and exchange lines:
    // then these speeds are searched too.
    const bool coarse = result.speeds.size() < nodes.size();
    if (!periodic && !coarse)
        keep_own(found, own);
    stage.emplace("crossings", 0.5, 0.75);
    tracking::Crossings crossed =
        periodic
            ? std::move(periodic->crossed)
            : tracking::crossings(solver, found.tracking, found.spectra, scene.campbell.multiples);
    const std::vector<char> drawn =
        tracking::lines_drawn(found.tracking.lines, found.spectra, modes, crossed);
    const std::vector<std::string> labels = keep_drawn(drawn, names, found, crossed);
    if (periodic || coarse)
        keep_own(found, own);
    stage.emplace("errors", 0.75, 1.0);
    const tracking::LineErrors errors =
        by_mesh == nullptr
            ? tracking::line_errors(scene.rotor, solver, found.tracking.lines, found.spectra)
            : tracking::LineErrors(found.tracking.lines.size(),
                                   tracking::LineErrors::value_type(found.spectra.size()));
    add_modes(solver, found, labels, errors, result);
    if (by_mesh != nullptr)
        *by_mesh = periodic ? std::move(crossed.by_mesh) : changes_by_mesh(scene, solver, crossed);
    result.crossings = std::move(crossed.found);
    result.locked = std::move(crossed.locked);
    add_campbell_notes(scene.campbell, found, crossed, periodic.has_value(), result);
    return result;
}

} // namespace

results::CampbellResult campbell(const model::Case &scene) { return diagram(scene, nullptr); }

HillCrossings hill_crossings(const model::Case &scene) {
    HillCrossings out;
    out.diagram = diagram(scene, &out.by_mesh);
    return out;
}

} // namespace whirl::analyses

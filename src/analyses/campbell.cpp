#include "analyses/campbell.h"

#include "analyses/lines/drawn_lines.h"
#include "analyses/notes/gaps.h"
#include "analyses/notes/growing_lines.h"
#include "analyses/notes/unconfirmed.h"
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

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>

namespace whirl::analyses {

namespace {

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
    results::CampbellMode out;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        out.absent.push_back(word(line.absence[k]));
        if (line.place[k] == tracking::Line::absent) {
            for (auto *list : {&out.frequency, &out.real, &out.damping_ratio, &out.log_dec,
                               &out.error, &out.residual})
                list->emplace_back();
            out.error_parts.emplace_back();
            if (rotating) {
                out.frequency_rotating.emplace_back();
                out.other_frequency.emplace_back();
            }
            out.whirl.push_back(results::Whirl::mixed);
            out.forward_fraction.push_back(0.5);
            continue;
        }
        const modes::WhirlMode &mode = spectra[k].modes[static_cast<std::size_t>(line.place[k])];
        const results::Damping damping = results::damping_of(mode.eigenvalue);
        out.frequency.emplace_back(mode.eigenvalue.imag());
        if (rotating) {
            out.frequency_rotating.emplace_back(mode.frequency_rotating);
            out.other_frequency.push_back(mode.other_frequency);
        }
        out.real.emplace_back(mode.eigenvalue.real());
        out.damping_ratio.push_back(damping.ratio);
        out.log_dec.push_back(damping.log_dec);
        out.whirl.push_back(mode.whirl);
        out.forward_fraction.push_back(mode.forward_fraction);
        out.residual.push_back(mode.confirmed ? std::optional(mode.residual) : std::nullopt);
        out.error_parts.push_back(parts_of(errors[k], mode, followed));
        out.error.push_back(out.error_parts.back() ? std::optional(out.error_parts.back()->sum())
                                                   : std::nullopt);
    }
    return out;
}

/// What the absence of modes at some speeds means.
std::string absence_note(tracking::Absence why, const std::string &labels, bool several) {
    const std::string who = (several ? "modes " : "mode ") + labels;
    const std::string they = several ? "they" : "it";
    const auto verb = [several](const char *one, const char *more) { return several ? more : one; };
    switch (why) {
    case tracking::Absence::overdamped:
        return fmt::format("{} {} overdamped at some speeds and {} no whirl frequency there", who,
                           verb("is", "are"), verb("has", "have"));
    case tracking::Absence::divergent:
        return fmt::format("{} {} at some speeds: the eigenvalue is real and positive there, {} {} "
                           "without whirling",
                           who, verb("diverges", "diverge"), they, verb("grows", "grow"));
    case tracking::Absence::beyond:
        return fmt::format("{} {} beyond the computed modes at some speeds", who,
                           verb("lies", "lie"));
    default:
        return fmt::format("{} could not be followed to some speeds; {} {} on there as {}", who,
                           they, verb("goes", "go"), verb("another line", "other lines"));
    }
}

void note_absent(results::CampbellResult &result, const std::vector<tracking::Line> &lines) {
    for (const tracking::Absence why : {tracking::Absence::overdamped, tracking::Absence::divergent,
                                        tracking::Absence::beyond, tracking::Absence::lost}) {
        std::string labels;
        int count = 0;
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (std::ranges::count(lines[i].absence, why) > 0)
                labels += (count++ > 0 ? ", " : "") + result.modes[i].label;
        if (count > 0)
            result.model.notes.push_back(absence_note(why, labels, count > 1));
    }
}

/// `critical` has no answer where the equations stay periodic.
bool critical_knows(const results::CampbellResult &result) {
    return result.model.formulation.form != results::Form::hill;
}

/// Speeds so far apart that lines exchange their places between them.
void note_far_apart(results::CampbellResult &result) {
    constexpr int most = 4; // of two pairs of modes
    int largest = 0;
    std::size_t at = 0;
    for (std::size_t k = 1; k < result.speeds.size(); ++k) {
        const auto inside = static_cast<int>(
            std::ranges::count_if(result.crossings, [&](const results::Crossing &c) {
                return c.multiple == result.crossings.front().multiple &&
                       c.speed > result.speeds[k - 1] && c.speed <= result.speeds[k];
            }));
        if (inside > largest) {
            largest = inside;
            at = k;
        }
    }
    if (largest > most)
        result.model.notes.push_back(fmt::format(
            "{} crossings lie between {:.6g} and {:.6g} rad/s, two neighbours of the speeds: modes "
            "that exchange their places in between can cross unseen; take more speeds{}",
            largest, result.speeds[at - 1], result.speeds[at],
            critical_knows(result) ? ", or `critical`, which needs none" : ""));
}

/// Real eigenvalues: those that die out are overdamped motion, those that grow are divergence.
void note_real(results::CampbellResult &result, const std::vector<modes::Spectrum> &spectra) {
    std::size_t overdamped = 0;
    std::size_t diverging = 0;
    double worst = 0;
    double at = 0;
    for (const modes::Spectrum &spectrum : spectra) {
        overdamped = std::max(overdamped, spectrum.overdamped.size() - spectrum.growing.size());
        result.divergence.emplace_back();
        if (spectrum.growing.empty())
            continue;
        ++diverging;
        const double largest = *std::ranges::max_element(spectrum.growing);
        result.divergence.back() = largest;
        if (largest > worst) {
            worst = largest;
            at = spectrum.speed;
        }
    }
    if (diverging > 0)
        result.model.notes.push_back(
            fmt::format("divergence (static instability) at {} of {} speeds: a real eigenvalue of "
                        "{:+.6g} 1/s at {:.6g} rad/s, motion grows without whirling",
                        diverging, spectra.size(), worst, at));
    if (overdamped > 0)
        result.model.notes.push_back(
            fmt::format("up to {} overdamped motions, which do not whirl, lie among the ones "
                        "computed at a speed: real eigenvalues, and pairs with a damping ratio "
                        "above {:.4f}; they have no line and no crossings",
                        overdamped, modes::overdamped_ratio));
}

/// Crossings that are no critical speeds: the damping of these beats every peak.
void note_no_peaks(results::CampbellResult &result) {
    std::vector<double> speeds;
    for (const results::Crossing &c : result.crossings)
        if (c.multiple == 1 && c.damping.ratio && *c.damping.ratio > 1 / std::numbers::sqrt2)
            speeds.push_back(c.speed);
    if (!speeds.empty())
        result.model.notes.push_back(fmt::format(
            "crossings of 1x with a damping ratio above 1/sqrt(2), at {:.6g} rad/s, "
            "make no peak in a response{}",
            fmt::join(speeds, ", "), critical_knows(result) ? "; `critical` leaves them out" : ""));
}

/// Of a Hill series at every speed ends of such intervals are looked for in the steps that show a
/// change; by monodromy matrices all of 1x are searched for.
/// @param by_steps  as the first
void note_short_bands(results::ModelSummary &model, bool by_steps,
                      const std::vector<double> &multiples) {
    if (model.formulation.form != results::Form::hill)
        return;
    if (by_steps)
        model.notes.push_back("a motion that comes to stay on a multiple of the spin speed and "
                              "leaves it again within one step of the speeds may not be listed");
    else if (std::ranges::any_of(multiples, [](double m) { return m != 1; }))
        model.notes.push_back("a motion that comes to stay on another multiple of the spin speed "
                              "than 1x and leaves it again within a 200th of the range may not be "
                              "listed");
}

void note_few(results::ModelSummary &model, const std::vector<modes::Spectrum> &spectra,
              int wanted) {
    const bool few = std::ranges::any_of(spectra, [wanted](const modes::Spectrum &s) {
        return static_cast<int>(s.modes.size()) < wanted;
    });
    if (few)
        model.notes.push_back(
            fmt::format("at some speed there are fewer than the {} whirl modes asked for, or no "
                        "more that double "
                        "precision resolves beside the others: all found are listed",
                        wanted));
}

void add_notes(results::CampbellResult &result, const model::CampbellSettings &settings,
               const tracking::FollowedLines &found, const tracking::Crossings &crossed,
               bool by_steps) {
    note_absent(result, found.tracking.lines);
    note_growing(result);
    note_far_apart(result);
    note_real(result, found.spectra);
    note_no_peaks(result);
    note_short_bands(result.model, by_steps, settings.multiples);
    note_few(result.model, found.spectra, settings.modes);
    note_gaps(result.model, found.tracking.gaps, "a mode could not be followed");
    note_gaps(result.model, crossed.unsettled,
              "a frequency changes sides of a multiple of the spin speed without a crossing that "
              "could be verified");
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
    const Drawn drawn = keep_lowest(found, range, own, scene.campbell.modes, periodic || coarse);
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
    add_notes(result, scene.campbell, found, crossed, !periodic);
    note_unconfirmed(result.model, found.spectra, periodic.has_value());
    note_unconfirmed(result, crossed.unconfirmed);
    return result;
}

} // namespace whirl::analyses

#include "analyses/names/mode_naming.h"

#include "assembly/discretization.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "tracking/mode_names.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <utility>

namespace whirl::analyses {

namespace {

template <class Item> std::vector<double> speeds_of(const std::vector<Item> &items) {
    std::vector<double> speeds;
    for (const Item &item : items)
        if (item.speed != 0)
            speeds.push_back(item.speed);
    return speeds;
}

/// The peaks of all stations lie close together at each resonance: one speed in place of those
/// within a hundredth.
std::vector<double> few_speeds(std::vector<double> speeds) {
    std::ranges::sort(speeds);
    std::vector<double> few;
    for (auto first = speeds.begin(); first != speeds.end();) {
        const auto last = std::find_if(first, speeds.end(), [first](double speed) {
            return speed - *first > 0.01 * std::abs(*first);
        });
        few.push_back(*(first + (last - first) / 2));
        first = last;
    }
    return few;
}

std::optional<double> next_to(const std::vector<double> &speeds, double speed) {
    const auto found =
        std::ranges::min_element(speeds, {}, [speed](double a) { return std::abs(a - speed); });
    return found == speeds.end() ? std::nullopt : std::optional(*found);
}

/// Lines are not followed to give names where that takes long.
bool has_lines(const model::Case &scene) { return scene.speeds && scene.rotor.balancers.empty(); }

/// The form in which lines are followed to give names; none where they are not.
/// @param periodic  of periodic equations too
std::optional<results::Form> form_for_names(const model::Case &scene, bool periodic) {
    if (!has_lines(scene))
        return std::nullopt;
    try {
        const results::Form form = modes::choose_formulation(scene).form;
        const bool followed =
            !results::in_rotating_axes(form) || (periodic && form == results::Form::hill);
        return followed ? std::optional(form) : std::nullopt;
    } catch (const model::BadInput &) { // a form that describes the response, not the modes
        return std::nullopt;
    }
}

/// The names come beside the answer: spectra that may be solved for them alone.
constexpr int most_more = 60;

std::optional<tracking::ModeNames> names_of(const ModesBeside &modes, results::Form form,
                                            tracking::ModesToName wanted) {
    const model::Case &scene = modes.scene();
    const modes::SpectrumSolver &solver = modes.in(form);
    const bool periodic = form == results::Form::hill;
    if (periodic && !solver.by_matrix()) // a Hill series at each speed
        return std::nullopt;
    if (form == results::Form::general || periodic)
        wanted.most_more = most_more;
    return tracking::mode_names(solver, *scene.speeds, scene.campbell.modes, scene.reduction,
                                wanted);
}

} // namespace

ModesBeside::ModesBeside(const model::Case &scene, int order) : _scene(scene), _order(order) {}

ModesBeside::~ModesBeside() = default;

const modes::SpectrumSolver &ModesBeside::in(results::Form form) const {
    if (!_solver || _solver->form() != form) {
        _solver = std::make_unique<modes::SpectrumSolver>(_scene.rotor, form, _order);
        if (_scene.reduction)
            _solver->take_reduced_roots();
        else
            _solver->take_all_unknowns();
        _whole.reset();
        if (form == results::Form::hill && _scene.reduction && _scene.speeds)
            try {
                const auto [from, to] = std::minmax(_scene.speeds->from, _scene.speeds->to);
                auto reduced = _solver->by_monodromy(from, to, _scene.campbell.modes);
                _whole = std::exchange(_solver, std::move(reduced));
            } catch (const linalg::SolverError &) { // by Hill's series then
            } catch (const model::AnalysisFailure &) {
            }
    }
    return *_solver;
}

std::optional<modes::WhirlMode> ModesBeside::refined(double speed,
                                                     const modes::WhirlMode &mode) const {
    std::vector<modes::WhirlMode> found = (_whole ? *_whole : *_solver).near(speed, {mode});
    return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

void name_modes(std::vector<results::CriticalSpeed> &critical_speeds, const ModesBeside &modes) {
    const auto form = critical_speeds.empty() ? std::nullopt : form_for_names(modes.scene(), false);
    if (!form)
        return;
    const auto names =
        names_of(modes, *form, {speeds_of(critical_speeds), true, tracking::near_spin});
    if (!names)
        return;
    std::vector<std::string> found = tracking::names_of_critical(*names, critical_speeds);
    for (std::size_t i = 0; i < found.size(); ++i)
        critical_speeds[i].mode = std::move(found[i]);
}

void name_modes(std::vector<results::ResponsePeak> &peaks, const ModesBeside &modes,
                const PeakDrive &drive) {
    const auto form = peaks.empty() ? std::nullopt : form_for_names(modes.scene(), true);
    if (!form)
        return;
    const std::vector<double> solved = few_speeds(speeds_of(peaks));
    const auto near_drive = [&drive](const modes::Spectrum &spectrum, std::size_t place) {
        const auto near = [&](double frequency) {
            return std::abs(spectrum.modes[place].eigenvalue - std::complex(0.0, frequency)) <
                   tracking::resonant * frequency;
        };
        return near(drive.frequency_at(spectrum.speed)) ||
               near(drive.also * std::abs(spectrum.speed));
    };
    const auto names = names_of(modes, *form, {solved, false, near_drive});
    if (!names)
        return;
    // What turns with an isotropic rotor on isotropic bearings drives no backward whirl.
    const bool forward = drive.imbalances && results::is_planar(*form);
    const auto driven = [forward](const modes::WhirlMode &mode) {
        return !forward || mode.whirl == results::Whirl::forward;
    };
    for (results::ResponsePeak &peak : peaks) {
        const auto near = next_to(solved, peak.speed);
        if (!near)
            continue;
        const auto named = [&](double frequency, double within) {
            if (peak.mode.empty() && frequency > 0)
                peak.mode = names->nearest(
                    *near, {peak.speed, {0, frequency}, within * frequency, 1, driven});
        };
        const double frequency = drive.frequency_at(peak.speed);
        constexpr double unknown = 1e5; // amplification: without damping
        const double width = std::min(1 / peak.amplification.value_or(unknown), tracking::resonant);
        if (drive.also > 0) {
            named(frequency, width);
            named(drive.also * std::abs(peak.speed), width);
        }
        named(frequency, tracking::resonant);
    }
}

namespace {

/// The frequencies in the fixed axes that the motion of an end may have, rad/s.
std::vector<double> frequencies_of(const results::StabilityEnd &end) {
    if (end.frequency)
        return {*end.frequency};
    if (!end.frequency_rotating)
        return {};
    const double spin = std::abs(end.speed);
    return {spin + *end.frequency_rotating, std::abs(spin - *end.frequency_rotating)};
}

/// Name of the mode that neither grows nor dies out at an end; empty where more than one may be it.
std::string name_at(const results::StabilityEnd &end, const tracking::ModeNames &names) {
    constexpr double within = 1e-4; // of the frequency: an end is a root, so that rounding is left
    constexpr double clear = 10;
    std::string found;
    for (const double frequency : frequencies_of(end)) {
        const std::string name = names.nearest(
            end.speed,
            {end.speed, {0, frequency}, within * frequency, clear, [](const modes::WhirlMode &) {
                 return true;
             }});
        if (!found.empty() && !name.empty() && name != found)
            return "";
        if (!name.empty())
            found = name;
    }
    return found;
}

/// Whether a mode is that of one of the ends.
bool at_an_end(std::complex<double> value, double speed,
               const std::vector<results::StabilityEnd> &ends) {
    constexpr double about = 1e-3;
    for (const results::StabilityEnd &end : ends)
        if (end.speed == speed)
            for (const double frequency : frequencies_of(end))
                if (std::abs(value - std::complex<double>(0, frequency)) < about * frequency)
                    return true;
    return false;
}

} // namespace

void name_modes(std::vector<results::StabilityEnd> &ends, const ModesBeside &modes,
                results::Form form) {
    std::vector<double> speeds;
    for (const results::StabilityEnd &end : ends)
        if (end.kind == results::EndKind::pair)
            speeds.push_back(end.speed);
    if (speeds.empty() || !has_lines(modes.scene()) || results::in_rotating_axes(form))
        return;
    const auto which = [&ends](const modes::Spectrum &spectrum, std::size_t place) {
        return at_an_end(spectrum.modes[place].eigenvalue, spectrum.speed, ends);
    };
    const auto names = names_of(modes, form, {speeds, false, which, most_more});
    if (!names)
        return;
    for (results::StabilityEnd &end : ends)
        if (end.kind == results::EndKind::pair)
            end.mode = name_at(end, *names);
}

} // namespace whirl::analyses

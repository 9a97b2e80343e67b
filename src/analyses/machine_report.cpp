#include "analyses/machine_report.h"

#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/checks/checks.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "analyses/show.h"
#include "analyses/stability.h"
#include "analyses/standard/standard_runs.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "model/variants.h"
#include "process/progress.h"

#include <algorithm>
#include <array>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;

/// Its shares of the whole work, from times of the compressor of docs/tutorial_compressor.md.
struct Shares {
    static constexpr std::array<double, 8> ends{0, 0.02, 0.25, 0.4, 0.65, 0.85, 0.95, 1};
};

/// Runs one analysis for its part. @param number  of the part, from 0
template <class Result, class Analysis>
void run(results::Part<Result> &part, const char *doing, std::size_t number,
         const Analysis &analysis) {
    const process::Stage stage(doing, Shares::ends.at(number), Shares::ends.at(number + 1));
    try {
        part.result = analysis();
    } catch (const model::AnalysisFailure &failure) {
        part.failed = true;
        part.why = failure.sentence();
    } catch (const linalg::SolverError &failure) {
        part.failed = true;
        part.why = failure.sentence();
    }
}

bool has_range(const model::Case &scene) { return scene.speeds && scene.speeds->count > 1; }

/// What drives a steady motion.
bool driven(const model::Case &scene) {
    return !model::with_balancer_imbalances(scene.rotor).imbalances.empty() ||
           !scene.rotor.forces.empty() || scene.response.gravity != 0 ||
           !scene.response.receptances.empty() || (scene.standard && scene.standard->api617);
}

/// Whether a motion could grow: without damping, balls and unequal stiffnesses or inertias that
/// turn none does but by coefficients of the bearings, which count as damping.
bool may_grow(const model::Case &scene) {
    return scene.rotor.damped() || scene.rotor.rotating_anisotropy() || scene.level1 ||
           !scene.rotor.bearings_orthotropic();
}

/// The speed whose modes are shown: asked for, else the highest at which the machine runs, else the
/// highest of the case.
std::optional<double> speed_of_modes(const model::Case &scene) {
    if (scene.modes.speed)
        return scene.modes.speed;
    if (scene.operation)
        return scene.operation->to;
    if (scene.speeds)
        return scene.speeds->count > 1 ? scene.speeds->to : scene.speeds->from;
    return std::nullopt;
}

const char *const no_speeds = "the case has no [speeds]";
const char *const no_planes = "the case has neither [[balancer]] nor [[plane]]";

/// Peaks that `critical` would find once more for its margins. Of rotors whose motion is periodic
/// in time it does not look for them.
const std::vector<results::ResponsePeak> *
peaks_of(const model::Case &scene, const results::Part<results::ResponseResult> &response) {
    const bool there = response.result && has_range(scene) && !response.result->nodes.empty() &&
                       response.result->model.formulation.form != results::Form::hill;
    return there ? &response.result->peaks : nullptr;
}

void add_response(const model::Case &scene, results::MachineReport &report) {
    report.response.why = not_called_for(scene).response;
    if (report.response.why.empty())
        run(report.response, "response", 1, [&] { return response_with_runs(scene); });
}

void add_stability(const model::Case &scene, const CaseWith &with, results::MachineReport &report) {
    report.stability.why = not_called_for(scene).stability;
    if (report.stability.why.empty())
        run(report.stability, "stability", 4, [&] { return stability(scene, with); });
}

void add_modes(const model::Case &scene, results::MachineReport &report) {
    const std::optional<double> speed = speed_of_modes(scene);
    if (!speed) {
        report.modes.why = no_speeds;
        return;
    }
    model::Case at_speed = scene; // at that speed alone: the critical speeds are there already
    at_speed.modes.speed = speed;
    at_speed.speeds = model::SpeedRange{*speed, *speed, 1};
    run(report.modes, "modes", 5, [&] { return mode_shapes(at_speed); });
}

void add_balance(const model::Case &scene, results::MachineReport &report) {
    report.balance.why = not_called_for(scene).balance;
    if (report.balance.why.empty())
        run(report.balance, "balance", 6, [&] {
            model::Case rest = scene;
            if (report.stability.result) // which has the steady states
                rest.states.reset();
            return balance(rest);
        });
}

/// Stability over all operating speeds, where the case looks at fewer.
results::Part<results::StabilityResult> stability_in_operation(const model::Case &scene,
                                                               const CaseWith &with) {
    results::Part<results::StabilityResult> part;
    model::Case wide = over_operation(scene);
    wide.states.reset(); // answered at the speeds of the case
    const auto [least, largest] = std::minmax(scene.speeds->from, scene.speeds->to);
    if (wide.speeds->from >= least && wide.speeds->to <= largest && has_range(scene))
        return part;
    run(part, "stability at the operating speeds", 6, [&] { return stability(wide, with); });
    return part;
}

template <class Result> const Result *pointer_to(const results::Part<Result> &part) {
    return part.result ? &*part.result : nullptr;
}

} // namespace

NotCalledFor not_called_for(const model::Case &scene) {
    if (!scene.speeds)
        return {no_speeds, no_speeds, no_speeds,
                scene.rotor.planes.empty() && scene.rotor.balancer_planes().empty() ? no_planes
                                                                                    : no_speeds};
    NotCalledFor why;
    if (!has_range(scene))
        why.campbell = "the case has one speed";
    if (!driven(scene))
        why.response = "nothing drives the rotor: the case has neither [[imbalance]] nor [[force]]";
    if (!may_grow(scene))
        why.stability = "nothing in the rotor can make a motion grow: no damping, no cross "
                        "coupling, no balancers, nothing unequal that turns";
    if (scene.rotor.planes.empty() && scene.rotor.balancer_planes().empty())
        why.balance = no_planes;
    else if (std::min(scene.speeds->from, scene.speeds->to) < 0)
        why.balance = "the criterion is for speeds of one sense, from 0 up";
    return why;
}

results::MachineReport machine_report(const model::Case &scene, const CaseWith &with) {
    results::MachineReport report;
    run(report.show, "what the rotor is", 0, [&] { return show(scene); });
    if (report.show.result)
        report.model = report.show.result->model;
    add_response(scene, report);
    run(report.critical, "critical speeds", 2, [&] {
        return critical_speeds(scene, scene.critical_map.has_value(),
                               peaks_of(scene, report.response));
    });
    report.campbell.why = not_called_for(scene).campbell;
    if (report.campbell.why.empty())
        run(report.campbell, "Campbell diagram", 3, [&] { return campbell(scene); });
    add_stability(scene, with, report);
    add_modes(scene, report);
    add_balance(scene, report);
    results::Part<results::StabilityResult> operating;
    if (scene.operation && report.stability.result)
        operating = stability_in_operation(scene, with);
    const auto &stability = operating.result || operating.failed ? operating : report.stability;
    report.assessment = assess(scene, {pointer_to(report.response), pointer_to(report.critical),
                                       pointer_to(stability), report.response.why,
                                       report.critical.why, stability.why});
    return report;
}

} // namespace whirl::analyses

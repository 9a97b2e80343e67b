#include "properties/scaling.h"

#include "analyses/accuracy.h"
#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "analyses/response.h"
#include "analyses/rigid_limit.h"
#include "analyses/show.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "input/case_file.h"
#include "report/reports.h"
#include "results/accuracy.h"
#include "results/balance.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/rigid_limit.h"
#include "results/show.h"
#include "results/simulate.h"
#include "results/stability.h"

namespace whirl::properties {

namespace {

template <class Result> CommandOutput output_of(const model::Case &scene, const Result &result) {
    const report::Report report = report::describe(scene, result);
    return {report.text({}), report::to_json(report), {}};
}

CommandOutput run(const std::string &command, const model::Case &scene,
                  const analyses::CaseWith &with) {
    if (command == "show")
        return output_of(scene, analyses::show(scene));
    if (command == "campbell")
        return output_of(scene, analyses::campbell(scene));
    if (command == "critical")
        return output_of(scene, analyses::critical_speeds(scene));
    if (command == "response")
        return output_of(scene, analyses::unbalance_response(scene));
    if (command == "modes")
        return output_of(scene, analyses::mode_shapes(scene));
    if (command == "stability")
        return output_of(scene, analyses::stability(scene, with));
    if (command == "rigid-limit")
        return output_of(scene, analyses::rigid_limit(scene));
    if (command == "balance")
        return output_of(scene, analyses::balance(scene));
    return output_of(scene, analyses::simulate(scene));
}

model::Case scene_in_units(const std::filesystem::path &file,
                           const std::vector<std::string> &overrides, const Units &units) {
    model::Case scene = in_units(input::load_case(file, overrides), units);
    if (scene.limits) { // standards have numbers and speeds of their own
        scene.limits->shaft_standard.reset();
        scene.limits->pedestals.reset();
    }
    scene.simulate.time /= 20;
    for (auto &[time, speed] : scene.simulate.run_up)
        time /= 20;
    for (model::SuddenImbalance &imbalance : scene.simulate.imbalances)
        imbalance.time /= 20;
    for (model::StationForce &force : scene.simulate.forces) {
        force.from /= 20;
        if (force.to)
            *force.to /= 20;
    }
    if (auto &base = scene.simulate.base)
        for (model::BaseMotion::Row &row : base->table)
            row.time /= 20;
    scene.simulate.output_points = 400;
    scene.simulate.other_starts.clear();
    scene.balance.simulated = 0;
    return scene;
}

} // namespace

const std::vector<std::string> &commands() {
    static const std::vector<std::string> all{"show",        "campbell", "critical",
                                              "response",    "modes",    "stability",
                                              "rigid-limit", "balance",  "simulate"};
    return all;
}

CommandOutput run_in_units(const std::string &command, const std::filesystem::path &file,
                           const Units &units) {
    const auto with = [&](const std::vector<std::string> &overrides) {
        return scene_in_units(file, overrides, units);
    };
    try {
        return run(command, with({}), with);
    } catch (const std::exception &failure) {
        CommandOutput out;
        out.refusal = failure.what();
        return out;
    }
}

} // namespace whirl::properties

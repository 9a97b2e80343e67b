#include "cli/commands.h"

#include "analyses/accuracy.h"
#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/modes.h"
#include "analyses/response.h"
#include "analyses/rigid_limit.h"
#include "analyses/samples/samples.h"
#include "analyses/show.h"
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
#include "results/samples.h"
#include "results/show.h"
#include "results/stability.h"

namespace whirl::cli {

namespace {

/// A command whose analysis needs the case alone.
template <class Result> auto on_case(Result (*analysis)(const model::Case &)) {
    return [analysis](const Run &run) {
        const Result result = run.timed([&] { return analysis(run.scene); });
        run.deliver(report::describe(run.scene, result));
    };
}

void balance(const Run &run) {
    const results::BalanceResult result =
        run.timed([&] { return analyses::balance(run.scene, {run.arguments.map}); });
    run.deliver(report::describe(run.scene, result));
}

void critical(const Run &run) {
    const bool map = run.arguments.map || run.scene.critical_map;
    const results::CriticalResult result =
        run.timed([&] { return analyses::critical_speeds(run.scene, map); });
    run.deliver(report::describe(run.scene, result));
}

/// A command whose analysis reads the case again with other values.
template <class Result>
auto on_cases(Result (*analysis)(const model::Case &, const analyses::CaseWith &)) {
    return [analysis](const Run &run) {
        const analyses::CaseWith with = [&run](const std::vector<std::string> &more) {
            std::vector<std::string> overrides = run.arguments.overrides;
            overrides.insert(overrides.end(), more.begin(), more.end());
            return input::load_case(run.arguments.scene, overrides);
        };
        const Result result = run.timed([&] { return analysis(run.scene, with); });
        run.deliver(report::describe(run.scene, result));
    };
}

// Rows of the table that would make it too long to be read at once.

Command balance_row() {
    return {"balance",
            "where correction planes can balance the rotor",
            {"speeds", "plane", "balance", "simulate"},
            {"--map"},
            balance};
}

Command stability_row() {
    return {"stability",
            "where motion is unstable",
            {"speeds", "map", "operation", "level1"},
            {},
            on_cases(analyses::stability)};
}

Command samples_row() {
    return {"samples",
            "quantiles of critical speeds, peaks or band ends over uncertain entries of the case",
            {"samples", "speeds", "campbell", "imbalance"},
            {},
            on_cases(analyses::samples)};
}

} // namespace

std::filesystem::path Run::folder() const {
    return arguments.out.value_or(std::filesystem::path("out") / scene.name / arguments.command);
}

const std::vector<Command> &commands() {
    static const std::vector<Command> table{
        {"show",
         "what the scene is: drawing, masses, inertias, formulations",
         {},
         {},
         on_case(analyses::show)},
        {"campbell",
         "whirl speeds and damping over the spin speed",
         {"speeds", "campbell"},
         {},
         on_case(analyses::campbell)},
        {"critical",
         "critical speeds directly, without a sweep",
         {"speeds", "campbell", "operation", "imbalance", "critical_map"},
         {"--map", "--map-bearing"},
         critical},
        stability_row(),
        {"response",
         "unbalance response over speed, forces at bearings",
         {"speeds", "imbalance", "probe", "operation"},
         {},
         on_case(analyses::unbalance_response)},
        balance_row(),
        {"rigid-limit",
         "flexible model against rigid closed forms as the shaft stiffens",
         {"speeds", "plane"},
         {},
         on_case(analyses::rigid_limit)},
        {"simulate",
         "motion in time: run-up, sudden imbalance, forces; nonlinear with real balls",
         {"simulate", "speeds"},
         {},
         simulate_or_leave_restart},
        {"accuracy",
         "wall time and error over element family, order and mesh",
         {"speeds", "campbell"},
         {},
         on_case(analyses::accuracy)},
        samples_row(),
        {"modes",
         "mode shapes as pictures and for ParaView",
         {"speeds", "campbell"},
         {"--speed"},
         on_case(analyses::mode_shapes)},
    };
    return table;
}

} // namespace whirl::cli

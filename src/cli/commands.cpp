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

Command campbell_row() {
    return {"campbell",
            "whirl speeds and damping over the spin speed",
            {"speeds", "campbell"},
            {},
            {"cases/nelson_mcvaugh",
             "cases/nelson_mcvaugh --set campbell.modes=4 --set \"campbell.multiples=[1, 2]\""},
            on_case(analyses::campbell)};
}

Command critical_row() {
    return {"critical",
            "critical speeds directly, without a sweep",
            {"speeds", "campbell", "operation", "imbalance", "critical_map"},
            {"--map", "--map-bearing"},
            {"cases/compressor_margins --units mm-rpm", "cases/compressor_margins --map"},
            critical};
}

Command stability_row() {
    return {"stability",
            "where motion is unstable",
            {"speeds", "map", "operation", "level1"},
            {},
            {"cases/overhung_cross_coupled", "cases/compressor_margins"},
            on_cases(analyses::stability)};
}

Command response_row() {
    return {"response",
            "unbalance response over speed, forces at bearings",
            {"speeds", "imbalance", "probe", "operation"},
            {},
            {"cases/compressor_margins --units mm-rpm --peak-to-peak",
             "cases/compressor_margins --set \"imbalance[0].mr=50 g mm\""},
            on_case(analyses::unbalance_response)};
}

Command balance_row() {
    return {"balance",
            "where correction planes can balance the rotor",
            {"speeds", "plane", "balance", "simulate"},
            {"--map"},
            {"cases/extractor_two_plane", "cases/disc_type_short --map"},
            balance};
}

Command rigid_limit_row() {
    return {
        "rigid-limit",         "flexible model against rigid closed forms as the shaft stiffens",
        {"speeds", "plane"},   {},
        {"cases/rigid_limit"}, on_case(analyses::rigid_limit)};
}

Command simulate_row() {
    return {"simulate",
            "motion in time: run-up, sudden imbalance, forces; nonlinear with real balls",
            {"simulate", "speeds"},
            {},
            {"cases/runup_jeffcott", "cases/blade_loss --units mm-rpm"},
            simulate_or_leave_restart};
}

Command samples_row() {
    return {"samples",
            "quantiles of critical speeds, peaks or band ends over uncertain entries of the case",
            {"samples", "speeds", "campbell", "imbalance"},
            {},
            {"cases/uncertain_jeffcott --set samples.count=1000"},
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
         {"cases/compressor_margins"},
         on_case(analyses::show)},
        campbell_row(),
        critical_row(),
        stability_row(),
        response_row(),
        balance_row(),
        rigid_limit_row(),
        simulate_row(),
        {"accuracy",
         "wall time and error over element family, order and mesh",
         {"speeds", "campbell"},
         {},
         {"cases/nelson_mcvaugh"},
         on_case(analyses::accuracy)},
        samples_row(),
        {"modes",
         "mode shapes as pictures and for ParaView",
         {"speeds", "campbell"},
         {"--speed"},
         {"cases/nelson_mcvaugh --speed \"12000 rpm\""},
         on_case(analyses::mode_shapes)},
    };
    return table;
}

} // namespace whirl::cli

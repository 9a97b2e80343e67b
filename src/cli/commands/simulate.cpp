#include "cli/commands.h"

#include "analyses/simulate.h"
#include "cli/messages.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "process/signals.h"
#include "report/reports.h"
#include "report/restart_file.h"
#include "results/simulate.h"

#include <fmt/format.h>

#include <csignal>
#include <optional>
#include <string>

namespace whirl::cli {

namespace {

/// Ends the program as the SIGINT that the analysis has stopped for would have ended it.
[[noreturn]] void end_interrupted(const std::string &message) {
    complain("whirl: " + message);
    process::end_by(SIGINT);
}

/// From the restart file that the case names if any. On SIGINT writes a restart file into the
/// folder for results, says how to go on, and ends as any program that is interrupted.
void simulate_or_leave_restart(const Run &run) {
    std::optional<model::Restart> from;
    if (!run.scene.simulate.restart.empty())
        from = report::read_restart(run.scene.simulate.restart);
    results::SimulateResult result;
    bool interrupted = false;
    try {
        const process::InterruptionBySignal interruption(interrupted);
        result = run.timed([&] { return analyses::simulate(run.scene, from ? &*from : nullptr); });
    } catch (const model::AnalysisFailure &failure) {
        if (interrupted)
            end_interrupted(failure.what() + std::string("; no results were written"));
        throw;
    }
    if (process::take_interruption()) // came too late for the motion to stop
        raise(SIGINT);
    if (result.restart) {
        const auto file = run.folder() / "restart.json";
        report::write_restart(file, *result.restart);
        end_interrupted(
            model::Sentence("interrupted at {} of {}; to go on add --set simulate.restart={}",
                            model::as::time(result.restart->time),
                            model::as::time(run.scene.simulate.time), file.string())
                .text());
    }
    run.deliver(report::describe(run.scene, result));
    if (interrupted)
        end_interrupted("interrupted; a note in the results says which motions are missing");
}

} // namespace

Command simulate_command() {
    return {"simulate",
            "motion in time: run-up, sudden imbalance, forces; nonlinear with real balls",
            {"simulate", "speeds", "imbalance"},
            {},
            {"cases/runup_jeffcott", "cases/blade_loss --units mm-rpm"},
            simulate_or_leave_restart};
}

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/simulate.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "report/reports.h"
#include "report/restart_file.h"
#include "results/simulate.h"

#include <fmt/format.h>

#include <csignal>
#include <optional>

namespace whirl::cli {

namespace {

/// While it lives SIGINT asks the analysis to stop; a second one ends the program as usual.
class InterruptionBySignal {
  public:
    InterruptionBySignal() {
        struct sigaction action {};
        action.sa_handler = [](int) { process::request_interruption(); };
        action.sa_flags = SA_RESETHAND;
        sigaction(SIGINT, &action, &_before);
    }
    ~InterruptionBySignal() { sigaction(SIGINT, &_before, nullptr); }
    InterruptionBySignal(const InterruptionBySignal &) = delete;
    InterruptionBySignal &operator=(const InterruptionBySignal &) = delete;
    InterruptionBySignal(InterruptionBySignal &&) = delete;
    InterruptionBySignal &operator=(InterruptionBySignal &&) = delete;

  private:
    struct sigaction _before {};
};

/// From the restart file that the case names if any. On SIGINT writes a restart file into the
/// folder for results. @throws model::AnalysisFailure then, with what to do to go on.
void simulate_or_leave_restart(const Run &run) {
    std::optional<model::Restart> from;
    if (!run.scene.simulate.restart.empty())
        from = report::read_restart(run.scene.simulate.restart);
    const InterruptionBySignal interruption;
    const results::SimulateResult result =
        run.timed([&] { return analyses::simulate(run.scene, from ? &*from : nullptr); });
    if (!result.restart) {
        run.deliver(report::describe(run.scene, result));
        return;
    }
    const auto file = run.folder() / "restart.json";
    report::write_restart(file, *result.restart);
    throw model::AnalysisFailure(
        model::Sentence("interrupted at {} of {}; to go on add --set simulate.restart={}",
                        model::as::time(result.restart->time),
                        model::as::time(run.scene.simulate.time), file.string()));
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

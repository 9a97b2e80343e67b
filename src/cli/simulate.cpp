#include "cli/simulate.h"

#include "analyses/simulate.h"
#include "model/errors.h"
#include "process/interruption.h"
#include "report/restart_file.h"

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

} // namespace

results::SimulateResult simulate_or_leave_restart(const Arguments &arguments,
                                                  const model::Case &scene) {
    std::optional<model::Restart> from;
    if (!scene.simulate.restart.empty())
        from = report::read_restart(scene.simulate.restart);
    const InterruptionBySignal interruption;
    results::SimulateResult result = analyses::simulate(scene, from ? &*from : nullptr);
    if (!result.restart)
        return result;
    const auto usual = std::filesystem::path("out") / scene.name / arguments.command;
    const auto file = std::filesystem::path(arguments.out.value_or(usual)) / "restart.json";
    report::write_restart(file, *result.restart);
    throw model::AnalysisFailure(
        fmt::format("interrupted at {:.6g} s of {:.6g} s; to go on add --set "
                    "simulate.restart={}",
                    result.restart->time, scene.simulate.time, file.string()));
}

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/critical.h"
#include "cli/commands/on_case.h"
#include "report/reports.h"
#include "results/critical.h"

namespace whirl::cli {

namespace {

void critical(const Run &run) {
    const bool map = run.arguments.map || run.scene.critical_map;
    const results::CriticalResult result =
        run.timed([&] { return analyses::critical_speeds(run.scene, map); });
    run.deliver(report::describe(run.scene, result));
}

} // namespace

Command critical_command() {
    return {"critical",
            "critical speeds directly, without a sweep",
            {"speeds", "campbell", "operation", "imbalance", "critical_map"},
            {"--map", "--map-bearing"},
            {"cases/compressor_margins --units mm-rpm", "cases/compressor_margins --map"},
            critical};
}

} // namespace whirl::cli

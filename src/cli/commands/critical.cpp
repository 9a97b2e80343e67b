#include "cli/commands.h"

#include "analyses/critical.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command critical_command() {
    return {"critical",
            "critical speeds directly, without a sweep",
            {"speeds", "campbell", "operation", "imbalance", "critical_map"},
            {"--map", "--map-bearing"},
            {"cases/compressor_margins --units mm-rpm", "cases/compressor_margins --map"},
            on_run([](const Run &run) {
                return analyses::critical_speeds(run.scene,
                                                 run.arguments.map || run.scene.critical_map);
            })};
}

} // namespace whirl::cli

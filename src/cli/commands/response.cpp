#include "cli/commands.h"

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/show.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command critical_command() {
    return {"critical",
            "critical speeds directly, without a sweep",
            {"speeds", "campbell", "operation", "imbalance", "critical_map"},
            {"--map", "--map-bearing"},
            {"cases/compressor_margins --units mm-rpm", "cases/compressor_margins --map"},
            on_run([](const Run &run) {
                const bool map = run.arguments.map || run.scene.critical_map;
                return analyses::critical_speeds(run.scene, map);
            })};
}

Command response_command() {
    return {"response",
            "unbalance response over speed, forces at bearings",
            {"speeds", "imbalance", "probe", "response", "operation"},
            {},
            {"cases/compressor_margins --units mm-rpm --peak-to-peak",
             "cases/compressor_margins --set \"imbalance[0].mr=50 g mm\""},
            on_case(analyses::unbalance_response)};
}

Command show_command() {
    return {"show",
            "what the scene is: drawing, masses, inertias, formulations",
            {},
            {},
            {"cases/compressor_margins"},
            on_case(analyses::show)};
}

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/balance.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command balance_command() {
    return {"balance",
            "where correction planes can balance the rotor",
            {"speeds", "plane", "imbalance", "probe", "balance", "simulate", "states", "weights",
             "operation"},
            {"--map"},
            {"cases/extractor_two_plane", "cases/disc_type_short --map"},
            on_run([](const Run &run) { return analyses::balance(run.scene, run.arguments.map); })};
}

} // namespace whirl::cli

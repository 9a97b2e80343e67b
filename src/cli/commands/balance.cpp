#include "cli/commands.h"

#include "analyses/balance.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command balance_command() {
    return {"balance",
            "where correction planes can balance the rotor",
            {"speeds", "plane", "balance", "simulate"},
            {"--map"},
            {"cases/extractor_two_plane", "cases/disc_type_short --map"},
            on_run([](const Run &run) { return analyses::balance(run.scene, run.arguments.map); })};
}

} // namespace whirl::cli

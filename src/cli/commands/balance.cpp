#include "cli/commands.h"

#include "analyses/balance.h"
#include "cli/commands/on_case.h"
#include "report/reports.h"
#include "results/balance.h"

namespace whirl::cli {

namespace {

void balance(const Run &run) {
    const results::BalanceResult result =
        run.timed([&] { return analyses::balance(run.scene, run.arguments.map); });
    run.deliver(report::describe(run.scene, result));
}

} // namespace

Command balance_command() {
    return {"balance",
            "where correction planes can balance the rotor",
            {"speeds", "plane", "balance", "simulate"},
            {"--map"},
            {"cases/extractor_two_plane", "cases/disc_type_short --map"},
            balance};
}

} // namespace whirl::cli

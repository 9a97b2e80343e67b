#include "cli/commands.h"

#include "analyses/sweep.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command sweep_command() {
    return {"sweep",
            "critical speeds, peaks, margins, damping or band ends over one or two entries of the "
            "case",
            {"sweep", "speeds", "campbell", "imbalance", "operation"},
            {},
            {"cases/overhung_cross_coupled --set \"sweep.x={path='bearing[*].k', "
             "change='factor', from=0.5, to=2, count=16}\""},
            on_cases(analyses::sweep)};
}

} // namespace whirl::cli

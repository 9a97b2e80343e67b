#include "cli/commands.h"

#include "analyses/samples/samples.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command samples_command() {
    return {"samples",
            "quantiles of critical speeds, peaks or band ends over uncertain entries of the case",
            {"samples", "speeds", "campbell", "imbalance"},
            {},
            {"cases/uncertain_jeffcott --set samples.count=1000"},
            on_cases(analyses::samples)};
}

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/standard/standard_runs.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command response_command() {
    return {
        "response",
        "unbalance response over speed, forces at bearings; forces of any frequency, receptances",
        {"speeds", "imbalance", "force", "probe", "response", "operation", "limits", "standard"},
        {},
        {"cases/compressor_margins --units mm-rpm --peak-to-peak",
         "cases/compressor_margins --set \"imbalance[0].mr=50 g mm\"", "cases/harmonic_forces"},
        on_case(analyses::response_with_runs)};
}

} // namespace whirl::cli

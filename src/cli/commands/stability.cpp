#include "cli/commands.h"

#include "analyses/stability.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command stability_command() {
    return {"stability",
            "where motion is unstable",
            {"speeds", "map", "operation", "level1", "states"},
            {},
            {"cases/overhung_cross_coupled", "cases/compressor_margins"},
            on_cases(analyses::stability)};
}

} // namespace whirl::cli

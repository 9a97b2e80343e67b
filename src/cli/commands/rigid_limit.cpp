#include "cli/commands.h"

#include "analyses/rigid_limit.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command rigid_limit_command() {
    return {
        "rigid-limit",         "flexible model against rigid closed forms as the shaft stiffens",
        {"speeds", "plane"},   {},
        {"cases/rigid_limit"}, on_case(analyses::rigid_limit)};
}

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/show.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command show_command() {
    return {"show",
            "what the scene is: drawing, masses, inertias, formulations",
            {},
            {},
            {"cases/compressor_margins"},
            on_case(analyses::show)};
}

} // namespace whirl::cli

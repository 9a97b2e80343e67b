#include "cli/commands.h"

#include "analyses/modes.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command modes_command() {
    return {"modes",
            "mode shapes as pictures and for ParaView",
            {"speeds", "campbell", "modes"},
            {"--speed"},
            {"cases/nelson_mcvaugh --speed \"12000 rpm\""},
            on_case(analyses::mode_shapes)};
}

} // namespace whirl::cli

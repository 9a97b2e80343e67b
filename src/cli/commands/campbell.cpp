#include "cli/commands.h"

#include "analyses/campbell.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command campbell_command() {
    return {"campbell",
            "whirl speeds and damping over the spin speed",
            {"speeds", "campbell"},
            {},
            {"cases/nelson_mcvaugh",
             "cases/nelson_mcvaugh --set campbell.modes=4 --set \"campbell.multiples=[1, 2]\""},
            on_case(analyses::campbell)};
}

} // namespace whirl::cli

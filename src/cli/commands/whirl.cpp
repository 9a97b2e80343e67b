#include "cli/commands.h"

#include "analyses/accuracy.h"
#include "analyses/campbell.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command accuracy_command() {
    return {"accuracy",
            "wall time and error over element family, order and mesh",
            {"speeds", "campbell"},
            {},
            {"cases/nelson_mcvaugh"},
            on_case(analyses::accuracy)};
}

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

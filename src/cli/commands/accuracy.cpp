#include "cli/commands.h"

#include "analyses/accuracy.h"
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

} // namespace whirl::cli

#include "cli/commands.h"

#include "analyses/weights.h"
#include "cli/commands/on_case.h"

namespace whirl::cli {

Command weights_command() {
    return {"weights",
            "correction weights in several planes, from readings or from the model",
            {"weights", "plane", "trial", "probe", "imbalance", "speeds"},
            {},
            {"cases/weights_fan", "cases/weights_fan --set weights.method=minimax"},
            on_case(analyses::correction_weights)};
}

} // namespace whirl::cli

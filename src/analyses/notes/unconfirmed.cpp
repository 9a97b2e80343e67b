#include "analyses/notes/unconfirmed.h"

#include <fmt/format.h>

namespace whirl::analyses {

void note_unconfirmed(results::ModelSummary &model, double speed) {
    if (speed == 0)
        return;
    model.notes.push_back(fmt::format(
        "up to {:.6g} rad/s, but not at rest, frequencies change by far more than the spin speed "
        "within a turn: some whirl speeds there are those of the rotor on few shapes, not "
        "confirmed by the one with all unknowns",
        speed));
}

} // namespace whirl::analyses

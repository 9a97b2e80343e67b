#pragma once

#include <string>

namespace whirl::results {

/// Sense of the orbits of a whirl mode against the spin.
enum class Whirl {
    forward,
    backward,
    mixed ///< some stations whirl forward and some backward, or all move on straight lines
};

/// "forward", "backward" or "mixed".
[[nodiscard]] std::string whirl_name(Whirl whirl);

} // namespace whirl::results

#pragma once

#include "model/case.h"

#include <string>

namespace whirl::properties {

/// A case file with this rotor and these speeds: cylinders and cones, discs, bearings without
/// tables, anisotropies, balancers. For reproducing a finding with the program.
[[nodiscard]] std::string case_text(const model::Case &scene);

} // namespace whirl::properties

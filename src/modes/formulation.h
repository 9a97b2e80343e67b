#pragma once

#include "model/case.h"
#include "results/formulation.h"

namespace whirl::modes {

/// The smallest exact form, or the one the case forces.
/// @throws model::BadInput where the forced form cannot describe the scene.
[[nodiscard]] results::Formulation choose_formulation(const model::Case &scene);

} // namespace whirl::modes

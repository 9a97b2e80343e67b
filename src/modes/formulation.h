#pragma once

#include "model/case.h"
#include "results/formulation.h"

namespace whirl::modes {

/// The smallest exact form, or the one the case forces.
/// @param damped_planar  the analysis knows form planar_damped; else the real form takes its place
/// @throws model::BadInput where the forced form cannot describe the scene.
[[nodiscard]] results::Formulation choose_formulation(const model::Case &scene,
                                                      bool damped_planar = true);

} // namespace whirl::modes

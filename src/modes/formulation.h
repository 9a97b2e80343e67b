#pragma once

#include "model/case.h"
#include "results/formulation.h"

namespace whirl::modes {

/// The smallest exact form, or the one the case forces.
/// @throws model::BadInput where the forced form cannot describe the scene.
[[nodiscard]] results::Formulation choose_formulation(const model::Case &scene);

/// A form that was chosen, for analyses that do not know planar_damped: the real one in its place.
[[nodiscard]] results::Formulation without_planar_damped(const results::Formulation &chosen,
                                                         const model::Rotor &rotor);

} // namespace whirl::modes

#pragma once

#include "model/case.h"
#include "report/drawing.h"
#include "results/show.h"

namespace whirl::report {

/// Side view of the rotor to scale: shaft with bores and cones, discs, bearings, balancers,
/// correction planes and anisotropies. Diameters of very slender rotors are enlarged, and the
/// drawing says so.
[[nodiscard]] Drawing scene_drawing(const model::Case &scene);

/// The same with a line of mass, centre of mass and inertias, and the centre of mass marked.
[[nodiscard]] Drawing show_drawing(const model::Case &scene, const results::ShowResult &result);

} // namespace whirl::report

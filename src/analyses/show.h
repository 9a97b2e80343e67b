#pragma once

#include "model/case.h"
#include "results/show.h"

namespace whirl::analyses {

/// Mass, place of the centre of mass and inertias of the rotor about it, its rigid type (long:
/// Id > Ip, short: Id < Ip, spherical: equal to 1e-9), and the form of the equations that each
/// command will use; what each balancer adds at its balanced position, and the chart of a rotor
/// with anisotropy. Balls and point-mass imbalances count, pedestals do not.
[[nodiscard]] results::ShowResult show(const model::Case &scene);

} // namespace whirl::analyses

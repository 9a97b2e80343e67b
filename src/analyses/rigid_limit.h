#pragma once

#include "model/case.h"
#include "results/rigid_limit.h"

namespace whirl::analyses {

/// Flexible model against the closed forms of the rigid rotor (docs/theory.md, "Rigid limit"):
/// forward critical speeds, additional speeds, ends of the unstable range and permissible
/// anisotropy as far as they apply, while E and G of the shaft grow with the bearings as they are;
/// the same and the composite inertia while the mesh coarsens to the fewest elements the
/// attachments allow; and the stiffness above which every compared speed is within 1 %.
/// @throws model::AnalysisFailure where the rigid rotor has no closed form or the model does not
/// approach it; model::BadInput where a balancer has no balanced position.
[[nodiscard]] results::RigidLimitResult rigid_limit(const model::Case &scene);

} // namespace whirl::analyses

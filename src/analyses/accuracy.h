#pragma once

#include "model/case.h"
#include "results/accuracy.h"

namespace whirl::analyses {

/// Speed against error for this scene: a ladder of classical meshes and of element orders, each
/// with the wall time to assemble, factorise and solve (best of three where it is short), the
/// estimated error (against elements four orders higher, mesh_error::finer_order) and the true one:
/// the largest relative difference of the campbell.modes eigenvalues of lowest frequency from a
/// reference with far more unknowns, which is itself compared with one of lower order to know how
/// many of its digits hold. At speeds.to (speeds.from where count = 1). With a shaft of hardly any
/// mass, in rotating axes, few coarse meshes: finer ones take long, and rounding hides the slow
/// motions among the fast.
/// @throws model::BadInput without [speeds] or with a rigid shaft.
[[nodiscard]] results::AccuracyResult accuracy(const model::Case &scene);

} // namespace whirl::analyses

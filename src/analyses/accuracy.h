#pragma once

#include "model/case.h"
#include "results/accuracy.h"

namespace whirl::analyses {

/// Speed against error for this scene: a ladder of classical meshes and of element orders, each
/// with the wall time to assemble, factorise and solve (best of three), the estimated error (order
/// p against p + 1, length h against h/2) and the true one: the largest relative difference of the
/// campbell.modes eigenvalues of lowest frequency from a reference with far more unknowns, which
/// is itself compared with one of lower order to know how many of its digits hold. At speeds.to
/// (speeds.from where count = 1).
/// @throws model::BadInput without [speeds] or with a rigid shaft.
[[nodiscard]] results::AccuracyResult accuracy(const model::Case &scene);

} // namespace whirl::analyses

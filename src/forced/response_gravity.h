#pragma once

#include "assembly/discretization.h"
#include "model/case.h"
#include "results/response.h"

namespace whirl::forced {

/// Adds the steady motion under the weight of shaft and discs over result.speeds: in rotating axes
/// where the shaft has two stiffnesses, else in the fixed frame, where it stands still. With
/// notes on resonances without damping. Collective over MPI processes: complete on process 0,
/// nothing is added elsewhere.
/// @throws model::BadInput where the bearings leave a rigid motion free: nothing holds the weight
void add_gravity_response(results::ResponseResult &result, const assembly::Discretization &d,
                          const model::Case &scene);

} // namespace whirl::forced

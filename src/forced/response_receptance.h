#pragma once

#include "assembly/discretization.h"
#include "model/case.h"
#include "results/response.h"

namespace whirl::forced {

/// The deflections at stations over forces at others, at the first speed of the case and over the
/// frequencies that it asks for, and their peaks.
/// @throws model::BadInput  from required_speeds
void add_receptances(results::ResponseResult &result, const assembly::Discretization &d,
                     const model::Case &scene);

} // namespace whirl::forced

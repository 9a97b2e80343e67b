#pragma once

#include "model/case.h"
#include "results/response.h"

namespace whirl::analyses {

/// Whether the response of a case is that of an asymmetric rotor on bearings that differ between
/// their directions, which moves at many multiples of the spin speed.
[[nodiscard]] bool response_is_periodic(const model::Case &scene);

/// The response of such a rotor to its imbalances and its weight (forced::PeriodicMotion). The
/// amplitudes are the largest distances over a turn, the ellipses of the stations those of the
/// motion at the spin speed, with the semi-axes at its other multiples beside them. Peaks are
/// maxima of these amplitudes, looked for between all speeds at which a free motion crosses the
/// spin speed. No orbits and deflected shapes.
/// @param scene  with the imbalances of its balancers
[[nodiscard]] results::ResponseResult periodic_response(const model::Case &scene);

} // namespace whirl::analyses

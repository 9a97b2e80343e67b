#pragma once

#include "model/case.h"
#include "results/modes.h"

#include <string>

namespace whirl::report {

/// Mode shapes as VTK PolyData (.vtp, ASCII) for ParaView: the shaft's centre line and its surface,
/// in axes (x, y, z) with z along the shaft, and for each mode the point vectors "<label> real" and
/// "<label> imag". With "Warp By Vector" the real part is the shape at time zero, minus the
/// imaginary part the shape a quarter period later.
[[nodiscard]] std::string to_vtp(const model::Case &scene, const results::ModesResult &result);

} // namespace whirl::report

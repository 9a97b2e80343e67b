#pragma once

#include "model/rotor.h"
#include "oracles/continuum.h"
#include "properties/draw.h"

namespace whirl::properties {

enum class Kind { isotropic, orthotropic, damped };

/// Stepped shaft of 1-5 cylinders, hollow ones among them, 0-4 discs, 2 or 3 bearings from soft to
/// 1e9 N/m; damped: bearings of any anisotropy and some internal damping. Elements are left at one
/// a segment.
[[nodiscard]] model::Rotor random_rotor(Draw &draw, Kind kind);

/// The same rotor for the continuum solution: cylinders, discs and bearings with constant
/// coefficients.
[[nodiscard]] oracles::SteppedRotor continuum_of(const model::Rotor &rotor);

} // namespace whirl::properties

#pragma once

#include "assembly/discretization.h"
#include "results/show.h"

#include <optional>

namespace whirl::forced {

inline constexpr double standard_gravity = 9.80665; ///< m/s2 (CGPM 1901)

/// The rotor at rest under the weight of its shaft and discs, K q = f with the bearings'
/// coefficients at speed zero (of tables the first row): deflections and rotations of the sections
/// at the ends of the shaft and wherever something is attached, and the loads on the bearings. Of a
/// shaft of two stiffnesses the mean over a slow turn. Errors by elements of half the length and by
/// rounding.
/// @returns nothing where a rigid motion is free: nothing carries the weight
[[nodiscard]] std::optional<results::StaticSag> static_sag(const assembly::Discretization &d,
                                                           double gravity);

} // namespace whirl::forced

#pragma once

#include "model/operation.h"
#include "results/level1.h"

#include <optional>

namespace whirl::operation {

/// The cross coupling that the gas of a stage is expected to have, N/m: API 617 (7th and 8th
/// edition), modified Alford equation, B P / (omega D H) times the ratio of densities, with B = 3
/// of a centrifugal impeller and 1.5 of an axial stage. The standard's C P / (D H N) with C = 9.55
/// (63) is the same torque from kW (hp) and rpm.
/// @param fastest  maximum continuous speed, rad/s
[[nodiscard]] results::Level1Stage stage_of(const model::Stage &stage, double fastest);

// What level I asks for, in words.
inline constexpr const char *level1_decrement =
    "logarithmic decrement with the anticipated cross coupling";
inline constexpr const char *level1_ratio = "critical over anticipated cross coupling";

/// What the search for the critical cross coupling leaves to be said, N/m.
struct Searched {
    double never_below = 0; ///< where none makes a motion grow: the largest that was tried
    std::optional<double> grows_with; ///< less than the critical one, of a motion not followed
};

/// Adds what level I asks for, and whether an analysis of level II is required, to numbers that are
/// complete.
void add_verdict(results::Level1 &level1, const Searched &searched);

} // namespace whirl::operation

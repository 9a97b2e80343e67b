#pragma once

#include "model/case.h"
#include "properties/draw.h"

namespace whirl::properties {

/// Factors by which the numbers of a case grow when its units shrink.
struct Units {
    double length = 1;
    double mass = 1;
    double time = 1;
};

/// The same scene in other units: every number by its dimension. Without its [map].
[[nodiscard]] model::Case in_units(model::Case scene, const Units &units);

/// x and y turned by an angle: bearings and pedestals as the turned observer sees them.
[[nodiscard]] model::Case turned(model::Case scene, double angle);

/// Seen from the other side: z -> length - z.
[[nodiscard]] model::Case mirrored(model::Case scene);

/// Seen in a mirror that holds the shaft: y -> -y and spin -> -spin. Without bearing tables.
[[nodiscard]] model::Case reflected(model::Case scene);

/// Every segment cut in two at an element's end, or anywhere where it has one element.
[[nodiscard]] model::Case split(model::Case scene, Draw &draw);

/// Discs, bearings and the other lists in another order.
[[nodiscard]] model::Case permuted(model::Case scene);

/// Other names for everything that has one, and names where there was none.
[[nodiscard]] model::Case renamed(model::Case scene);

} // namespace whirl::properties

#pragma once

#include "closed_form/supports.h"
#include "model/rotor.h"

#include <optional>
#include <string>

namespace whirl::rigid {

/// The bearings projected on rigid motion about a centre: sums of k, k z, k z^2 + kt, and of the
/// damping likewise. Empty, with the reason in `why`, for bearings that are not isotropic, that
/// depend on speed or stand on pedestals, and where there is no stiffness.
[[nodiscard]] std::optional<closed_form::ReducedSupports>
reduced_supports(const model::Rotor &rotor, double center, std::string &why);

} // namespace whirl::rigid

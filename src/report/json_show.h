#pragma once

#include "results/show.h"

#include <nlohmann/json_fwd.hpp>

namespace whirl::report {

/// Entries of `balancers` and the value of `anisotropy` (null for none) in the result of show.
[[nodiscard]] nlohmann::ordered_json balancer_json(const results::BalancerNumbers &balancer);
[[nodiscard]] nlohmann::ordered_json
anisotropy_json(const std::optional<results::AnisotropyChart> &chart);

} // namespace whirl::report

#pragma once

#include "analyses/show_result.h"

#include <nlohmann/json_fwd.hpp>

namespace whirl::report {

/// Entries of `balancers` and the value of `anisotropy` (null for none) in the result of show.
[[nodiscard]] nlohmann::ordered_json balancer_json(const analyses::BalancerNumbers &balancer);
[[nodiscard]] nlohmann::ordered_json
anisotropy_json(const std::optional<analyses::AnisotropyChart> &chart);

} // namespace whirl::report

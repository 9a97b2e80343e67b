#pragma once

#include "report/common/table.h"
#include "results/pendulum.h"

namespace whirl::report {

// Four-pendulum balancers in the report of balance.

[[nodiscard]] Json pendulum_json(const results::PendulumBalance &balancer, const Units &units);
[[nodiscard]] std::string pendulum_page(const std::vector<results::PendulumBalance> &balancers,
                                        const Units &units);
[[nodiscard]] std::string pendulum_text(const results::PendulumBalance &balancer,
                                        const Units &units);

} // namespace whirl::report

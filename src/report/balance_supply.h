#pragma once

// What balancers must supply and what stays, in the report of balance.

#include "report/common/json.h"
#include "report/reports.h"
#include "results/balance.h"

#include <string>
#include <vector>

namespace whirl::report {

/// Keys of one plane: needed, needed_beside_weights, capacity, least, weight; null without an
/// answer.
[[nodiscard]] Json plane_supply_json(const results::BalanceResult &result, std::size_t plane,
                                     const Units &units);
/// Keys of the result: phase, residual, supply, supply_beside_weights, works,
/// residual_weight_speeds.
[[nodiscard]] Json supply_json(const results::BalanceResult &result, const Units &units);
/// Where the motion is shown: at probes, without any at bearings and planes.
[[nodiscard]] std::vector<const results::LeftAt *>
places_for_readers(const results::BalanceSupply &supply, std::size_t most);
/// For the terminal and the page; nothing without an answer.
[[nodiscard]] std::string supply_text(const results::BalanceResult &result, const Units &units);
[[nodiscard]] std::vector<Section> supply_sections(const results::BalanceResult &result,
                                                   const Units &units);
/// All numbers as tables of their own.
[[nodiscard]] std::vector<TableFile> supply_tables(const results::BalanceResult &result);

} // namespace whirl::report

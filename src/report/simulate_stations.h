#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/simulate.h"

namespace whirl::report {

// Of `simulate` without balancers: what the stations did.

[[nodiscard]] Json stations_json(const results::SimulateResult &result);
[[nodiscard]] Json waterfall_json(const results::SimulateResult &result);
[[nodiscard]] std::string stations_page(const results::SimulateResult &result);
[[nodiscard]] std::string stations_text(const results::SimulateResult &result);
/// A row for each window and frequency.
[[nodiscard]] std::string waterfall_csv(const results::Waterfall &waterfall);

} // namespace whirl::report

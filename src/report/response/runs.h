#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/response.h"

#include <string>
#include <vector>

namespace whirl::report {

// What the report of the response says of its standard runs; nothing without any.

/// Adds the keys `runs` and `worst_run`.
void add_runs(Json &json, const results::ResponseResult &result, const Units &units);
/// All runs side by side, and the worst of them.
[[nodiscard]] std::vector<Section> run_sections(const results::ResponseResult &result,
                                                const Units &units);
/// The worst in a line, and the table.
[[nodiscard]] std::string worst_run_text(const results::ResponseResult &result, const Units &units);
[[nodiscard]] std::string runs_text(const results::ResponseResult &result, const Units &units);
/// The places of all runs at the operating speeds.
[[nodiscard]] std::string runs_csv(const results::ResponseResult &result, const Units &units);

} // namespace whirl::report

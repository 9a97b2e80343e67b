#pragma once

#include "report/common/column.h"
#include "report/common/json.h"
#include "report/report.h"
#include "results/response.h"

#include <string>
#include <vector>

namespace whirl::report {

/// Adds the keys `operating`, `worst` and `scale`, where there are operating speeds.
void add_operating(Json &json, const results::ResponseResult &result, const Units &units);
/// The same keys of one run.
[[nodiscard]] Json operating_json(const results::OperatingResponse &operating, const Units &units);
/// A line a place and speed, after columns of the whole (which runs they belong to).
[[nodiscard]] std::string operating_rows_csv(const Columns<results::OperatingRow> &first,
                                             const std::vector<results::OperatingRow> &rows,
                                             const Units &units);
/// What is told first; nothing without.
[[nodiscard]] std::vector<Section> operating_sections(const results::ResponseResult &result,
                                                      const Units &units);
/// For a summary: limits, and the places at the speed at which the machine runs most.
[[nodiscard]] std::vector<Section> operating_brief(const results::ResponseResult &result,
                                                   const Units &units);
/// The place that uses most of its limit, else that with the largest amplitude; with operating
/// speeds.
[[nodiscard]] model::Sentence operating_answer(const results::ResponseResult &result);
[[nodiscard]] std::string operating_text(const results::ResponseResult &result, const Units &units);
/// A line a place and speed.
[[nodiscard]] std::string operating_csv(const results::ResponseResult &result, const Units &units);

} // namespace whirl::report

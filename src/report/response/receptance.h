#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/response.h"

#include <string>
#include <vector>

namespace whirl::report {

// What the report of the response says of receptances.

[[nodiscard]] Json receptance_json(const results::ReceptanceResponse &response, const Units &units);
[[nodiscard]] std::string receptance_csv(const results::ReceptanceResponse &response,
                                         const Units &units);
[[nodiscard]] std::vector<Section> receptance_sections(const results::ReceptanceResponse &response,
                                                       const Units &units);
[[nodiscard]] std::string receptance_text(const results::ReceptanceResponse &response,
                                          const Units &units);

} // namespace whirl::report

#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/response.h"

#include <string>
#include <vector>

namespace whirl::report {

// What the report of the response says of the motion under the weight.

[[nodiscard]] Json gravity_json(const results::GravityResponse &response,
                                const std::vector<double> &speeds, const Units &units);
[[nodiscard]] std::string gravity_csv(const results::GravityResponse &response,
                                      const std::vector<double> &speeds, const Units &units);
[[nodiscard]] std::vector<Section> gravity_sections(const results::GravityResponse &response,
                                                    const std::vector<double> &speeds,
                                                    const Units &units);
[[nodiscard]] std::string gravity_text(const results::GravityResponse &response,
                                       const std::vector<double> &speeds, const Units &units);

} // namespace whirl::report

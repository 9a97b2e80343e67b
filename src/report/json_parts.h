#pragma once

// Parts that the JSON of several results is made of; only for sources in report.

#include "model/case.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

using Json = nlohmann::ordered_json;

/// null where there is no number; NaN and infinity become null when written.
[[nodiscard]] Json json_number(const std::optional<double> &value);
[[nodiscard]] Json json_list(const std::vector<std::optional<double>> &values);
/// [[from, to], ...]
[[nodiscard]] Json json_bands(const std::vector<std::pair<double, double>> &bands);

/// frame, unknowns, form and why.
[[nodiscard]] Json json_formulation(const results::Formulation &used);

/// What every result begins with.
[[nodiscard]] Json json_envelope(const char *command, const model::Case &scene,
                                 const results::ModelSummary &model);

/// As text; bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string json_text(const Json &json);

} // namespace whirl::report

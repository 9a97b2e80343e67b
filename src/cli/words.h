#pragma once

#include "model/case.h"
#include "results/model_summary.h"

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace whirl::cli {

inline constexpr double rpm = 30 / std::numbers::pi;    ///< rev/min in one rad/s
inline constexpr double hertz = 0.5 / std::numbers::pi; ///< Hz in one rad/s

/// Ten digits: what the elements are made for. "-" for what is missing, here and below.
[[nodiscard]] std::string precise(std::optional<double> value);
[[nodiscard]] std::string readable(std::optional<double> value);
[[nodiscard]] std::string rough(std::optional<double> value);
[[nodiscard]] std::optional<double> times(std::optional<double> value, double factor);

/// Title of the case and what was computed.
[[nodiscard]] std::string heading(const model::Case &scene, const std::string &what);
/// The model behind a result, and its notes.
[[nodiscard]] std::string model_text(const results::ModelSummary &model);
/// One place of a rotor: its name, or where it is.
[[nodiscard]] std::string place(const std::string &name, double z);
/// "at 4000 rpm", "0 to 4000 rpm, 101 speeds".
[[nodiscard]] std::string range_text(const std::vector<double> &speeds);

} // namespace whirl::cli

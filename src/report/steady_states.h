#pragma once

// Steady states of balancers, for the reports of stability and balance.

#include "report/common/json.h"
#include "report/reports.h"
#include "results/steady_states.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// null without an answer.
[[nodiscard]] Json states_json(const std::optional<results::SteadyStates> &states,
                               const Units &units);
[[nodiscard]] Json state_borders_json(const std::optional<results::SteadyStates> &states,
                                      const Units &units);
[[nodiscard]] Json states_undecided_json(const std::optional<results::SteadyStates> &states,
                                         const Units &units);
/// What states are followed over; null: over speeds.
[[nodiscard]] Json states_over_json(const std::optional<results::SteadyStates> &states,
                                    const Units &units);
[[nodiscard]] std::string states_text(const results::SteadyStates &states, const Units &units);
[[nodiscard]] std::vector<Section> states_sections(const results::SteadyStates &states,
                                                   const Units &units);

/// Every state at every speed, in a file of its own.
[[nodiscard]] TableFile states_table(const results::SteadyStates &states);

} // namespace whirl::report

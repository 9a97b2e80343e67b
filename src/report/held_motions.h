#pragma once

// Sweeps in time and motions from many starts, for the report of simulate.

#include "report/common/json.h"
#include "report/report.h"
#include "results/held_motion.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

// Keys of the result; null where they were not asked for.
[[nodiscard]] Json sweep_json(const std::optional<results::HeldSweep> &sweep, const Units &units);
[[nodiscard]] Json jumps_json(const std::optional<results::HeldSweep> &sweep, const Units &units);
[[nodiscard]] Json hysteresis_json(const std::optional<results::HeldSweep> &sweep,
                                   const Units &units);
[[nodiscard]] Json starts_json(const std::optional<results::ManyStarts> &starts,
                               const Units &units);

// The answer first, then a table.
[[nodiscard]] std::string sweep_text(const results::HeldSweep &sweep, const Units &units);
[[nodiscard]] std::string starts_text(const results::ManyStarts &starts, const Units &units);
[[nodiscard]] Section sweep_section(const results::HeldSweep &sweep, const Units &units);
[[nodiscard]] Section starts_section(const results::ManyStarts &starts, const Units &units);
[[nodiscard]] TableFile sweep_table(const results::HeldSweep &sweep);
[[nodiscard]] TableFile starts_table(const results::ManyStarts &starts);

/// "balanced", "coincident 2" (its branch, where several states do the same), "moving", "at rest
/// elsewhere", "at rest" where no states are known.
[[nodiscard]] std::string end_name(const results::ManyStarts &starts,
                                   const results::MotionEnd &end);

} // namespace whirl::report

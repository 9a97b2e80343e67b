#pragma once

#include "report/common/json.h"
#include "results/static_sag.h"

#include <string>

namespace whirl::report {

// The part of the report of `show` on the rotor at rest under its weight.

[[nodiscard]] std::string sag_heading(const results::StaticSag &sag);
[[nodiscard]] Json sag_json(const results::StaticSag &sag);
[[nodiscard]] std::string sag_page(const results::StaticSag &sag);
[[nodiscard]] std::string sag_text(const results::StaticSag &sag);

} // namespace whirl::report

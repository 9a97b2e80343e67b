#pragma once

#include <string_view>

namespace whirl::report {

/// Plotly's JavaScript, embedded at build time from its npm package; empty where the build had
/// none.
[[nodiscard]] std::string_view plotly_bundle();

} // namespace whirl::report

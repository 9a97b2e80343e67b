#pragma once

#include <string>

namespace whirl::report {

/// JavaScript that draws a result, embedded in the page as JSON, with Plotly; one for each command,
/// empty for commands that have none.
[[nodiscard]] std::string plot_script(const std::string &command);

} // namespace whirl::report

#pragma once

#include <functional>

namespace whirl::process {

/// Called with the share done, 0..1, between the steps of a long analysis; none by default.
void on_progress(std::function<void(double)> listener);

/// Tells the listener.
void report_progress(double share);

} // namespace whirl::process

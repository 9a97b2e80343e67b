#pragma once

namespace whirl::process {

/// Asks a long analysis to stop at its next step and hand back what it has. Safe in a signal
/// handler.
void request_interruption() noexcept;

/// True once after a request.
[[nodiscard]] bool take_interruption() noexcept;

} // namespace whirl::process

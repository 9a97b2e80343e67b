#include "process/interruption.h"

#include <csignal>

namespace whirl::process {

namespace {
volatile std::sig_atomic_t requested = 0;
}

void request_interruption() noexcept { requested = 1; }

bool take_interruption() noexcept {
    const bool now = requested != 0;
    requested = 0;
    return now;
}

} // namespace whirl::process

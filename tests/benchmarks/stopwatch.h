#pragma once

#include <chrono>

namespace whirl::benchmarks {

/// Wall time of a call, s.
template <class Call> double seconds_of(const Call &call) {
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    call();
    return std::chrono::duration<double>(clock::now() - start).count();
}

} // namespace whirl::benchmarks

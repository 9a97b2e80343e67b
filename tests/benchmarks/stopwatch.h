#pragma once

#include <chrono>
#include <ctime>

namespace whirl::benchmarks {

/// Wall time of a call, s.
template <class Call> double seconds_of(const Call &call) {
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    call();
    return std::chrono::duration<double>(clock::now() - start).count();
}

/// Processor time of this process over a call, s: waiting for a busy core does not count.
template <class Call> double processor_seconds_of(const Call &call) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double start = now();
    call();
    return now() - start;
}

} // namespace whirl::benchmarks

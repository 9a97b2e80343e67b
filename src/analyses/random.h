#pragma once

#include <cstdint>
#include <random>

namespace whirl::analyses {

/// Random numbers of one sample: they follow from the seed and its number alone, not from those
/// before it nor from the process. docs/case_format.md, "Results of samples".
[[nodiscard]] inline std::mt19937_64 bits_of(int seed, int sample) {
    std::seed_seq key{seed, sample};
    return std::mt19937_64(key);
}

/// Inside (0, 1), 2^52 places equally likely: with one bit more the last would round to 1. Own
/// transforms, here and elsewhere: those of the standard library differ between compilers.
[[nodiscard]] inline double share_of(std::uint64_t bits) {
    return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

} // namespace whirl::analyses

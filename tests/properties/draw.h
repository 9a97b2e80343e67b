#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace whirl::properties {

/// Numbers drawn at random, the same with every compiler and standard library.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : _engine(seed) {}

    /// Uniform between a and b.
    double between(double a, double b) {
        return a + (b - a) * (static_cast<double>(_engine() >> 11) * 0x1p-53);
    }
    /// Uniform in the logarithm.
    double over_decades(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
    /// a, a + 1, ..., b with equal chance.
    int integer(int a, int b) {
        return a + static_cast<int>(_engine() % static_cast<std::uint64_t>(b - a + 1));
    }
    bool chance(double share) { return between(0, 1) < share; }

  private:
    std::mt19937_64 _engine;
};

} // namespace whirl::properties

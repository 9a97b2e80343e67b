#pragma once

#include <random>

namespace whirl::tests {

/// Draws that are the same on every machine.
class Random {
  public:
    explicit Random(unsigned seed) : _engine(seed) {}

    /// Uniform in [a, b).
    double operator()(double a, double b) {
        return a + (b - a) * static_cast<double>(_engine()) / 4294967296.0;
    }
    bool coin() { return _engine() % 2 == 0; }

  private:
    std::mt19937 _engine;
};

} // namespace whirl::tests

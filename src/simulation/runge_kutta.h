#pragma once

#include <array>

namespace whirl::simulation {

/// Coefficients of an explicit Runge-Kutta pair (Butcher's table).
struct RungeKuttaPair {
    static constexpr int stages = 13;  ///< of Verner's method, cited above
    static constexpr int order = 8;    ///< of the solution that goes on
    static constexpr int embedded = 7; ///< of the one that it is compared with
    std::array<double, stages> c{};
    std::array<std::array<double, stages>, stages> a{};
    std::array<double, stages> b{};
    std::array<double, stages> embedded_b{};
};

/// Orders 8 and 7, thirteen stages, by J. H. Verner ("most efficient", 2008; SIAM J. Numer. Anal.
/// 15 (1978) 772). An oscillator is followed with an error a fiftieth of that of Fehlberg's pair of
/// these orders at equal steps. The embedded solution is moved to a tenth of its distance from the
/// other one, which leaves it its order: of an oscillator the estimate is then some five times the
/// error, as with Fehlberg's pair, instead of fifty times.
[[nodiscard]] const RungeKuttaPair &verner_pair();

} // namespace whirl::simulation

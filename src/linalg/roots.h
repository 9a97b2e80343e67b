#pragma once

#include <functional>
#include <utility>

namespace whirl::linalg {

using Function = std::function<double(double)>;

/// Where a function changes sign between a and b (Boost.Math, TOMS algorithm 748). The bracket is
/// kept throughout, so that a pole that changes sign is found as well as a zero.
///
/// @param fa,fb  values at a and b, of different signs
/// @param relative  width of the last bracket over the larger of |a|, |b|
/// @throws SolverError where the signs are the same
[[nodiscard]] double root_between(const Function &f, double a, double fa, double b, double fb,
                                  double relative = 1e-13);

/// Place of the least of a smooth function between two places, to half of the digits (Boost.Math,
/// Brent's method).
[[nodiscard]] double least_place(const Function &f, double low, double high);

/// Place and value of the least of a function between two places, by golden section; `done` sees
/// the ends of the bracket and the least value so far. (Not Brent's method: the searches end as
/// soon as what was found answers their question.)
[[nodiscard]] std::pair<double, double>
least_between(const Function &f, double low, double high,
              const std::function<bool(double low, double high, double least)> &done);

} // namespace whirl::linalg

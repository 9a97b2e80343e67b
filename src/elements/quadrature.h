#pragma once

#include <vector>

namespace whirl::elements {

/// Gauss-Legendre rule on [0, 1]: exact for polynomials of degree 2 n - 1.
struct Quadrature {
    std::vector<double> points;
    std::vector<double> weights;
};

/// The rule with n >= 1 points (kept, so that each n is computed once).
[[nodiscard]] const Quadrature &gauss_legendre(int n);

} // namespace whirl::elements

#pragma once

#include <Eigen/Core>

#include <optional>

namespace whirl::balancing {

/// Motion w + A u of planes (m, in axes that turn with the rotor) under what free balancers in
/// them supply, u (kg m); docs/theory.md, "What balancers must supply".
struct FreeBalancers {
    Eigen::MatrixXcd A;       ///< planes by planes, m/(kg m)
    Eigen::VectorXcd w;       ///< without the balancers, m
    Eigen::VectorXd capacity; ///< the most that each can supply, kg m; above 0, may be infinite
};

/// The criterion: u^H (A + A^H) u is negative for some u and above zero for none, but for rounding
/// where planes can do each other's work.
[[nodiscard]] bool works_everywhere(const Eigen::MatrixXcd &A);

/// What each supplies where all do their best: those within their capacity leave no motion of their
/// plane, those beyond stand at one angle, that of the motion that is left there. None where the
/// work of A is not negative for every u: then there may be several such positions, and none of
/// them keeps.
[[nodiscard]] std::optional<Eigen::VectorXcd> best_supply(const FreeBalancers &balancers);

} // namespace whirl::balancing

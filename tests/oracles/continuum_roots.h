#pragma once

#include "oracles/continuum.h"

#include <optional>
#include <vector>

namespace whirl::oracles {

/// The `wanted` lowest frequencies (rad/s; critical speeds, where synchronous), ascending, each to
/// the last digits of long double: isolated by counting, so none is missed and each has its index.
/// Fewer where there are none below `highest`. For conservative rotors with positive stiffness.
[[nodiscard]] std::vector<Real> frequencies(const Continuum &rotor, const Question &question,
                                            int wanted, Real highest);

/// The eigenvalue next to a first guess (Muller 1956); none where the iteration does not settle.
[[nodiscard]] std::optional<Complex> eigenvalue_near(const Continuum &rotor,
                                                     const Question &question, Complex guess);

} // namespace whirl::oracles

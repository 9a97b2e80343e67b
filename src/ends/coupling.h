#pragma once

#include "ends/branches.h"

namespace whirl::ends {

/// Where two motions a, b pass each other in frequency, coupling e_ab, e_ba between them can let
/// one grow at most if |e_ab e_ba| > |Re a Re b|: the eigenvalues of both have the product
/// Re a Re b - e_ab e_ba there, seen from their common frequency. What a change of the speed
/// couples is known from right and left vectors at both ends of the step: directly, and by way of
/// every other motion.
/// @param t        where they pass, part of the step
/// @param from,to  at its ends
/// @returns whether the coupling is far below that seen from either end
[[nodiscard]] bool weakly_coupled(const Branch &a, const Branch &b, double t, const Spectrum &from,
                                  const Spectrum &to);

} // namespace whirl::ends

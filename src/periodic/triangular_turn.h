#pragma once

#include "linalg/dense/products.h"
#include "periodic/monodromy.h"
#include "periodic/system.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::periodic {

/// Maps of so many equal parts of half a turn, one after the other, of states with entries made
/// comparable (weights_of()); by wider and wider windows where the steps are many.
/// @param steps  at least
/// @throws linalg::SolverError where the steps meet a singular matrix
[[nodiscard]] std::vector<linalg::Rows> turn_in_parts(const System &system, double speed, int steps,
                                                      int parts);

/// As floquet_series() of motions of which some die out so far within half a turn that rounding of
/// its matrix hides them. The matrix is not multiplied out: the maps of its parts, taken one after
/// the other to triangular form by orthogonal iteration (periodic Schur form: A. Bojanczyk, G.
/// Golub, P. Van Dooren, Proc. SPIE 1770, 1992), keep each motion beside those that die out about
/// as fast. Motions follow from the triangular factors backwards in time, in which those that die
/// out less do not grow.
/// @param spread  of what is left of the motions listed after half a turn, the logarithm
/// @param columns  directions that are followed at first, those of motions that die out far faster
///                 left out
/// @returns those that can be resolved; nothing where the parts that their terms would need are too
///          many
/// @throws linalg::SolverError
[[nodiscard]] std::optional<std::vector<FloquetSeries>> damped_series(const System &system,
                                                                      double speed, int steps,
                                                                      double spread, int columns,
                                                                      double fastest);

} // namespace whirl::periodic

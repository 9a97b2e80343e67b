#pragma once

#include "modes/biorthogonal.h"
#include "modes/following/continuation.h"
#include "modes/whirl_mode.h"

#include <complex>
#include <vector>

namespace whirl::modes {

/// Form planar_damped: the eigenvalue and the direction of whirl, the sign of its Im.
/// @param positive  that sign, where the eigenvalue is zero too
void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed);

/// The modes within the radius in which all pairs are known.
[[nodiscard]] Spectrum modes_of(const SymmetricProblem &problem, const FollowedSpeed &followed);

/// Modes from guesses of their eigenvalues and shapes, one for each; none where they cannot be
/// found from these.
[[nodiscard]] std::vector<WhirlMode> modes_near(const SymmetricProblem &problem, double speed,
                                                const std::vector<WhirlMode> &guesses);

/// Rates of modes that are all among the pairs; their states are made later.
/// @param problem  kept by reference
[[nodiscard]] ModeBasis basis_of(const SymmetricProblem &problem, const FollowedSpeed &followed,
                                 const std::vector<WhirlMode> &modes);

/// Modes found independently as pairs to begin with.
[[nodiscard]] StartingPairs starting_pairs(const Spectrum &found, results::Form form);

/// The slowest modes of a rotor without damping, in hyperbolic form, as pairs of the general one.
[[nodiscard]] StartingPairs starting_pairs(const std::vector<WhirlMode> &undamped, double speed);

} // namespace whirl::modes

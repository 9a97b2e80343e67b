#pragma once

#include "oracles/case_rotor.h"
#include "oracles/receptance.h"

#include <functional>
#include <utility>

namespace whirl::oracles {

/// An interval of spin speeds, rad/s.
using Band = std::pair<Real, Real>;

/// From and to of each band, one after the other.
[[nodiscard]] std::vector<Real> flat(const std::vector<Band> &bands);

/// Where `inside` holds: looked at on a grid of `steps`, ends by bisection to the last digits.
[[nodiscard]] std::vector<Band> bands_where(const std::function<bool(Real)> &inside, Real from,
                                            Real to, int steps);

/// Hermitian part of R = Omega^2 [K + i Omega C - Omega^2 (M - G)]^-1 at the places (1/kg), of the
/// continuum: mean work of the elementary imbalances is s^H R s. Auto-balancing where it is
/// negative definite (Filimonikhin et al., empirical criterion, on the flexible rotor).
[[nodiscard]] ComplexMatrix criterion_form(const SteppedRotor &rotor, Real speed,
                                           const std::vector<double> &places);

/// Eigenvalues of a Hermitian form, ascending.
[[nodiscard]] std::vector<Real> signature(const ComplexMatrix &form);

/// Bands of the criterion at the places together, and the speeds (rad/s) in a range at which the
/// rotor pinned at all of them is critical (zeros of the largest eigenvalue, no damping).
[[nodiscard]] std::vector<Band> criterion_bands(const SteppedRotor &rotor, Real from, Real to,
                                                const std::vector<double> &places);
[[nodiscard]] std::vector<Real> pinned_speeds(const SteppedRotor &rotor, Real from, Real to,
                                              const std::vector<double> &places);

} // namespace whirl::oracles

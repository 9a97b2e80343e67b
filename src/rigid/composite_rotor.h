#pragma once

#include "results/sentence.h"
#include "results/show.h"
#include "rigid/inertia.h"

namespace whirl::rigid {

/// What each balancer adds to the rotor at its balanced position. The dimensionless numbers and the
/// curves of one take the rest of the rotor, other balancers' masses included, as the bare rotor.
///
/// @param whole  inertia of the rotor with all its balancers
/// @param notes  gets what is missing and why
[[nodiscard]] std::vector<results::BalancerNumbers>
show_balancers(const model::Rotor &rotor, const Inertia &whole,
               std::vector<results::Sentence> &notes);

/// Anisotropy a = sum of dI exp(2 i angle) and (A_m0 + A_m D)/2 of the whole rotor, kg m2: its
/// modulus, and twice the direction of the axis of smaller inertia. Empty where a balancer has no
/// balanced position.
[[nodiscard]] std::optional<std::complex<double>>
anisotropy_of(const model::Rotor &rotor, const std::vector<results::BalancerNumbers> &balancers);

} // namespace whirl::rigid

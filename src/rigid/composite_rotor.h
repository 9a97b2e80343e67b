#pragma once

#include "model/sweep.h"
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

/// Dimensionless numbers of the whole rotor.
/// @param why  gets why those that need the bearings are missing
[[nodiscard]] results::RotorNumbers rotor_numbers(const model::Rotor &rotor, const Inertia &whole,
                                                  std::string &why);

/// One of these numbers by its name, of the rotor or of a balancer, as `show` gives it; Omega is
/// asked for as omega_0 (rad/s), which turns it into a spin speed.
/// @throws model::BadInput with the reason where the rotor has none
[[nodiscard]] double dimensionless_number(const model::Rotor &rotor,
                                          const model::DimensionlessNumber &number);

/// Anisotropy a = sum of dI exp(2 i angle) and (A_m0 + A_m D)/2 of the whole rotor, kg m2: its
/// modulus, and twice the direction of the axis of smaller inertia. Empty where a balancer has no
/// balanced position.
[[nodiscard]] std::optional<std::complex<double>>
anisotropy_of(const model::Rotor &rotor, const std::vector<results::BalancerNumbers> &balancers);

} // namespace whirl::rigid

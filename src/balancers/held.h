#pragma once

#include "model/case.h"

#include <complex>
#include <optional>
#include <vector>

namespace whirl::balancers {

// Balancers whose parts are fixed in the rotor. They have no unknowns of their own: with their
// point-mass imbalance they are a rigid body of the rotor, a disc of the diametral inertia
// (A_m + A_m0)/2 and the polar inertia A_m + A_m0 with the anisotropy (A_m0 + A_m D)/2, and an
// imbalance m0 R0 exp(i phase) + sum m_j R_j exp(i a_j) where they do not balance
// (docs/theory.md, "Balancers held").

/// Mass, inertia, anisotropy and imbalance that the parts of a balancer, fixed at some angles, and
/// its imbalance add to the rotor.
struct HeldMasses {
    model::Disc disc;
    std::complex<double> anisotropy; ///< kg m2, twice the direction; 0 where it is rounding alone
    std::complex<double> imbalance;  ///< what they leave of the balance, kg m; 0 likewise
};

/// @param angles  of the circled masses in the rotor, of pendulums those of the tied pairs, rad
[[nodiscard]] HeldMasses held_masses(const model::Balancer &balancer,
                                     const std::vector<double> &angles);

/// Where the parts of a balancer are held: as simulate.ball_angles says, else the position that the
/// case gives, else the usual balanced one; pendulums else at rest.
/// @param start  the balancer's of simulate.ball_angles; none, or of another size: not given
/// @param label  the balancer's path in the case, for messages: "balancer[0]"
/// @throws model::BadInput where there is no such place.
[[nodiscard]] std::vector<double> held_angles(const model::Balancer &balancer,
                                              const std::vector<double> *start,
                                              const std::string &label);

/// The rotor with the parts of all free balancers fixed at these angles.
[[nodiscard]] model::Rotor with_parts_held(model::Rotor rotor,
                                           const std::vector<std::vector<double>> &angles);

/// Takes the balancers that are to be held out of those of the rotor, with their part of the
/// starts of [simulate], and adds their masses to its discs, anisotropies and imbalances. Says in
/// the remarks of the case what is not obvious.
/// @throws model::BadInput as held_angles
void hold(model::Case &scene);

} // namespace whirl::balancers

#pragma once

#include "oracles/case_rotor.h"

namespace whirl::oracles {

/// Deflection at the disc over a force there, both Re(... exp(i frequency t)), m/N.
struct DiscReceptance {
    Complex along;  ///< in the direction of the force
    Complex across; ///< of y under a force along x; of x under one along y the opposite
    Complex round;  ///< w = x + i y over a force that turns with the frequency
};

/// One disc on a massless shaft on two supports that are the same from every direction:
/// flexibilities F of shaft and supports on (w, phi) of the disc, whose inertia forces are
/// m w^2 and (Id w^2 - Ip Omega w) of a motion exp(i w t) of x + i y. A force along x is half of
/// one that turns and half of one that turns backwards.
[[nodiscard]] DiscReceptance disc_receptance(const CaseRotor &rotor, Real speed, Real frequency);

} // namespace whirl::oracles

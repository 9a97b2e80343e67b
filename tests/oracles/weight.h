#pragma once

#include "oracles/case_rotor.h"

#include <vector>

namespace whirl::oracles {

/// Motion of the disc of a case under its weight; the mass of the shaft is left out.
struct WeightMotion {
    Real still = 0; ///< what stands still in the fixed frame, m
    Real twice = 0; ///< radius of the circle at twice the spin speed, m
};

/// One disc on a massless shaft with two bending stiffnesses (one direction all along) on two
/// supports. Flexibilities: in rotating axes (w, phi) = (F + R) f + D conj(f), F and D the mean and
/// half the difference of the two directions, R that of the supports, which act in the fixed frame:
/// at rest on the weight B exp(-i Omega t), at twice the spin speed on the inertia of A exp(i Omega
/// t).
[[nodiscard]] WeightMotion disc_under_weight(const CaseRotor &rotor, Real gravity, Real speed);

/// Local maxima of the circle over the range of speeds of the case, rad/s.
[[nodiscard]] std::vector<Real> weight_peaks(const CaseRotor &rotor, Real gravity);

} // namespace whirl::oracles

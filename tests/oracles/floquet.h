#pragma once

#include "oracles/case_rotor.h"
#include "oracles/receptance.h"

#include <functional>

namespace whirl::oracles {

/// M(t) q'' + D(t) q' + K(t) q = 0 with a common period.
struct PeriodicSystem {
    std::function<RealMatrix(Real)> M, D, K;
    Real period = 0; ///< s
};

/// Eigenvalues of the monodromy matrix: what a period makes of (q, q'). Gauss's collocation method
/// of order 8 (Butcher 1964), whose steps are linear systems here.
[[nodiscard]] std::vector<Complex> multipliers(const PeriodicSystem &system, int steps = 48);

/// Largest growth log|multiplier|/period, 1/s.
[[nodiscard]] Real floquet_growth(const PeriodicSystem &system, int steps = 48);

/// The case as a rigid body with inertial anisotropy on any bearings, in the fixed frame; q: w and
/// phi about the centre of mass in x, then in y. With a in rotating axes the anisotropy is
/// a e^{2 i Omega t} conj(phi'' - 2 i Omega phi') here; period pi/Omega.
[[nodiscard]] PeriodicSystem rigid_periodic(const CaseRotor &rotor, Real speed);

/// The same of the shaft on two-node elements (dense_rotor()), [[anisotropy]] where there is a
/// node.
[[nodiscard]] PeriodicSystem elastic_periodic(const CaseRotor &rotor, Real speed);

} // namespace whirl::oracles

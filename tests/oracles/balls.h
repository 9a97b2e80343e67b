#pragma once

#include "oracles/case_rotor.h"

namespace whirl::oracles {

/// sum of n m R over m0 R0, of balls or rings; four pendulums are no balls.
[[nodiscard]] Real capacity(const Balancer &balancer);

/// Angles (rad) of the symmetric balanced position against an imbalance at angle 0: sum of cosines
/// -n/E, sum of sines 0; for odd n one ball stands opposite the imbalance, the others in two groups
/// at +-alpha.
[[nodiscard]] std::vector<Real> symmetric_position(int n, Real capacity);

/// The position that the case gives, else the symmetric one.
[[nodiscard]] std::vector<Real> balanced_position(const Balancer &balancer);

/// D = (1/n) sum exp(2 i alpha).
[[nodiscard]] Complex second_harmonic(const std::vector<Real> &angles);

/// Inertias that the balls and the point mass of the imbalance add in their plane.
struct BallInertia {
    Real mass = 0;      ///< n m + m0
    Real diametral = 0; ///< (A_m + A_m0)/2, A_m = n m R^2, A_m0 = m0 R0^2
    Real polar = 0;     ///< A_m + A_m0
    Complex a = 0;      ///< (A_m0 + A_m D)/2
    Real a_paper = 0;   ///< (A_m0 + A_m |D|)/2, as S0 writes it
};
[[nodiscard]] BallInertia ball_inertia(const Balancer &balancer);

/// Smallest and largest |D| = |sum m R^2 exp(2 i alpha)|/sum m R^2 over all balanced positions:
/// from many starts by projected gradients, six balls at most.
struct HarmonicInterval {
    Real least = 0;
    Real most = 0;
};
[[nodiscard]] HarmonicInterval harmonic_interval(const std::vector<Row> &rows, Real imbalance);

} // namespace whirl::oracles

#pragma once

#include "oracles/case_rotor.h"

#include <string>
#include <vector>

namespace whirl::oracles {

/// A rotor that moves without tilt, its balls in the plane of its centre, all imbalances there:
/// M, k, c, n balls m at R with the drag h along the race.
struct PlanarBallRotor {
    Real mass = 0; ///< without the balls, kg
    Real k = 0, c = 0;
    int n = 0;
    Real ball = 0, radius = 0, drag = 0;
    Complex imbalance = 0; ///< kg m
};
/// Throws std::runtime_error where the case is none.
[[nodiscard]] PlanarBallRotor planar_ball_rotor(const CaseRotor &rotor);

/// Balls and rotor turning as one body.
struct PlanarState {
    std::string kind;         ///< "balanced", "coincident" or "split"
    std::vector<Real> angles; ///< of the balls in the rotor, rad
    Complex deflection = 0;   ///< in the rotor, m
    Real growth = 0;          ///< largest real part of small motions, 1/s
    int growing = 0;          ///< roots with a positive one
    Real next_frequency = 0;  ///< |Im| of the root next to the imaginary axis, rad/s
};
/// All of two balls at a speed: balanced, the coincident ones by falling angle, split.
[[nodiscard]] std::vector<PlanarState> planar_states(const PlanarBallRotor &rotor, Real speed);

/// Speeds between which the states of a kind begin, end or change the number of growing roots,
/// ascending, with the frequency of the pair that crosses (0: none does).
struct PlanarBorder {
    Real speed = 0, frequency = 0;
};
[[nodiscard]] std::vector<PlanarBorder> planar_borders(const PlanarBallRotor &rotor, Real from,
                                                       Real to);

/// What is left where balls without mass against an imbalance above their n m R stand at one angle
/// in the direction of the deflection, m.
[[nodiscard]] Real left_beyond_capacity(const PlanarBallRotor &rotor, Real speed);

} // namespace whirl::oracles

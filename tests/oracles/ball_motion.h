#pragma once

#include "oracles/case_rotor.h"

#include <string>
#include <vector>

namespace whirl::oracles {

/// What the motion of a rigid rotor with its balls ends in, at constant spin speed.
struct BallOutcome {
    double drift = 0;    ///< of a ball in the rotor, last tenth of the time, rad
    double swing = 0;    ///< of a ball, last fortieth, rad
    double residual = 0; ///< amplitude at the balancers over that without balls
    std::vector<std::vector<double>> angles; ///< of the balls in the rotor at the end, rad

    /// "lagging": a ball drifts by more than half a turn; "whirling": one swings by more than
    /// 0.05 rad; else "balanced" where the amplitude is below a tenth of that without balls, or
    /// "offset".
    [[nodiscard]] std::string name() const;
};

/// From rest, the balls at `angles` (rad, one list a balancer) and at rest in the rotor, to the end
/// of the case's time by Runge-Kutta 4, 120 steps a turn. Isotropic supports. Point balls gamma_j
/// in the fixed frame (Rodrigues et al. 2008, with the balls' inertia against tilt):
///   rotor: force -m d^2/dt^2(w_A + R e^{i gamma}) in the plane, and -m R^2 e^{i gamma}
///   (c'' + gamma'^2 c) on the slope, c = Re(phi e^{-i gamma});
///   R gamma'' + (h/m) R (gamma' - Omega) = -Im(e^{-i gamma} w_A'').
[[nodiscard]] BallOutcome ball_motion(const CaseRotor &rotor, double speed,
                                      const std::vector<std::vector<double>> &angles, double time);

} // namespace whirl::oracles

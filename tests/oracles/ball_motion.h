#pragma once

#include "oracles/case_rotor.h"

#include <string>
#include <vector>

namespace whirl::oracles {

/// What the motion of a rigid rotor with its balls or rings ends in, at constant spin speed.
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

/// From rest, balls and rings at `angles` (rad, one list a balancer) and at rest in the rotor, to
/// the end of `time` by Runge-Kutta 4 (CarriedRotor).
[[nodiscard]] BallOutcome ball_motion(const CaseRotor &rotor, double speed,
                                      const std::vector<std::vector<double>> &angles, double time);

} // namespace whirl::oracles

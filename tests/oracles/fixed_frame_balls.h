#pragma once

#include "oracles/case_rotor.h"

#include <array>
#include <vector>

namespace whirl::oracles {

/// Where balls of a rigid rotor (discs on a shaft without mass) come to rest on supports that
/// differ between x and y.
struct BallsAtRest {
    std::vector<std::vector<double>> angles; ///< of each balancer's balls in the rotor, mean, rad
    std::vector<double> amplitudes;          ///< of the shaft at each support, largest, m
    double swing = 0;                        ///< of a ball, rad
};

/// From rest, balls at `angles` and at rest in the rotor, to the end of `time` by Runge-Kutta 4, in
/// axes that stand still: Newton's equations of each ball and of the rotor, point masses on circles
/// in planes that follow the shaft. Means and largest values are those of the last fortieth.
[[nodiscard]] BallsAtRest fixed_frame_balls(const CaseRotor &rotor, double speed,
                                            const std::vector<std::vector<double>> &angles,
                                            double time);

} // namespace whirl::oracles

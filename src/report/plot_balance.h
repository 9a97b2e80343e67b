#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/balance.h"

namespace whirl::report {

/// Bands over spin speed for each plane and for all together, flexible above rigid, and below them
/// the eigenvalues of the joint form, coloured by their sign, on an axis that is logarithmic away
/// from zero.
[[nodiscard]] Figure balance_figure(const model::Case &scene, const results::BalanceResult &result);

/// Where along the shaft one balancer, and two, would work: the criterion over position and speed
/// with the rotor below it, and over two positions at one speed.
[[nodiscard]] Figure placement_figure(const model::Case &scene, const results::Placement &map);

/// Efficiency of a four-pendulum balancer over spin speed: planar forms, and the steady motions on
/// the flexible shaft by their stability.
[[nodiscard]] Figure pendulum_figure(const model::Case &scene,
                                     const results::PendulumBalance &balancer);

/// Efficiency of the planar rotor over the speed ratio: designs of the balancer side by side, and
/// its own design at several external dampings; exact by stability, and for small angles.
[[nodiscard]] Figure pendulum_designs_figure(const model::Case &scene,
                                             const results::PendulumBalance &balancer);

} // namespace whirl::report

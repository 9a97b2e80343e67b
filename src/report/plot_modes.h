#pragma once

#include "analyses/results.h"
#include "model/case.h"
#include "report/gnuplot.h"

#include <vector>

namespace whirl::report {

/// Deflection of a mode in the two planes at the instants that tell its whirl: x at its largest,
/// y a quarter turn later. Forward circular whirl: both equal; backward: opposite.
struct ModeCurves {
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> envelope; ///< major semi-axis of the orbit at each station
};
[[nodiscard]] ModeCurves mode_curves(const analyses::ModeShape &mode);

/// "1F · 13.97 Hz · forward", with the damping ratio where there is damping.
[[nodiscard]] std::string mode_heading(const analyses::ModeShape &mode);

/// One panel a mode: the orbits' envelope, the x and y curves and the rotor's outline.
[[nodiscard]] Figure modes_figure(const model::Case &scene, const analyses::ModesResult &result);

} // namespace whirl::report

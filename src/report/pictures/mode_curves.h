#pragma once

// What a mode's pictures, still and interactive, show of it.

#include <string>
#include <vector>

namespace whirl::results {
struct ModeShape;
} // namespace whirl::results

namespace whirl::report {

/// Deflection of a mode in the two planes at the instants that tell its whirl: y a quarter period
/// after x, so that circular forward whirl has equal and backward whirl opposite curves. Where the
/// planes move rather in step, as in a straight orbit aslant, y would vanish then: both are at one
/// instant. Of all instants the one with the largest sum of squares along the shaft.
struct ModeCurves {
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> envelope; ///< major semi-axis of the orbit at each station
    bool at_one_instant = false;  ///< y not a quarter period later
};
[[nodiscard]] ModeCurves mode_curves(const results::ModeShape &mode);

/// "1F · 13.97 Hz · forward", with the damping ratio where there is damping.
/// @param largest  modulus of the eigenvalues drawn together, rad/s: what rounding is measured by
[[nodiscard]] std::string mode_heading(const results::ModeShape &mode, double largest);
/// "1F · 5721.2 rpm · forward": of the mode at a critical speed, which is its frequency.
[[nodiscard]] std::string critical_heading(const results::ModeShape &mode);

} // namespace whirl::report

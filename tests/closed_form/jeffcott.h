#pragma once

#include <complex>

namespace whirl::closed_form {

/// Jeffcott rotor: disc of mass m in the middle of a massless shaft, planar w = x + i y.
/// m w'' + (c_e + c_i) w' + (k - i Omega c_i) w = m e Omega^2 exp(i Omega t).
/// Source: Genta, Dynamics of Rotating Systems (2005), chapter 2.
struct JeffcottRotor {
    double mass = 0.0;             ///< kg
    double stiffness = 0.0;        ///< N/m
    double external_damping = 0.0; ///< N s/m, c_e, of the surroundings
    double internal_damping = 0.0; ///< N s/m, c_i, of the rotating shaft
    double eccentricity = 0.0;     ///< m, e
};

/// Undamped critical speed sqrt(k/m), rad/s.
[[nodiscard]] double jeffcott_critical_speed(const JeffcottRotor &rotor);

/// Complex unbalance response in the rotating frame, m: u = m e Omega^2 / (k - m Omega^2 + i Omega
/// c_e). |u| is the amplitude, arg(u) the angle from the heavy spot (0 below, -pi/2 at, -> -pi
/// above the critical speed). Internal damping does not act: the shaft turns bent but does not
/// flex.
[[nodiscard]] std::complex<double> jeffcott_response(const JeffcottRotor &rotor, double spin_speed);

/// Free whirl w = exp(lambda t): the two roots of m l^2 + (c_e + c_i) l + k - i Omega c_i = 0,
/// forward first.
struct JeffcottRoots {
    std::complex<double> forward;  ///< 1/s
    std::complex<double> backward; ///< 1/s
};
[[nodiscard]] JeffcottRoots jeffcott_roots(const JeffcottRotor &rotor, double spin_speed);

/// Spin speed above which internal damping makes forward whirl grow, rad/s:
/// sqrt(k/m) (1 + c_e/c_i); infinite without internal damping.
[[nodiscard]] double internal_damping_threshold(const JeffcottRotor &rotor);

} // namespace whirl::closed_form

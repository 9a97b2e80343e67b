#pragma once

#include <string>

namespace whirl::results {

/// The smallest exact form of the equations that a scene allows (docs/theory.md).
enum class Form {
    planar, ///< complex planar w = x + i y, real symmetric M, G, K of half size
    /// complex planar w = x + i y with damping and cross coupling that are the same from every
    /// direction: complex symmetric matrices of half size
    planar_damped,
    hyperbolic, ///< real, four unknowns a node, orthotropic and undamped: symmetric
    general,    ///< real, four unknowns a node, any damping and coupling
    rotating,   ///< real, axes that turn with the rotor: it may be asymmetric, the bearings not
    hill        ///< both asymmetric: rotating axes, series in twice the spin speed
};

/// The form an analysis uses, and why.
struct Formulation {
    Form form = Form::general;
    std::string why;
};

/// The equations are in axes that turn with the rotor.
[[nodiscard]] inline bool in_rotating_axes(Form form) {
    return form == Form::rotating || form == Form::hill;
}

/// "fixed", "rotating" or "hill", as in the results.
[[nodiscard]] std::string frame_name(Form form);

/// "planar" or "real", as in the results.
[[nodiscard]] std::string unknowns_name(Form form);

/// The unknowns are w = x + i y.
[[nodiscard]] inline bool is_planar(Form form) {
    return form == Form::planar || form == Form::planar_damped;
}

/// "planar", "planar_damped", "hyperbolic", "general", "rotating" or "hill".
[[nodiscard]] std::string form_name(Form form);

} // namespace whirl::results

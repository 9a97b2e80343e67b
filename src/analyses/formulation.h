#pragma once

#include "model/case.h"

#include <string>

namespace whirl::analyses {

/// The smallest exact form of the equations that a scene allows (docs/theory.md).
enum class Form {
    planar,     ///< complex planar w = x + i y, real symmetric M, G, K of half size
    hyperbolic, ///< real, four unknowns a node, orthotropic and undamped: symmetric
    general     ///< real, four unknowns a node, any damping and coupling
};

/// The form an analysis uses, and why.
struct Formulation {
    Form form = Form::general;
    std::string why;
};

/// The smallest exact form, or the one the case forces.
/// @throws model::AnalysisFailure for scenes that need the rotating frame (not built yet);
/// model::BadInput where the forced form cannot describe the scene.
[[nodiscard]] Formulation choose_formulation(const model::Case &scene);

/// "planar" or "real", as in the results.
[[nodiscard]] std::string unknowns_name(Form form);

/// "planar", "hyperbolic" or "general".
[[nodiscard]] std::string form_name(Form form);

} // namespace whirl::analyses

#pragma once

#include "mesh_error/safety.h"
#include "results/error_parts.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "synchronous/critical_speeds.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::synchronous {

/// Relative error of each critical speed: estimate_safety times its difference from the finer model
/// and the rounding and residual of both, those of the finer model as part of the mesh error; all
/// roots are those of the whole model, so that nothing is left by a reduction. Symmetric forms:
/// root by root of the same whirl and the same eigenvalue of K - W^2 A, which by Courant and
/// Fischer is the same root on the finer model. Others: by likeness of the deflections, one to one.
/// None where the finer model has no such root.
[[nodiscard]] std::vector<std::optional<results::ErrorParts>>
critical_errors(const assembly::Discretization &coarse, results::Form form,
                const SynchronousModes &modes, const assembly::Discretization &finer,
                const SynchronousModes &finer_modes);

/// The same against a finer model that is made here; the part of the mesh infinite where it lacks a
/// root or could not be solved, which the notes say. Of a rigid shaft: residual and rounding.
[[nodiscard]] std::vector<results::ErrorParts>
errors_by_finer_model(const assembly::Discretization &rotor, results::Form form,
                      const SynchronousModes &modes, std::vector<results::Sentence> &notes);

} // namespace whirl::synchronous

#pragma once

#include "mesh_error/safety.h"
#include "results/formulation.h"
#include "synchronous/critical_speeds.h"

#include <optional>
#include <vector>

namespace whirl::synchronous {

/// Relative error of each critical speed: estimate_safety times its difference from the finer model
/// and the rounding and residual of both. Symmetric forms: root by root of the same whirl and the
/// same eigenvalue of K - W^2 A, which by Courant and Fischer is the same root on the finer model.
/// Others: by likeness of the deflections, one to one. None where the finer model has no such root.
[[nodiscard]] std::vector<std::optional<double>>
critical_errors(const assembly::Discretization &coarse, results::Form form,
                const SynchronousModes &modes, const assembly::Discretization &finer,
                const SynchronousModes &finer_modes);

} // namespace whirl::synchronous

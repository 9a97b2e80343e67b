#pragma once

#include "analyses/synchronous.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// Order of the model against which errors of critical speeds and band ends are judged, on the same
/// mesh: four more than the model's, five for the classical element. Its space holds that of the
/// model, and what it still lacks is far smaller than what the model lacks.
[[nodiscard]] int order_for_errors(int order);

/// Safety on the difference of the two models: covers what the finer one still lacks.
inline constexpr double error_safety = 1.2;

/// Relative error of each critical speed: `error_safety` times its difference from the finer model
/// and the rounding and residual of both. Symmetric forms: root by root of the same whirl and the
/// same eigenvalue of K - W^2 A, which by Courant and Fischer is the same root on the finer model.
/// Others: by likeness of the deflections, one to one. None where the finer model has no such root.
[[nodiscard]] std::vector<std::optional<double>>
critical_errors(const assembly::Discretization &coarse, Form form, const SynchronousModes &modes,
                const assembly::Discretization &finer, const SynchronousModes &finer_modes);

} // namespace whirl::analyses

#pragma once

#include "analyses/spectrum.h"
#include "model/case.h"

#include <memory>
#include <vector>

namespace whirl::analyses {

/// A finer model of the same rotor for error estimates: order p + 1 for order-p elements, half the
/// element length for classical ones.
[[nodiscard]] std::unique_ptr<SpectrumSolver> finer_solver(const model::Rotor &rotor, Form form,
                                                           int order, int refinement = 1);

/// Relative error of each eigenvalue of `coarse`, estimated from the finer model: the difference
/// for order p (the finer error is far smaller), 4/3 of it for classical elements (order h^2).
[[nodiscard]] std::vector<double> discretization_errors(const Spectrum &coarse,
                                                        const Spectrum &fine, int order);

/// Order of the shaft elements: the given one, or with order = "auto" the lowest of a ladder at
/// which the estimated error of the frequencies asked for meets the tolerance of the case.
/// @throws model::AnalysisFailure where the highest order does not meet it.
[[nodiscard]] int resolve_order(const model::Case &scene, const Formulation &formulation);

} // namespace whirl::analyses

#pragma once

#include "model/case.h"
#include "results/formulation.h"

#include <functional>

namespace whirl::mesh_error {

/// Order of the shaft elements: the given one, or with order = "auto" the lowest of a ladder at
/// which the estimated error of the frequencies asked for meets the tolerance of the case.
/// @throws model::AnalysisFailure where the highest order does not meet it.
[[nodiscard]] int resolve_order(const model::Case &scene, const results::Formulation &formulation);

/// The same in the form that suits the rotor best, whatever form the case asks for.
[[nodiscard]] int resolve_order_in_best_form(model::Case scene);

/// The lowest order of the ladder at which the largest relative error is within the tolerance.
/// @param error  estimated with elements of an order
/// @throws model::AnalysisFailure where the highest order does not meet it.
[[nodiscard]] int lowest_order(double tolerance, const std::function<double(int order)> &error);

} // namespace whirl::mesh_error

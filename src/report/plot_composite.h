#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/show.h"

namespace whirl::report {

/// The composite rotor over the mass of the balls at the case's capacity: inertia of the balls and
/// diametral inertias, anisotropy, polar inertia, and the diametral inertia over the angle of its
/// axis; with the signed D, and with the unsigned D_A of the paper beside it.
///
/// @param index  of a balancer with curves
[[nodiscard]] Figure composite_figure(const model::Case &scene, const results::ShowResult &result,
                                      std::size_t index);

/// The same curves as a table; inertias over the mean diametral one.
[[nodiscard]] std::string composite_csv(const results::CompositeCurves &curves);

} // namespace whirl::report

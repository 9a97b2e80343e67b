#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/show.h"

namespace whirl::report {

/// Tilt of the rigid rotor: critical speeds, stability limits and the unstable region ("-") over
/// the anisotropy, and over the polar inertia at the case's anisotropy.
[[nodiscard]] Figure anisotropy_figure(const model::Case &scene,
                                       const results::AnisotropyChart &chart);

/// The limits over spin speed as a table.
[[nodiscard]] std::string anisotropy_csv(const results::AnisotropyChart &chart);

} // namespace whirl::report

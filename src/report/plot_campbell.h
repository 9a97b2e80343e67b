#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/campbell.h"

namespace whirl::report {

/// Campbell diagram: whirl frequencies over spin speed, with the lines of the multiples and their
/// crossings; a second panel for the low range where the spin line would lie at the bottom, and one
/// for the logarithmic decrements of a damped rotor.
[[nodiscard]] Figure campbell_figure(const model::Case &scene,
                                     const results::CampbellResult &result);

/// Whether the mode grows at the index-th speed by more than its own error estimate.
[[nodiscard]] bool grows(const results::CampbellMode &mode, std::size_t index);

} // namespace whirl::report

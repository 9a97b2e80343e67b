#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/response.h"

#include <vector>

namespace whirl::report {

/// Unbalance response over spin speed: amplitudes (logarithmic), phases and bearing forces.
[[nodiscard]] Figure response_figure(const model::Case &scene,
                                     const results::ResponseResult &result);

/// Indices of the nodes that are drawn: all of them, or of many those with names first, filled up
/// with others that are spread along the shaft.
[[nodiscard]] std::vector<std::size_t> drawn_nodes(const results::ResponseResult &result);

} // namespace whirl::report

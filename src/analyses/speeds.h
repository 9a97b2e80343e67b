#pragma once

#include "model/case.h"

#include <functional>
#include <utility>
#include <vector>

namespace whirl::analyses {

/// The spin speeds of a case.
/// @throws model::BadInput where it has no [speeds].
[[nodiscard]] const model::SpeedRange &required_speeds(const model::Case &scene);

/// Least and largest |speed| between two speeds.
[[nodiscard]] std::pair<double, double> range_of_moduli(double from, double to);

/// One row of numbers for each speed, the speeds shared among the processes started by mpirun.
/// Collective; complete on process 0, empty on the others. Rows may differ in length.
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<std::vector<double>>
rows_at(const std::vector<double> &speeds,
        const std::function<std::vector<double>(double speed)> &row);

} // namespace whirl::analyses

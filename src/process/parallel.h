#pragma once

#include <functional>
#include <vector>

namespace whirl::process {

/// One row of numbers for each speed, the speeds shared among the processes started by mpirun.
/// Collective; complete on process 0, empty on the others. Rows may differ in length.
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<std::vector<double>>
rows_at(const std::vector<double> &speeds,
        const std::function<std::vector<double>(double speed)> &row);

} // namespace whirl::process

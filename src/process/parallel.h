#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace whirl::process {

/// Every process learns whether one of them failed, and throws the same. Collective.
/// @param mine  what failed on this one, or empty
/// @throws model::AnalysisFailure with the words of the first that failed
void agree_on_failure(const std::string &mine);

/// One row of numbers for each speed, the speeds shared among the processes started by mpirun.
/// Collective; complete on process 0, empty on the others. Rows may differ in length.
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<std::vector<double>>
rows_at(const std::vector<double> &speeds,
        const std::function<std::vector<double>(double speed)> &row);

/// What one piece of work hands back.
struct Outcome {
    std::vector<double> numbers;
    std::string text;
};

/// The outcomes of pieces of work 0 .. count-1 that take unequal times, dealt out among the
/// processes: whoever is free does the next one. A piece must not depend on those before it, and
/// must not wait for other processes. Process 0 works too, and reports the progress as a stage.
/// Collective; in order and complete on process 0, empty on the others.
/// @param doing  what is done, as for Stage
/// @param first  what process 0 does before its first piece, while the others have begun; or none
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<Outcome> deal(std::size_t count, const std::string &doing,
                                        const std::function<Outcome(std::size_t piece)> &work,
                                        const std::function<void()> &first = {});

} // namespace whirl::process

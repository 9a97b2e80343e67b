#pragma once

#include <vector>

namespace whirl::process {

/// Number of this process among `process_count()` started by mpirun.
[[nodiscard]] int process_rank();
[[nodiscard]] int process_count();

/// Concatenates the bytes of every process, in order of rank, on process 0 (empty elsewhere).
[[nodiscard]] std::vector<std::vector<char>> gather(const std::vector<char> &bytes);

/// The bytes of process 0 on every process.
void broadcast(std::vector<char> &bytes);

} // namespace whirl::process

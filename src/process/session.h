#pragma once

#include <vector>

namespace whirl::process {

/// Starts MPI, PETSc and SLEPc and ends them; one lives in main (or in a test program).
/// PETSc's own option database and its error printing are off: errors arrive as exceptions.
class Session {
  public:
    Session();
    ~Session();
    Session(const Session &) = delete;
    Session &operator=(const Session &) = delete;
    Session(Session &&) = delete;
    Session &operator=(Session &&) = delete;
};

/// Number of this process among `process_count()` started by mpirun.
[[nodiscard]] int process_rank();
[[nodiscard]] int process_count();

/// Concatenates the bytes of every process, in order of rank, on process 0 (empty elsewhere).
[[nodiscard]] std::vector<std::vector<char>> gather(const std::vector<char> &bytes);

/// The bytes of process 0 on every process.
void broadcast(std::vector<char> &bytes);

} // namespace whirl::process

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace whirl::process {

/// Number of this process among `process_count()` started by mpirun.
[[nodiscard]] int process_rank();
[[nodiscard]] int process_count();

/// Concatenates the bytes of every process, in order of rank, on process 0 (empty elsewhere).
[[nodiscard]] std::vector<std::vector<char>> gather(const std::vector<char> &bytes);

/// The bytes of process 0 on every process.
void broadcast(std::vector<char> &bytes);

/// Hands out 0, 1, 2, ..., each number once among all processes, to whoever asks next. Where they
/// share no memory each process asks one number ahead: on networks that cannot reach into the
/// memory of process 0 by themselves it answers between two pieces of its own work, and nobody
/// should wait for that. Making and ending one is collective.
class SharedCounter {
  public:
    SharedCounter();
    ~SharedCounter();
    SharedCounter(const SharedCounter &) = delete;
    SharedCounter &operator=(const SharedCounter &) = delete;
    SharedCounter(SharedCounter &&) = delete;
    SharedCounter &operator=(SharedCounter &&) = delete;

    [[nodiscard]] std::size_t next();
    /// Raises the numbers that nobody has asked for yet.
    void skip(std::size_t by);

  private:
    struct Window;
    std::unique_ptr<Window> _window; ///< none: there is one process
    std::size_t _alone = 0;          ///< the next number then
};

} // namespace whirl::process

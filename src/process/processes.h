#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace whirl::process {

/// Number of this process among `process_count()` started by mpirun.
[[nodiscard]] int process_rank();
[[nodiscard]] int process_count();

/// Until its end this process counts as the only one: what it does meanwhile is shared with no
/// other and waits for none, as for one of the rotors that are dealt out.
class Alone {
  public:
    Alone();
    ~Alone();
    Alone(const Alone &) = delete;
    Alone &operator=(const Alone &) = delete;
    Alone(Alone &&) = delete;
    Alone &operator=(Alone &&) = delete;
};

/// Does the work on every process started by mpirun, and has all of them end it alike: where it
/// fails on one, the others give up when they next wait for one another (in the collective calls of
/// this room, and at the end of the work), and every process throws what the first of them threw:
/// BadInput, or AnalysisFailure for all else. Collective; not within another one. A single process
/// just does the work.
/// @throws model::BadInput, model::AnalysisFailure
void together(const std::function<void()> &work);

/// Whether the text is that of process 0 on every process. Collective.
[[nodiscard]] bool same_everywhere(const std::string &text);

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

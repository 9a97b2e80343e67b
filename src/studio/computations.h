#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace whirl::studio {

/// Runs of this program for the panels of open pages.
///
/// Each is a process of its own: one that fails, hangs or takes all memory costs its picture and
/// nothing else, and one that nobody waits for any more is killed at once, wherever in PETSc or
/// LAPACK it is. It starts in 0.05 s, and it is asked by the same command line as from a shell.
class Computations {
  public:
    struct Answer {
        bool superseded = false; ///< a newer one was asked for meanwhile: the rest is empty
        bool failed = false;
        std::string output; ///< what it wrote to standard output
        std::string errors; ///< why it failed
    };

    /// Runs this program and waits. Of one panel only the newest counts.
    /// @param panel   whose it is
    /// @param number  larger ones are newer
    /// @param words   the command line behind the program's name
    /// @param gone    whether nobody waits for it any more
    [[nodiscard]] Answer run(const std::string &panel, long long number,
                             const std::vector<std::string> &words,
                             const std::function<bool()> &gone);

    /// Ends what runs for panels whose names begin so: the page was closed.
    void leave(const std::string &panels);

  private:
    std::mutex _lock;
    std::unordered_map<std::string, long long> _newest; ///< of each panel

    [[nodiscard]] bool is_newest(const std::string &panel, long long number);
};

} // namespace whirl::studio

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace whirl::process {

/// Another program at work: it reads a text, and what it writes is kept. It leads a group of
/// processes, all of which end with it: at the latest with this object, or when a signal ends this
/// program.
class Child {
  public:
    /// Starts the program, found in PATH; no shell is between. Returns at once.
    /// @param words  its name and arguments
    /// @param input  what it reads from standard input
    /// @returns nothing where there is no such program
    /// @throws model::AnalysisFailure where it cannot be started for another reason
    [[nodiscard]] static std::optional<Child> start(const std::vector<std::string> &words,
                                                    std::string_view input);
    ~Child();
    Child(Child &&other) noexcept;
    Child &operator=(Child &&other) noexcept;
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    /// Waits until it has ended. @returns false where it has not after so many seconds
    [[nodiscard]] bool ended_within(double seconds);
    /// How it ended, in words; nothing where it exited with 0. Only after it has ended.
    [[nodiscard]] std::string failure() const;
    /// What it has written to standard output, and to standard error.
    [[nodiscard]] std::string output() const;
    [[nodiscard]] std::string errors() const;

  private:
    Child() = default;

    pid_t _process = 0; ///< 0: none, or it has ended
    int _noted = -1;    ///< note_group
    int _status = 0;    ///< as of waitpid
    int _output = -1;   ///< descriptors of files without names
    int _errors = -1;

    void end() noexcept;
};

} // namespace whirl::process

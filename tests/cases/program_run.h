#pragma once

#include <string>
#include <vector>

namespace whirl::tests {

/// What a finished program left behind.
struct ProgramRun {
    int status = -1; ///< exit status; -1 where it did not exit by itself
    std::string output;
    std::string errors;
};

/// Runs a program with arguments, without a shell, and waits for it.
/// @param error_file  collects its standard error
[[nodiscard]] ProgramRun run_program(const std::string &program,
                                     const std::vector<std::string> &arguments,
                                     const std::string &error_file);

} // namespace whirl::tests

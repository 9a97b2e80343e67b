#pragma once

#include <string_view>

namespace whirl::cli {

/// Exit statuses of the program.
inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;    ///< the analysis failed
inline constexpr int exit_bad_input = 2; ///< the case or the arguments are wrong

/// Whether this is the only process, or the first of those that mpirun started. Works before MPI is
/// started.
[[nodiscard]] bool first_process();

/// Exit status for a failure that all processes meet alike and the first reports. The others leave
/// with 0: mpirun would stop the first one before it has spoken.
[[nodiscard]] inline int status_here(int status) { return first_process() ? status : exit_done; }

/// Writes one message to standard error, with a line end where it has none; names in it cannot
/// command the terminal. Only the first process speaks.
void complain(std::string_view message);
/// The same from any process.
void complain_here(std::string_view message);

/// Writes to standard output, likewise. @throws std::system_error where that is not possible.
void say(std::string_view text);

} // namespace whirl::cli

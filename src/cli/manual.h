#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace whirl::cli {

/// The manual page of a command in the language of man(7): what --help says of it.
/// @param reads     which sections of a case it reads, or empty
/// @param examples  what stands behind "whirl COMMAND "
[[nodiscard]] std::string manual_page(const CLI::App &command, const std::string &reads,
                                      const std::vector<std::string> &examples);

/// That of the program: its commands, each with its own page.
[[nodiscard]] std::string manual_of_program(const CLI::App &program);

} // namespace whirl::cli

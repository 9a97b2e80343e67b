#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::cli {

/// What the user asks for.
struct Arguments {
    std::string command;         ///< "show", "campbell", ...
    std::filesystem::path scene; ///< case folder or .toml file
    std::optional<std::filesystem::path> out;
    std::string speed;   ///< of --speed, as it was written
    bool json = false;   ///< the JSON result alone on standard output
    int digits = 5;      ///< of numbers on standard output
    bool errors = false; ///< columns of errors there, even below the digits shown
    bool all = false;    ///< all rows of all tables there
    bool quiet = false;  ///< nothing on standard output
    bool pdf = false;    ///< report: printed to a file as well
    bool parts = false;  ///< what a page that is open already shows, on standard output, for studio
    int port = 0;        ///< studio: of the address; 0: any that is free
    bool map = false; ///< balance: over plane positions; critical: over support stiffness as well
    std::vector<std::string> overrides; ///< "path.to.key=value"
    std::vector<std::string> compared;  ///< compare: a command, cases, results
    std::vector<std::string> names;     ///< compare: of the results, in their order
};

/// Either arguments, or the exit status of a program that has already answered (help, version) or
/// complained.
struct Parsed {
    std::optional<Arguments> arguments;
    int status = 0;
};

/// Reads the command line. Help and version go to standard output, a mistake as one message to
/// standard error.
[[nodiscard]] Parsed parse_arguments(int argc, const char *const *argv);

/// "show, campbell, ..."
[[nodiscard]] std::string command_list();

} // namespace whirl::cli

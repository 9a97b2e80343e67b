#pragma once

#include "model/case.h"
#include "properties/transforms.h"

#include <filesystem>
#include <string>
#include <vector>

namespace whirl::properties {

/// An answer of the program: its text for a terminal and its JSON.
struct CommandOutput {
    std::string text;
    std::string json;
    std::string refusal; ///< what it said instead of an answer
};

/// The commands of the program.
[[nodiscard]] const std::vector<std::string> &commands();

/// Runs one command on a case file in other units. Simulations are cut to a twentieth of their
/// time.
[[nodiscard]] CommandOutput run_in_units(const std::string &command,
                                         const std::filesystem::path &file, const Units &units);

/// Differences between an answer and the one in other units: words, and digits. Numbers of one key
/// must all differ by the same power of two.
/// @param digits  relative difference of the numbers that is rounding
[[nodiscard]] std::vector<std::string>
scaling_differences(const CommandOutput &here, const CommandOutput &there, double digits);

} // namespace whirl::properties

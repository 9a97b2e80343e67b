#pragma once

#include <string>
#include <utility>
#include <vector>

namespace whirl::tests {

/// A case with one mistake, and what the message must say of it.
struct BrokenCase {
    std::string name;
    int line;           ///< line of the mistake in `file`; 0: the message names none
    std::string key;    ///< path of the entry, or the column
    std::string phrase; ///< part of what follows the key
    std::string text;   ///< of case.toml
    std::vector<std::pair<std::string, std::string>> files = {}; ///< further files: name, text
    std::string file = "case.toml";                              ///< where the mistake is
};

// Each source's own (static), made before the constants of that source that start with them.

/// A sound case on lines 1 to 7; what is added starts on line 8.
static const std::string sound_case = "format = 1\n"
                                      "[material.steel]\n"
                                      "E = 2e11\n"
                                      "nu = 0.3\n"
                                      "rho = 7800\n"
                                      "[shaft]\n"
                                      "segments = [{length = 1.0, outer = 0.05}]\n";

/// A case with a sound material on lines 1 to 5; what is added starts on line 6.
static const std::string sound_material = sound_case.substr(0, sound_case.find("[shaft]"));

} // namespace whirl::tests

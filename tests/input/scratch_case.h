#pragma once

#include "broken_cases.h"
#include "input/case_file.h"
#include "model/errors.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace whirl::tests {

/// A folder of this process for the files of one test.
inline std::filesystem::path scratch_folder() {
    return std::filesystem::temp_directory_path() / ("whirl_input_" + std::to_string(::getpid())) /
           "scene";
}

/// Loads a case from its text and further files.
inline model::Case load_text(const std::string &text,
                             const std::vector<std::string> &overrides = {},
                             std::vector<std::pair<std::string, std::string>> files = {}) {
    write_case(scratch_folder(), {"", 0, "", "", text, std::move(files)});
    return input::load_case(scratch_folder(), overrides);
}

/// Message of the BadInput that loading throws; empty, with a failed test, where it does not.
inline std::string refusal(const std::string &text,
                           const std::vector<std::string> &overrides = {}) {
    try {
        (void)load_text(text, overrides);
    } catch (const model::BadInput &error) {
        return error.what();
    }
    ADD_FAILURE() << "the case was accepted";
    return "";
}

} // namespace whirl::tests

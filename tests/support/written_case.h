#pragma once

#include "input/case_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace whirl::tests {

/// The case that a file with this text, after format and a steel "s", describes.
inline model::Case written_case(const std::string &text) {
    // One file a test: they may run side by side.
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) /
        (std::string(test->test_suite_name()) + "_" + test->name() + ".toml");
    std::ofstream(file) << "format = 1\n[material.s]\nE = 2.1e11\nnu = 0.3\nrho = 7800\n" << text;
    return input::load_case(file);
}

} // namespace whirl::tests

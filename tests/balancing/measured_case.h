#pragma once

#include "input/case_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace whirl::tests {

using Phasor = std::complex<double>;

/// A number as the tables of readings have it: amplitude, phase in degrees.
inline Phasor polar_degrees(double amplitude, double degrees) {
    return std::polar(amplitude, degrees * std::numbers::pi / 180);
}
inline std::string cells_of(Phasor value) {
    return fmt::format("{:.17g},{:.17g}", std::abs(value),
                       std::arg(value) * 180 / std::numbers::pi);
}

/// A case file and the tables beside it, in a folder of the test.
inline std::filesystem::path
written_folder(const std::string &text,
               const std::vector<std::pair<std::string, std::string>> &tables) {
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name();
    for (char &letter : name)
        if (letter == '/')
            letter = '_';
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "case.toml") << text;
    for (const auto &[file, content] : tables)
        std::ofstream(folder / file) << content;
    return folder;
}
inline model::Case measured_case(const std::string &text,
                                 const std::vector<std::pair<std::string, std::string>> &tables) {
    return input::load_case(written_folder(text, tables));
}

} // namespace whirl::tests

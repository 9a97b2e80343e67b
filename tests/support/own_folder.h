#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <unistd.h>

namespace whirl::tests {

/// A test inside an empty folder, folder/"here", with room for what it needs beside that.
class InOwnFolder : public testing::Test {
  protected:
    std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                   ("whirl_" + std::to_string(getpid()) + "_" +
                                    testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::path before = std::filesystem::current_path();

    void SetUp() override {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder / "here");
        std::filesystem::current_path(folder / "here");
    }
    void TearDown() override {
        std::filesystem::current_path(before);
        std::filesystem::permissions(folder / "here", std::filesystem::perms::owner_all);
        std::filesystem::remove_all(folder);
    }
};

} // namespace whirl::tests

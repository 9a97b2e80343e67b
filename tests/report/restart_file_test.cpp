// A restart file is the one that an interrupted run wrote, or is refused.

#include "model/errors.h"
#include "report/restart_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <unistd.h>

namespace whirl::tests::restart_file_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

model::Restart sample() {
    model::Restart out;
    out.case_name = "drum \"two\" – µ";
    out.signature = {1.5, -2.25e-17, 1 / 3.0};
    out.time = 0.1 + 0.2;
    out.step = 1e-5 / 3;
    out.displacements = {1e-300, -5e-324, 0.0};
    out.velocities = {-0.0, 1.7976931348623157e308};
    out.angles = {3.14159};
    out.rates = {100.0 / 7};
    out.energy = 2e-3;
    out.largest = {1e-6};
    out.last = {1e-7};
    out.series = {{0, 0.1, 0.3}, {100, 100, 100}};
    return out;
}

class RestartFile : public testing::Test {
  protected:
    fs::path folder = fs::temp_directory_path() / ("whirl_restart_" + std::to_string(getpid()));
    fs::path file = folder / "restart.json";
    void SetUp() override { report::write_restart(file, sample()); }
    void TearDown() override { fs::remove_all(folder); }

    [[nodiscard]] std::string text() const {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    [[nodiscard]] std::string said_of(const std::string &content) const {
        std::ofstream(file, std::ios::binary) << content;
        try {
            (void)report::read_restart(file);
        } catch (const model::BadInput &error) {
            return error.what();
        }
        return "accepted";
    }
    [[nodiscard]] std::string with(const std::string &key, const json &value) const {
        json content = json::parse(text());
        content[key] = value;
        return said_of(content.dump());
    }
};

TEST_F(RestartFile, GivesBackAllDigits) {
    const model::Restart read = report::read_restart(file);
    const model::Restart written = sample();
    EXPECT_EQ(read.case_name, written.case_name);
    EXPECT_EQ(read.time, written.time);
    EXPECT_EQ(read.step, written.step);
    EXPECT_EQ(read.signature, written.signature);
    EXPECT_EQ(read.displacements, written.displacements);
    EXPECT_EQ(read.velocities, written.velocities);
    EXPECT_EQ(read.series, written.series);
    // Written in another layout it is the same.
    EXPECT_EQ(said_of(json::parse(text()).dump(4)), "accepted");
}

TEST_F(RestartFile, NumbersThatCannotBeAreNamed) {
    const std::string whole = text();
    EXPECT_NE(with("time", -5).find("with time = -5, expected 0 s or more"), std::string::npos);
    (void)said_of(whole);
    EXPECT_NE(with("step", 0).find("with step = 0, expected more than 0 s"), std::string::npos);
    (void)said_of(whole);
    EXPECT_NE(with("step", -1e-3).find("with step = -0.001"), std::string::npos);
    (void)said_of(whole);
    EXPECT_NE(with("time", nullptr).find("another file or was cut short"), std::string::npos);
    (void)said_of(whole);
    EXPECT_NE(with("time", 0.31).find("changed or damaged"), std::string::npos);
    (void)said_of(whole);
    json without = json::parse(whole);
    without.erase("checksum");
    EXPECT_NE(said_of(without.dump()).find("no checksum"), std::string::npos);
    EXPECT_EQ(said_of(whole), "accepted");
    const std::string deep = "{\"x\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_NE(said_of(deep).find("another file"), std::string::npos);
    EXPECT_THROW((void)report::read_restart("/dev/zero"), model::BadInput);
    EXPECT_THROW((void)report::read_restart(folder), model::BadInput);
}

/// A digit, a letter or a sign that is another one, anywhere in the file.
TEST_F(RestartFile, EveryChangedCharacterIsNoticed) {
    const std::string whole = text();
    const json before = json::parse(whole);
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        std::string changed = whole;
        const std::size_t at =
            std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
        const char c = whole[at];
        changed[at] = c >= '0' && c <= '9' ? (c == '9' ? '1' : static_cast<char>(c + 1))
                      : c == 'a'           ? 'b'
                                           : 'a';
        const json after = json::parse(changed, nullptr, false);
        if (after == before)
            continue; // digits beyond those of a double
        EXPECT_NE(said_of(changed), "accepted") << changed;
    }
}

} // namespace
} // namespace whirl::tests::restart_file_test

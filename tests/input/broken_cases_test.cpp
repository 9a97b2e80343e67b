#include "scratch_case.h"

#include <algorithm>

namespace whirl::tests {
namespace {

/// Takes the folder of this process away after its last test.
class RemoveScratch : public testing::Environment {
    void TearDown() override { std::filesystem::remove_all(scratch_folder().parent_path()); }
};
[[maybe_unused]] const auto *const remove_scratch =
    testing::AddGlobalTestEnvironment(new RemoveScratch);

class BrokenCases : public testing::TestWithParam<BrokenCase> {};

TEST_P(BrokenCases, OneMessageNamesPlaceKeyAndExpectation) {
    const BrokenCase &broken = GetParam();
    write_case(scratch_folder(), broken);
    std::string message;
    try {
        (void)input::load_case(scratch_folder());
    } catch (const model::BadInput &error) {
        message = error.what();
    }
    const std::string start = expected_start(scratch_folder(), broken);
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
    EXPECT_NE(message.find(broken.phrase, start.size()), std::string::npos) << message;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0)
        << "one mistake, one line: " << message;
}

std::string test_name(const testing::TestParamInfo<BrokenCase> &info) {
    std::string name = info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenCases, testing::ValuesIn(broken_cases()), test_name);

TEST(SeveralMistakes, AreListedAtOnceInTheOrderOfTheirLines) {
    const std::string message = refusal(sound_case + "[[disc]]\nz = 3\nmass = -1\n"
                                                     "[[bearing]]\nz = 0\nkxx = \"5 kg\"\n"
                                                     "[speeds]\nform = 3\n",
                                        {"shaft.order=99"});
    const std::string file = (scratch_folder() / "case.toml").generic_string();
    const std::vector<std::string> expected{
        "--set shaft.order=99: shaft.order: ", file + ":9: disc[0].z: ",
        file + ":10: disc[0].mass: ", file + ":13: bearing[0].kxx: ", file + ":15: speeds.form: "};
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n') + 1, std::ssize(expected))
        << message;
    std::size_t previous = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const std::size_t found = message.find(expected[i]);
        ASSERT_NE(found, std::string::npos) << expected[i] << "\nin\n" << message;
        EXPECT_TRUE(i == 0 || found > previous) << message;
        previous = found;
    }
}

TEST(SeveralMistakes, OfAStationTableAreAllListed) {
    write_case(scratch_folder(), {"",
                                  0,
                                  "",
                                  "",
                                  sound_material + "[shaft]\ntable = \"s.csv\"\n",
                                  {{"s.csv", "length,outer\n-1,0.1\n1,0\n1,0.1,2\n"}}});
    std::string message;
    try {
        (void)input::load_case(scratch_folder());
    } catch (const model::BadInput &error) {
        message = error.what();
    }
    // A row with a wrong number of cells leaves the meaning of the table in doubt: it alone is
    // named.
    EXPECT_NE(message.find("s.csv:4: expected 2 cells as in the header, got 3"), std::string::npos)
        << message;
}

TEST(MissingCase, IsBadInputThatNamesTheFile) {
    for (const std::string path : {"/nowhere/at/all", "/nowhere/x.toml"})
        try {
            (void)input::load_case(path);
            ADD_FAILURE() << path;
        } catch (const model::BadInput &error) {
            EXPECT_EQ(std::string(error.what()).substr(0, path.size()), path);
        }
}

} // namespace
} // namespace whirl::tests

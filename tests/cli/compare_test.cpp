// compare by its properties: a result against itself, exchanged, and two meshes within their
// errors.

#include "cases/program_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using whirl::tests::ProgramRun;

const std::string cases = std::string(WHIRL_ROOT) + "/cases/";
const std::string rotor = cases + "friswell_5_9_1";

class Compare : public testing::Test {
  protected:
    fs::path folder =
        fs::temp_directory_path() / ("whirl_compare_" + std::to_string(getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    [[nodiscard]] ProgramRun run(const std::vector<std::string> &arguments) const {
        return whirl::tests::run_program(WHIRL_PROGRAM, arguments, (folder / "errors").string());
    }
    [[nodiscard]] json compared(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"compare", "--json"});
        const ProgramRun done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.errors;
        return json::parse(done.output, nullptr, false);
    }
};

/// What two fans do where they run, under names of one's own: the numbers of `response`.
TEST_F(Compare, AmplitudesAtOperatingSpeedsAndMargins) {
    const std::string fan = cases + "id_fan";
    const std::string lighter = fan + "@disc[0].mass=4400";
    const json result =
        compared({"response", fan, lighter, "--name", "built", "--name", "lighter"});
    EXPECT_EQ(result.at("results")[0].at("name"), "built");
    EXPECT_EQ(result.at("results")[1].at("name"), "lighter");
    const ProgramRun done = run({"response", "--json", fan});
    const json own = json::parse(done.output);
    const auto first_of = [&](const std::string &name) {
        for (const json &at : result.at("differences"))
            if (at.at("quantity") == name)
                return at.at("first_value").get<double>();
        ADD_FAILURE() << name;
        return 0.0;
    };
    const json &row = own.at("operating")[0];
    EXPECT_EQ(first_of("probe " + row.at("name").get<std::string>() +
                       " against its pedestal, minimum speed: amplitude"),
              row.at("amplitude").get<double>());
    EXPECT_GT(first_of("bearing drive end, minimum speed: amplitude"), 0);
    const json &margin = own.at("margins")[0];
    EXPECT_EQ(first_of("separation margin 1, " + margin.at("of").get<std::string>() + " " +
                       margin.at("name").get<std::string>() + ", %"),
              margin.at("found").get<double>());
    EXPECT_EQ(run({"compare", "response", fan, fan, "--name", "one"}).status, 2);
}

TEST_F(Compare, AResultAgainstItselfIsZero) {
    const std::vector<std::pair<std::string, std::string>> commands{
        {"campbell", rotor},
        {"critical", rotor},
        {"response", cases + "lalanne_three_discs"},
        {"stability", cases + "overhung_cross_coupled"},
        {"modes", rotor},
        {"simulate", cases + "runup_jeffcott"},
        {"show", rotor}};
    for (const auto &[command, scene] : commands) {
        const json result = compared({command, scene, scene, "--set",
                                      command == "modes"      ? "speeds.count=1"
                                      : command == "simulate" ? "simulate.time=3"
                                                              : "speeds.count=5"});
        EXPECT_EQ(result.at("of"), command);
        EXPECT_GE(result.at("differences").size(), 2U) << command;
        for (const json &at : result.at("differences")) {
            EXPECT_EQ(at.at("difference"), 0.0) << command << at;
            EXPECT_EQ(at.at("relative"), 0.0) << command << at;
            EXPECT_NE(at.at("within_errors"), false) << command << at;
        }
    }
}

/// Elements of order 1 against those of order 10: what they differ by is what their errors say.
TEST_F(Compare, MeshesDifferWithinTheirErrors) {
    for (const std::string command : {"critical", "campbell"}) {
        const json result = compared({command, rotor + "@shaft.order=1@shaft.elements=4",
                                      rotor + "@shaft.order=10", "--set", "speeds.count=3"});
        int known = 0;
        for (const json &at : result.at("differences")) {
            // A mode that coarse elements lack is in one alone.
            if (at.at("difference").is_null() || at.at("error").is_null())
                continue;
            ++known;
            EXPECT_NE(at.at("difference"), 0.0) << at;
            EXPECT_EQ(at.at("within_errors"), true) << command << at;
        }
        EXPECT_GE(known, 6) << command;
    }
}

TEST_F(Compare, ExchangedDifferencesChangeTheirSigns) {
    const std::string stiffer = rotor + "@bearing[0].k=2e6";
    const json there = compared({"critical", rotor, stiffer}).at("differences");
    const json back = compared({"critical", stiffer, rotor}).at("differences");
    ASSERT_EQ(there.size(), back.size());
    int beyond = 0;
    for (const json &a : there) {
        const auto b = std::find_if(back.begin(), back.end(), [&](const json &at) {
            return at.at("quantity") == a.at("quantity");
        });
        ASSERT_NE(b, back.end());
        EXPECT_EQ(a.at("first_value"), b->at("other_value"));
        EXPECT_EQ(a.at("within_errors"), b->at("within_errors"));
        if (a.at("difference").is_null()) {
            EXPECT_TRUE(b->at("difference").is_null());
            continue;
        }
        EXPECT_EQ(a.at("difference").get<double>(), -b->at("difference").get<double>());
        for (const json &at : {a, *b}) // each to its first
            EXPECT_EQ(at.at("relative").get<double>(),
                      at.at("difference").get<double>() / at.at("first_value").get<double>());
        EXPECT_GT(a.at("difference").get<double>(), 0) << "a stiffer bearing raises every one" << a;
        beyond += a.at("within_errors") == false ? 1 : 0;
    }
    EXPECT_GE(beyond, 4);
}

TEST_F(Compare, ResultsInFilesAreThoseComputedNow) {
    const fs::path before = folder / "before";
    ASSERT_EQ(run({"critical", rotor, "--quiet", "--out", before.string()}).status, 0);
    const json result = compared(
        {"critical", (before / "critical.json").string(), rotor, rotor + "@shaft.order=4"});
    ASSERT_EQ(result.at("results").size(), 3U);
    bool another = false;
    for (const json &at : result.at("differences")) {
        const bool same = at.at("other") == rotor;
        EXPECT_TRUE(!same || at.at("difference") == 0.0) << at;
        another = another || (!same && at.at("difference") != 0.0);
    }
    EXPECT_TRUE(another);
}

TEST_F(Compare, WritesPictureTableAndPage) {
    const fs::path out = folder / "out";
    const ProgramRun done = run({"compare", "response", cases + "lalanne_three_discs",
                                 cases + "lalanne_three_discs@shaft.order=2", "--set",
                                 "speeds.count=5", "--out", out.string()});
    ASSERT_EQ(done.status, 0) << done.errors;
    EXPECT_NE(done.output.find("within errors"), std::string::npos);
    for (const char *name : {"compare.json", "compare.csv", "report.html"})
        EXPECT_TRUE(fs::exists(out / name)) << name;
}

/// In the units asked for each number is that in SI by the factor of its unit; its JSON stays in
/// SI.
TEST_F(Compare, TextAndTableAreInTheUnitsAskedFor) {
    std::vector<std::string> arguments{"critical", rotor, rotor + "@shaft.order=2"};
    const json si = compared(arguments);
    arguments.insert(arguments.end(), {"--units", "speed=rpm", "--out", (folder / "rpm").string()});
    const json same = compared(arguments);
    EXPECT_EQ(same.at("differences"), si.at("differences"));
    std::ifstream file(folder / "rpm" / "compare.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "quantity,unit,other,first_value,other_value,difference,relative,error,"
                    "within_errors");
    for (const json &at : si.at("differences")) {
        std::getline(file, line);
        EXPECT_NE(line.find(",rpm,"), std::string::npos) << line;
        std::istringstream cells(line.substr(line.find(",rpm,") + 5));
        std::string cell;
        std::getline(cells, cell, ','); // the other result
        for (const char *key : {"first_value", "other_value", "difference"}) {
            std::getline(cells, cell, ',');
            const double value = at.at(key).get<double>() * 60 / (2 * std::numbers::pi);
            EXPECT_NEAR(std::stod(cell), value, 1e-14 * std::abs(value)) << key;
        }
    }
}

TEST_F(Compare, MistakesAreOneMessageAndStatusTwo) {
    const fs::path out = folder / "show";
    ASSERT_EQ(run({"show", rotor, "--quiet", "--out", out.string()}).status, 0);
    std::ofstream(folder / "other.json") << "{\"a\": 1}";
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
        {{"compare"}, "results to compare are missing"},
        {{"compare", "critical", rotor}, "expected two results or more"},
        {{"compare", rotor, rotor}, "expected a command before the cases"},
        {{"compare", "critical", (out / "show.json").string(), rotor},
         "expected results of one command, got show"},
        {{"compare", "critical", (folder / "other.json").string(), rotor},
         "expected a result that whirl wrote (JSON"},
        {{"compare", (folder / "none.json").string(), (folder / "none.json").string()},
         "there is no such file"},
        {{"compare", "rigid-limit", cases + "rigid_limit", cases + "rigid_limit"},
         "compare knows the results of"}};
    for (const auto &[arguments, message] : mistakes) {
        const ProgramRun done = run(arguments);
        EXPECT_EQ(done.status, 2) << message;
        EXPECT_NE(done.errors.find(message), std::string::npos) << done.errors;
    }
}

} // namespace

// docs/schema/result.schema.json: what no check of cases/ brings out. Those are held against it
// where they run (tests/cases).

#include "cases/program_run.h"
#include "results/simulate.h"
#include "support/schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace whirl::tests;
using nlohmann::json;

/// The result of a command line in the folder cases/, words between blanks.
json result_of(const std::string &line) {
    const std::string cases = WHIRL_ROOT "/cases/";
    std::vector<std::string> arguments;
    std::istringstream words(line);
    for (std::string word; words >> word;)
        arguments.push_back(word.starts_with("cases/") ? cases + word.substr(6) : word);
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    const std::string errors = testing::TempDir() + "whirl_schema_" + std::to_string(getpid());
    const ProgramRun run = run_program(WHIRL_PROGRAM, arguments, errors);
    std::remove(errors.c_str());
    EXPECT_EQ(run.status, 0) << line << "\n" << run.errors;
    return run.status == 0 ? json::parse(run.output) : json();
}

class ResultSchema : public testing::TestWithParam<const char *> {};

TEST_P(ResultSchema, holds) {
    const json result = result_of(GetParam());
    ASSERT_TRUE(result.is_object());
    EXPECT_EQ(broken_rules_of_result(result), "") << GetParam();
    EXPECT_EQ(broken_rules(schema_file("result.schema.json"), result), "") << GetParam();
}

/// All words for how a motion ends stand in the schema and on the page of results.
TEST(Outcomes, AreAllNamed) {
    const json words = schema_file("result.schema.json")
                           .at(json::json_pointer("/definitions/simulate/properties/outcome/enum"));
    std::stringstream page;
    page << std::ifstream(WHIRL_ROOT "/docs/case_format.md").rdbuf();
    std::size_t count = 0;
    for (int i = 0; i <= static_cast<int>(whirl::results::Outcome::undecided); ++i, ++count) {
        const std::string word =
            whirl::results::outcome_name(static_cast<whirl::results::Outcome>(i));
        EXPECT_EQ(std::ranges::count(words, json(word)), 1) << word;
        EXPECT_NE(page.str().find("`\"" + word + "\"`"), std::string::npos) << word;
    }
    EXPECT_EQ(words.size(), count);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, ResultSchema,
    testing::Values(
        "report cases/compressor_margins", "report cases/id_fan", "show cases/compressor_margins",
        "modes cases/compressor_margins", "modes cases/anisotropic_disc_flexible",
        "accuracy cases/friswell_5_9_1", "critical cases/compressor_margins --map-bearing 0",
        "critical cases/compressor_margins --set imbalance=[]",
        "campbell cases/anisotropic_disc_flexible --set speeds.count=3",
        "campbell cases/compressor_margins --set speeds.count=3 --units us --json-units",
        "balance cases/disc_type_short --map --set speeds.count=5",
        "balance cases/jeffcott_two_balls --set speeds.count=3",
        "balance cases/jeffcott_two_balls --set speeds.count=3 --set balancer[0].n=3 "
        "--set bearing[0].c=0 --set bearing[1].c=0 --units us --json-units",
        "balance cases/jeffcott_two_balls --set speeds.count=3 "
        "--set balancer[0].rolling_resistance=1e-5",
        "simulate cases/sweep_two_balls --set simulate.sweep.count=2 --set simulate.sweep.hold=1 "
        "--set simulate.starts.count=3 --units us --json-units",
        "simulate cases/sweep_two_balls --set simulate.sweep= --set simulate.starts.count=2 "
        "--set simulate.starts.kind=grid",
        "balance cases/ring_jeffcott --set balance.simulated=1 --set speeds.count=5",
        "stability cases/twisted_shaft --set speeds.count=3 --set shaft.order=3",
        "stability cases/composite_rotor --set speeds.count=3 --set map.x.path=speed "
        "--set map.x.dimensionless=Omega --set map.x.from=0.5 --set map.x.to=2 --set map.x.count=2 "
        "--set map.y.path=balancer[0].mass --set map.y.dimensionless=m --set map.y.from=0.1 "
        "--set map.y.to=1.1 --set map.y.count=2",
        "sweep cases/composite_rotor --set speeds.count=3 --set sweep.x.path=disc[0].Ip "
        "--set sweep.x.dimensionless=C --set sweep.x.values=[0.2,0.7,0.9] "
        "--set sweep.y.path=balancer[0].mass --set sweep.y.dimensionless=m "
        "--set sweep.y.values=[0.05,0.1]",
        "stability cases/anisotropic_rotor --set speeds.count=5 --set map.x.path=speed "
        "--set map.x.from=1 --set map.x.to=50 --set map.x.count=2 "
        "--set map.y.path=anisotropy[0].dI --set map.y.from=0 --set map.y.to=0.01 "
        "--set map.y.count=2",
        "stability cases/jeffcott_two_balls --set speeds.from=500 --set speeds.to= "
        "--set speeds.count=1 --set states.max_balls=2 --set map.x.path=balancer[0].mass "
        "--set map.x.from=0.03 --set map.x.to=0.06 --set map.x.count=3",
        "response cases/compressor_margins --set standard.unbalance=api617 --set speeds.count=5",
        "stability cases/api617_clearances --set speeds.count=5",
        "samples cases/uncertain_jeffcott --set samples.count=5", "sweep cases/uncertain_jeffcott",
        "sweep cases/uncertain_jeffcott --set sweep.y= --set sweep.x.count=3",
        "weights cases/weights_fan",
        "weights cases/weights_fan --set weights.scatter=0.02 --set plane[0].holes=8",
        "weights cases/id_fan --set plane=[{z=2.1}] --set weights.speeds=[100] "
        "--set weights.stations=[1.0] --set speeds.count=5",
        "balance cases/id_fan --set plane=[{z=2.1}] --set weights.phase=lag --set speeds.count=3",
        "compare critical cases/nelson_mcvaugh cases/nelson_mcvaugh@shaft.order=1"),
    [](const auto &test) { return "run_" + std::to_string(test.index + 1); });

// A key that nobody described, and one that is missing.
TEST(ResultSchemaRules, knows_every_key_and_misses_none) {
    json result = result_of("critical cases/friswell_5_9_1");
    ASSERT_EQ(broken_rules_of_result(result), "");
    json more = result;
    more["critical_speeds"][0]["colour"] = "green";
    EXPECT_NE(broken_rules_of_result(more), "");
    result["critical_speeds"][0].erase("whirl");
    EXPECT_NE(broken_rules_of_result(result), "");
}

} // namespace

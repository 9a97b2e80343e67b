// Report of `stability`: what its first lines say is what its tables say.

#include "results/stability.h"

#include "report/common/units.h"
#include "whole_report.h"
#include "written_in.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace whirl::report {

namespace {

using results::StabilityResult;
using results::Verdict;

class StabilityReport : public ScratchFolder {
  protected:
    /// Three speeds of a rotor that is stable but for what a test changes.
    static StabilityResult three_speeds() {
        StabilityResult result;
        result.speeds = {0, 100, 200};
        result.growth = {-1, -1, -1};
        result.verdict = {Verdict::stable, Verdict::stable, Verdict::stable};
        return result;
    }
    static StabilityResult told_apart() {
        StabilityResult result = three_speeds();
        result.resolved_up_to = 5000;
        result.resolved_growth = result.growth;
        result.resolved_verdict = result.verdict;
        result.unresolved_growth = {-2, 0.5, 3};
        result.growth = {-1, 0.5, 3};
        result.verdict = {Verdict::stable, Verdict::unstable, Verdict::unstable};
        result.unstable = {{50, 200}};
        result.unstable_error = {{1, 0}};
        return result;
    }
    static bool has(const std::string &text, const std::string &part) {
        return text.find(part) != std::string::npos;
    }
};

TEST_F(StabilityReport, NoBandIsNoneOnlyWhereNothingGrows) {
    StabilityResult result = three_speeds();
    EXPECT_TRUE(has(describe(sample_case(), result).text({}), "Unstable: none in this range"));
    result.verdict[1] = Verdict::unstable;
    result.growth[1] = 2;
    const std::string grows = describe(sample_case(), result).text({});
    EXPECT_FALSE(has(grows, "none in this range"));
    EXPECT_TRUE(has(grows, "at 1 of 3 speeds a motion grows that no band was found for"));
    result.verdict[1] = Verdict::unknown;
    result.growth[1] = std::numeric_limits<double>::quiet_NaN();
    const std::string unknown = describe(sample_case(), result).text({});
    EXPECT_FALSE(has(unknown, "none in this range"));
    EXPECT_TRUE(has(unknown, "at 1 of 3 speeds it is not known whether a motion grows"));
    const Files files = write_report(sample_case(), result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "stability");
    EXPECT_TRUE(json.at("verdict")[1].is_null());
    EXPECT_FALSE(has(content_of(folder / "report.html"), "None in this range"));
}

TEST_F(StabilityReport, ResolvedMotionsAndFasterOnesAreToldApart) {
    const StabilityResult result = told_apart();
    const std::string text = describe(sample_case(), result).text({});
    EXPECT_TRUE(has(
        text, "up to frequencies of 5000 rad/s, which the elements resolve: none in this range"));
    EXPECT_TRUE(has(text, "growing at 2 of 3 speeds, by up to 3 1/s"));
    EXPECT_FALSE(has(text, "\nUnstable: none"));
    const Files files = write_report(sample_case(), result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "stability");
    EXPECT_EQ(json.at("resolved_verdict")[2], "stable");
    EXPECT_EQ(json.at("unresolved_growth")[2], 3);
    const std::string csv = content_of(folder / "stability.csv");
    EXPECT_TRUE(has(csv, "resolved growth [1/s],resolved verdict,unresolved growth [1/s]")) << csv;
    EXPECT_TRUE(has(csv, "growth,200,200,3,unstable,,,-1,stable,3")) << csv;
    EXPECT_TRUE(has(content_of(folder / "report.html"), "growing at 2 of 3 speeds"));
}

TEST_F(StabilityReport, TheReachIsInTheUnitOfFrequencies) {
    model::OutputUnits units;
    units.of["frequency"] = {"Hz", 2 * std::numbers::pi};
    const WrittenIn written(units);
    const std::string text = in_written_units(describe(sample_case(), told_apart()).text({}));
    EXPECT_TRUE(has(text, "up to frequencies of 795.8 Hz, which the elements resolve")) << text;
}

TEST_F(StabilityReport, OfOneSpeedAsOfMany) {
    StabilityResult result = told_apart();
    result.speeds = {200};
    for (std::vector<double> *of :
         {&result.growth, &result.resolved_growth, &result.unresolved_growth})
        *of = {of->back()};
    for (std::vector<Verdict> *of : {&result.verdict, &result.resolved_verdict})
        *of = {of->back()};
    result.unstable = {};
    const std::string text = describe(sample_case(), result).text({});
    EXPECT_TRUE(has(text, "5000 rad/s, which the elements resolve: Stable: every motion dies out"));
    EXPECT_TRUE(has(text, "which the elements do not resolve: growing, by up to 3 1/s")) << text;
}

// A column in which no end has anything is left out.
TEST_F(StabilityReport, EndsHaveTheColumnsThatSaySomething) {
    StabilityResult result = three_speeds();
    result.unstable = {{50, 200}};
    results::StabilityEnd end;
    end.speed = 50;
    end.frequency_rotating = 30;
    end.growing_above = 2;
    result.ends = {end};
    const std::string text = describe(sample_case(), result).text({});
    EXPECT_TRUE(has(text, "in rotating axes"));
    EXPECT_FALSE(has(text, "in fixed axes"));
}

} // namespace

} // namespace whirl::report

// Results from files are compared only where they hold all that is compared: whatever else stands
// in a place that a comparison reads is refused, with its name.

#include "cases/program_run.h"
#include "model/errors.h"
#include "report/common/units.h"
#include "report/compare/comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <unistd.h>

namespace compare_damage_test {
namespace {

namespace fs = std::filesystem;
using whirl::report::Json;
using Pointer = Json::json_pointer;

const std::string cases = std::string(WHIRL_ROOT) + "/cases/";

class CompareDamage : public testing::Test {
  protected:
    fs::path folder = fs::temp_directory_path() / ("whirl_damage_" + std::to_string(getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    [[nodiscard]] Json result_of(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        const auto done =
            whirl::tests::run_program(WHIRL_PROGRAM, arguments, (folder / "errors").string());
        EXPECT_EQ(done.status, 0) << done.errors;
        return Json::parse(done.output, nullptr, false);
    }

    /// One result of each command that has something to compare.
    [[nodiscard]] std::vector<Json> results() const {
        const std::string rotor = cases + "lalanne_three_discs";
        const std::vector<std::vector<std::string>> commands{
            {"show", rotor},
            {"critical", rotor},
            {"campbell", rotor, "--set", "speeds.count=5"},
            {"response", rotor, "--set", "speeds.count=5"},
            {"stability", cases + "overhung_cross_coupled", "--set", "speeds.count=5"},
            {"modes", cases + "friswell_5_9_1", "--set", "speeds.count=1"},
            {"balance", cases + "rigid_limit"},
            {"samples", cases + "uncertain_jeffcott", "--set", "samples.count=5"},
            {"simulate", cases + "runup_jeffcott", "--set", "simulate.time=2", "--set",
             "simulate.output_points=400"}};
        std::vector<Json> out;
        for (const auto &command : commands)
            out.push_back(result_of(command));
        return out;
    }

    [[nodiscard]] whirl::report::ComparedResult read(const std::string &text) const {
        const fs::path file = folder / "result.json";
        std::ofstream(file, std::ios::binary) << text;
        return whirl::report::read_result(file);
    }
    /// Numbers and picture of two results. @returns its numbers
    static std::vector<double> compared(const whirl::report::ComparedResult &a,
                                        const whirl::report::ComparedResult &b) {
        const whirl::report::Comparison comparison = whirl::report::compare({a, b});
        const auto units = whirl::report::Units::of_readers({});
        (void)whirl::report::chart_figure(whirl::report::comparison_chart(comparison, units), {},
                                          units);
        std::vector<double> out;
        for (const whirl::report::Difference &at : comparison.differences.front())
            for (const auto &value : {at.first_value, at.other_value, at.error})
                out.push_back(value.value_or(NAN));
        return out;
    }
    /// What is said of a result that is refused; "accepted" otherwise.
    [[nodiscard]] std::string said_of(const std::string &text,
                                      const whirl::report::ComparedResult &whole) const {
        try {
            (void)compared(whole, read(text));
        } catch (const whirl::model::BadInput &error) {
            return error.what();
        }
        return "accepted";
    }
};

bool same(const std::vector<double> &a, const std::vector<double> &b) {
    return std::ranges::equal(
        a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// "modes[2].frequency[0]" of "/modes/2/frequency/0".
std::string path_of(const std::string &pointer) {
    std::string out;
    std::size_t at = 1;
    while (at <= pointer.size()) {
        const std::size_t end = std::min(pointer.find('/', at), pointer.size());
        const std::string part = pointer.substr(at, end - at);
        out += part.find_first_not_of("0123456789") == std::string::npos ? "[" + part + "]"
               : out.empty()                                             ? part
                                                                         : "." + part;
        at = end + 1;
    }
    return out;
}

/// A number that a comparison depends on is asked for as a number: found by changing it.
TEST_F(CompareDamage, EveryNumberThatIsComparedIsChecked) {
    std::mt19937 random(3);
    for (const Json &result : results()) {
        const std::string command = result.at("command");
        const whirl::report::ComparedResult whole = read(result.dump());
        const std::vector<double> numbers = compared(whole, whole);
        EXPECT_FALSE(numbers.empty()) << command;
        // Two of each kind of place: "modes[*].frequency[*]".
        std::vector<std::string> leaves;
        std::map<std::string, int> of_kind;
        const Json flat = result.flatten();
        std::vector<std::string> all;
        for (const auto &[pointer, value] : flat.items())
            if (value.is_number())
                all.push_back(pointer);
        std::ranges::shuffle(all, random);
        for (const std::string &pointer : all) {
            std::string kind = pointer;
            std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
            if (++of_kind[kind] <= 2)
                leaves.push_back(pointer);
        }
        int depended = 0;
        for (const std::string &leaf : leaves) {
            Json changed = result;
            Json &value = changed.at(Pointer(leaf));
            value = value.get<double>() * 1.25 + 1;
            std::vector<double> other;
            try {
                other = compared(whole, read(changed.dump()));
            } catch (const whirl::model::BadInput &) {
                continue; // a place in a list, a multiple: checked closer than by its kind
            }
            if (same(numbers, other))
                continue;
            ++depended;
            for (const Json &wrong : {Json("NaN"), Json::array()}) {
                value = wrong;
                const std::string said = said_of(changed.dump(), whole);
                EXPECT_NE(said.find("result.json: " + path_of(leaf) + ": expected a number"),
                          std::string::npos)
                    << command << " " << leaf << ": " << said;
            }
            // Its key, or the entry of a list that another one goes with.
            Json &around = changed.at(Pointer(leaf).parent_pointer());
            if (around.is_object())
                around.erase(Pointer(leaf).back());
            else
                around.erase(std::stoul(Pointer(leaf).back()));
            EXPECT_NE(said_of(changed.dump(), whole), "accepted") << command << " " << leaf;
        }
        EXPECT_GT(depended, 0) << command;
    }
}

TEST_F(CompareDamage, AccidentsAreRefusedOrCompared) {
    std::mt19937 random(11);
    const auto below = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    int refused = 0;
    int number = 0;
    for (const Json &result : results()) {
        const std::string text = result.dump();
        const whirl::report::ComparedResult whole = read(text);
        for (int i = 0; i < 25; ++i, ++number) {
            std::string damaged = text;
            const std::size_t at = below(text.size());
            switch (below(5)) {
            case 0:
                damaged.resize(at);
                break;
            case 1:
                damaged.erase(at, 1 + below(60));
                break;
            case 2:
                damaged[at] = static_cast<char>(below(256));
                break;
            case 3:
                damaged.insert(at, text.substr(below(text.size()), below(60)));
                break;
            default: // a key of the result goes
                Json less = result;
                auto key = less.begin();
                std::advance(key, static_cast<std::ptrdiff_t>(below(less.size())));
                less.erase(key);
                damaged = less.dump();
            }
            std::string said;
            ASSERT_NO_THROW(said = said_of(damaged, whole)) << damaged;
            refused += said == "accepted" ? 0 : 1;
        }
    }
    EXPECT_GT(refused, number / 2);
}

TEST_F(CompareDamage, OtherKindsOfFilesAreNamed) {
    const Json critical = result_of({"critical", cases + "friswell_5_9_1"});
    const whirl::report::ComparedResult whole = read(critical.dump());
    const auto with = [&](const std::string &pointer, const Json &value) {
        Json changed = critical;
        changed[Pointer(pointer)] = value;
        return said_of(changed.dump(), whole);
    };
    const auto says = [](const std::string &said, const char *part) {
        EXPECT_NE(said.find(part), std::string::npos) << said;
    };
    says(with("/command", "response"), "speeds: missing in a result of this command");
    says(with("/command", "show"), "mass: missing");
    says(with("/command", "accuracy"), "expected results of one command");
    says(with("/command", 7), "expected a result that whirl wrote");
    says(with("/format", 2), "expected a result that whirl wrote");
    says(with("/program", "x"), "expected a result that whirl wrote");
    says(with("/units", Json::object()), "--json-units");
    says(with("/provenance", "gone"), "provenance: expected an object, got \"gone\"");
    says(with("/provenance/date", 3), "provenance.date: expected a text, got 3");
    says(with("/order", "four"), "order: expected a number or null");
    says(with("/critical_speeds", Json::object()),
         "critical_speeds: expected a list, got an object");
    says(with("/critical_speeds/1", nullptr), "critical_speeds[1]: expected an object, got null");
    says(with("/critical_speeds/0/whirl", nullptr), "critical_speeds[0].whirl: expected a text");
    std::string deep = critical.dump();
    deep.insert(1, "\"x\": " + std::string(100000, '[') + std::string(100000, ']') + ",");
    says(said_of(deep, whole), "expected a result that whirl wrote");
    says(said_of(critical.dump().substr(0, 500), whole), "expected a result that whirl wrote");
    says(said_of("", whole), "expected a result that whirl wrote");
    for (const char *path : {"/dev/null", "/tmp", "/nowhere/at/all.json"})
        EXPECT_THROW((void)whirl::report::read_result(path), whirl::model::BadInput) << path;
}

} // namespace
} // namespace compare_damage_test

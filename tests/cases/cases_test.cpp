// Runs the program on every folder of cases/ and compares with its expected.json, check by check.

#include "program_run.h"
#include "support/case_names.h"
#include "support/schema.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One entry of "checks" in an expected.json.
struct Check {
    std::string case_name;
    int number = 0; ///< in the file, from 1
    json entry;
};

void PrintTo(const Check &check, std::ostream *out) {
    *out << check.entry.value("source", "no source");
}

/// The list of checks of a case; empty where the file is missing or not as it should be.
json checks_of(const std::string &case_name) {
    std::ifstream file(fs::path(WHIRL_ROOT) / "cases" / case_name / "expected.json");
    const json content = json::parse(file, nullptr, false);
    const bool good = content.is_object() && content.contains("checks");
    return good ? content["checks"] : json::array();
}

std::vector<Check> all_checks() {
    std::vector<Check> all;
    for (const std::string &name : whirl::tests::case_names()) {
        int number = 0;
        for (const json &entry : checks_of(name))
            all.push_back({name, ++number, entry});
    }
    return all;
}

/// Size of a unit of expected.json in SI and radians.
double unit_size(const std::string &unit) {
    if (unit == "Hz")
        return 2 * std::numbers::pi;
    if (unit == "rpm")
        return std::numbers::pi / 30;
    if (unit == "rad/s" || unit == "1/s" || unit == "1" || unit == "m/s" || unit == "rad" ||
        unit == "m" || unit == "N" || unit == "N/m" || unit == "m/N" || unit == "%" ||
        unit == "1/kg" || unit == "kg m2" || unit == "kg m")
        return 1;
    throw std::runtime_error("unit of expected.json not known: " + unit);
}

/// One number of every mode at the first speed, in the order of their frequencies. Modes without
/// a frequency there (overdamped) are left out.
std::vector<double> of_modes(const json &result, const std::string &path) {
    std::vector<std::pair<double, double>> pairs;
    for (const json &mode : result.at("modes")) {
        const json &frequency = mode.at("frequency").at(0);
        if (frequency.is_null())
            continue;
        const auto omega = frequency.get<double>();
        if (path == "frequencies")
            pairs.emplace_back(omega, omega);
        else if (path == "natural_frequencies") // modulus of the eigenvalue
            pairs.emplace_back(omega, std::hypot(omega, mode.at("real").at(0).get<double>()));
        else
            pairs.emplace_back(omega, mode.at(path).at(0).get<double>());
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<double> values;
    for (const auto &pair : pairs)
        values.push_back(pair.second);
    return values;
}

std::vector<double> crossing_speeds(const json &result, double multiple) {
    std::vector<double> speeds;
    for (const json &crossing : result.at("crossings"))
        if (std::abs(crossing.at("multiple").get<double>() - multiple) < 1e-12)
            speeds.push_back(crossing.at("speed").get<double>());
    std::sort(speeds.begin(), speeds.end());
    return speeds;
}

/// Amplitude or semi-axis of the orbit at z (m) at the first speed.
std::vector<double> at_node(const json &result, const std::string &path, double z) {
    for (const json &node : result.at("nodes"))
        if (std::abs(node.at("z").get<double>() - z) < 1e-9)
            return {node.at(path).at(0).get<double>()};
    throw std::runtime_error("no node at z = " + std::to_string(z));
}

/// Of every peak of the station at z: its speed (rad/s) or its value (m).
std::vector<double> peaks_at(const json &result, const char *key, double z) {
    std::vector<double> out;
    for (const json &peak : result.at("peaks"))
        if (peak.at("of") == "station" && std::abs(peak.at("z").get<double>() - z) < 1e-9)
            out.push_back(peak.at(key).get<double>());
    return out;
}

/// Motion under the weight of the station at z at the first speed.
std::vector<double> under_weight(const json &result, const std::string &path, double z) {
    for (const json &station : result.at("gravity").at("stations"))
        if (std::abs(station.at("z").get<double>() - z) < 1e-9)
            return {station.at(path).at(0).get<double>()};
    throw std::runtime_error("no station at z = " + std::to_string(z));
}

std::vector<double> critical_speeds(const json &result) {
    std::vector<double> speeds;
    for (const json &critical : result.at("critical_speeds"))
        speeds.push_back(critical.at("speed").get<double>());
    return speeds;
}

/// All numbers at a JSON pointer, in order.
void collect_numbers(const json &value, std::vector<double> &numbers) {
    if (value.is_number())
        numbers.push_back(value.get<double>());
    else
        for (const json &item : value)
            collect_numbers(item, numbers);
}

/// The numbers of a result that a check speaks of, SI and radians.
std::vector<double> found_values(const json &result, const json &entry) {
    const auto path = entry.at("path").get<std::string>();
    if (path.front() == '/') {
        std::vector<double> numbers;
        collect_numbers(result.at(json::json_pointer(path)), numbers);
        return numbers;
    }
    if (path == "critical_speeds")
        return critical_speeds(result);
    if (path == "crossings")
        return crossing_speeds(result, entry.at("multiple"));
    if (path == "peak_speeds" || path == "peak_values")
        return peaks_at(result, path == "peak_speeds" ? "speed" : "value", entry.at("node"));
    if (path == "twice_peak_speeds" || path == "twice_peak_values")
        return peaks_at(result.at("gravity"), path == "twice_peak_speeds" ? "speed" : "value",
                        entry.at("node"));
    if (path == "static" || path == "twice")
        return under_weight(result, path, entry.at("node"));
    if (path == "amplitude" || path == "major" || path == "minor")
        return at_node(result, path, entry.at("node"));
    return of_modes(result, path);
}

struct Run {
    json result;
    std::string broken_rules; ///< of docs/schema
};

/// The run of a check's command; checks of one command with the same settings share it.
const Run &run_whirl(const Check &check) {
    std::vector<std::string> arguments{check.entry.at("command"),
                                       std::string(WHIRL_ROOT "/cases/") + check.case_name,
                                       "--quiet", "--json"};
    for (const json &setting : check.entry.at("set")) {
        arguments.emplace_back("--set");
        arguments.push_back(setting);
    }
    static std::map<std::vector<std::string>, Run> runs;
    if (const auto known = runs.find(arguments); known != runs.end())
        return known->second;
    const std::vector<std::string> key = arguments;
    const std::string scratch =
        testing::TempDir() + "whirl_" + check.case_name + "_" + std::to_string(check.number);
    arguments.insert(arguments.end(), {"--out", scratch});
    const auto run = whirl::tests::run_program(WHIRL_PROGRAM, arguments, scratch + ".err");
    fs::remove_all(scratch);
    fs::remove(scratch + ".err");
    if (run.status != 0)
        throw std::runtime_error("exit status " + std::to_string(run.status) + "\n" + run.errors);
    const json result = json::parse(run.output);
    return runs[key] = {result, whirl::tests::broken_rules_of_result(result)};
}

/// Letters and digits as GoogleTest allows them in a name.
std::string name_of(std::string path) {
    for (char &letter : path)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0)
            letter = '_';
    return path;
}

class CaseCheck : public testing::TestWithParam<Check> {};

TEST_P(CaseCheck, agrees) {
    const json &entry = GetParam().entry;
    const auto &[result, broken_rules] = run_whirl(GetParam());
    EXPECT_EQ(broken_rules, "") << "docs/schema";
    if (entry.contains("text")) {
        const auto path = entry.at("path").get<std::string>();
        const json &found = result.at(json::json_pointer(path));
        const json &text = entry.at("text");
        if (text.is_array()) // any of these
            EXPECT_NE(std::find(text.begin(), text.end(), found), text.end())
                << found << "; " << entry.at("source");
        else
            EXPECT_EQ(found, text) << entry.at("source");
        return;
    }
    const std::vector<double> found = found_values(result, entry);
    const std::vector<double> expected = entry.at("values");
    const double unit = unit_size(entry.at("unit"));
    const double relative = entry.at("relative_tolerance");
    const double absolute = entry.value("absolute_tolerance", 0.0);
    ASSERT_FALSE(expected.empty());
    ASSERT_GE(found.size(), expected.size()) << entry.at("source");
    // Of a list of bands or eigenvalues there must not be more than expected.
    if (entry.value("path", std::string("none")).front() == '/') {
        ASSERT_EQ(found.size(), expected.size()) << entry.at("source");
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(found[i] / unit, expected[i], relative * std::abs(expected[i]) + absolute)
            << "value " << i + 1 << " in " << entry.at("unit")
            << ", source: " << entry.at("source");
    const auto whirl = entry.value("whirl", std::vector<std::string>{});
    for (std::size_t i = 0; i < whirl.size(); ++i)
        EXPECT_EQ(result.at("critical_speeds").at(i).at("whirl"), whirl[i]) << "value " << i + 1;
}

INSTANTIATE_TEST_SUITE_P(Cases, CaseCheck, testing::ValuesIn(all_checks()), [](const auto &test) {
    const Check &check = test.param;
    return check.case_name + "_check_" + std::to_string(check.number) + "_" +
           name_of(check.entry.value("path", std::string("none")));
});

class CaseFolder : public testing::TestWithParam<std::string> {};

TEST_P(CaseFolder, is_complete) {
    const fs::path folder = fs::path(WHIRL_ROOT) / "cases" / GetParam();
    EXPECT_TRUE(fs::exists(folder / "case.toml"));
    EXPECT_TRUE(fs::exists(folder / "README.md"));
    const json checks = checks_of(GetParam());
    EXPECT_FALSE(checks.empty()) << "no expected.json with checks";
    for (const json &entry : checks) {
        EXPECT_FALSE(entry.at("source").get<std::string>().empty());
        const auto kind = entry.at("kind").get<std::string>();
        EXPECT_TRUE(kind == "published" || kind == "computed" || kind == "exact") << kind;
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, CaseFolder, testing::ValuesIn(whirl::tests::case_names()),
                         [](const auto &test) { return test.param; });

} // namespace

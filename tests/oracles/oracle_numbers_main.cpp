// Regenerates the exact and computed numbers of cases/*/expected.json by the oracles and prints
// how far the two are apart:
//   oracle_numbers [--published] [CASE ...]
// Exit status 1 where a difference is above the check's tolerance or, for exact numbers, above
// half a unit of the last digit printed. Nothing of the program is used.

#include "oracles/answers.h"
#include "oracles/case_values.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace whirl::oracles;

struct Totals {
    int checks = 0;
    int regenerated = 0;
    int failed = 0;
    std::vector<std::string> not_regenerated;
    double worst_share = 0; ///< of what is allowed
    std::string worst;
};

/// Half a unit of the last digit of a number as JSON prints it.
double half_unit(double value) {
    std::array<char, 64> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific);
    const std::string digits(text.data(), end.ptr);
    const auto exponent = digits.find('e');
    const auto point = digits.find('.');
    const auto decimals = point == std::string::npos ? 0 : exponent - point - 1;
    return 0.5 *
           std::pow(10.0, std::atof(digits.c_str() + exponent + 1) - static_cast<double>(decimals));
}

/// Largest difference that a check allows at a value.
double allowed(const json &check, double expected) {
    const double tolerance = check.at("relative_tolerance").get<double>() * std::abs(expected) +
                             check.value("absolute_tolerance", 0.0);
    if (check.at("kind") != "exact")
        return tolerance;
    // Below 1e-13 the double of the expected number is itself rounded; half an even digit is a tie
    return std::min(tolerance, std::max(1.001 * half_unit(expected), 1e-13 * std::abs(expected)) +
                                   check.value("absolute_tolerance", 0.0));
}

std::string label(const std::string &name, int number) {
    return name + " " + std::to_string(number);
}

void print_line(const std::string &what, const std::string &quantity, const std::string &values) {
    std::printf("%-28s %-44s %s\n", what.c_str(), quantity.c_str(), values.c_str());
}

/// One line a value; whether all are within what is allowed.
bool compare_values(const json &check, const Answer &found, const std::string &name, int number,
                    Totals &totals) {
    const std::vector<double> expected = check.at("values");
    const auto path = check.at("path").get<std::string>();
    const double unit = size_of_unit(check.at("unit"));
    bool good = found.values.size() >= expected.size() &&
                (path.front() != '/' || found.values.size() == expected.size());
    if (!good)
        std::printf("%s: %zu values, expected %zu\n", label(name, number).c_str(),
                    found.values.size(), expected.size());
    for (std::size_t i = 0; i < std::min(expected.size(), found.values.size()); ++i) {
        const auto oracle = static_cast<double>(found.values[i] / unit);
        const double difference = std::abs(oracle - expected[i]);
        const double limit = allowed(check, expected[i]);
        const double scale = expected[i] == 0 ? 1 : std::abs(expected[i]);
        const double share = limit > 0 ? difference / limit : difference;
        const bool within = difference <= limit;
        good = good && within;
        if (share > totals.worst_share) {
            totals.worst_share = share;
            totals.worst = label(name, number);
        }
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(), "%-20.15g %-20.15g %8.1e %8.1e%s", expected[i],
                      oracle, difference / scale, limit / scale, within ? "" : "  DIFFERS");
        print_line(i == 0 ? label(name, number) : "", i == 0 ? path : "", text.data());
    }
    const auto whirl = check.value("whirl", std::vector<std::string>{});
    if (!found.whirl.empty() && !std::equal(whirl.begin(), whirl.end(), found.whirl.begin())) {
        std::printf("%s: senses of whirl differ\n", label(name, number).c_str());
        good = false;
    }
    return good;
}

/// A word: what the motion ends in. "whirling" and "lagging" are both motions that do not settle.
bool compare_text(const json &check, const Answer &found, const std::string &name, int number) {
    const json &text = check.at("text"); // or a list of those that are right
    const auto expected = (text.is_array() ? text.front() : text).get<std::string>();
    const bool restless = found.text == "whirling" || found.text == "lagging";
    const bool good =
        found.text == expected || (restless && (expected == "whirling" || expected == "lagging"));
    print_line(label(name, number), check.at("path"),
               expected + "  " + found.text + (good ? "" : "  DIFFERS"));
    return good;
}

void regenerate(const json &check, const std::string &name, const fs::path &folder, int number,
                Totals &totals) {
    ++totals.checks;
    try {
        Request request;
        request.rotor = read_case((folder / "case.toml").string(), check.at("set"));
        request.command = check.at("command");
        request.path = check.at("path");
        request.multiple = check.value("multiple", 1.0);
        request.node = check.value("node", 0.0);
        request.wanted = check.contains("values") ? check.at("values").size() : 0;
        const Answer found = answer(request);
        const bool good = check.contains("text")
                              ? compare_text(check, found, name, number)
                              : compare_values(check, found, name, number, totals);
        std::printf("    %s: %s\n", check.at("kind").get<std::string>().c_str(),
                    found.oracle.c_str());
        ++totals.regenerated;
        totals.failed += good ? 0 : 1;
    } catch (const std::exception &error) {
        totals.not_regenerated.push_back(label(name, number) + " " +
                                         check.at("path").get<std::string>() + ": " + error.what());
    }
}

void regenerate_case(const fs::path &folder, bool published, Totals &totals) {
    std::ifstream file(folder / "expected.json");
    const json content = json::parse(file);
    int number = 0;
    for (const json &check : content.at("checks")) {
        ++number;
        if (published || check.at("kind") != "published")
            regenerate(check, folder.filename().string(), folder, number, totals);
    }
}

std::vector<fs::path> folders_of(const std::vector<std::string> &names) {
    const fs::path root = fs::path(WHIRL_ROOT) / "cases";
    std::vector<fs::path> out;
    for (const auto &item : fs::directory_iterator(root))
        if (item.is_directory() &&
            (names.empty() ||
             std::find(names.begin(), names.end(), item.path().filename()) != names.end()))
            out.push_back(item.path());
    std::sort(out.begin(), out.end());
    if (out.size() < names.size())
        throw std::runtime_error("no such case");
    return out;
}

int run(const std::vector<std::string> &arguments) {
    std::vector<std::string> names = arguments;
    const bool published = std::erase(names, "--published") > 0;
    Totals totals;
    std::printf("%-28s %-44s %-20s %-20s %8s %8s\n", "case, check", "quantity", "expected",
                "oracle", "relative", "allowed");
    for (const fs::path &folder : folders_of(names))
        regenerate_case(folder, published, totals);
    for (const std::string &reason : totals.not_regenerated)
        std::printf("not regenerated: %s\n", reason.c_str());
    std::printf("%d of %d checks regenerated, %d differ; nearest to its limit: %s, %.2g of it\n",
                totals.regenerated, totals.checks, totals.failed, totals.worst.c_str(),
                totals.worst_share);
    return totals.failed > 0 ? 1 : 0;
}

} // namespace

int main(int argc, char **argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception &error) {
        std::fprintf(stderr, "oracle_numbers: %s\n", error.what());
        return 2;
    }
}

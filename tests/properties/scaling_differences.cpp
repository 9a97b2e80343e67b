#include "properties/scaling.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <set>

namespace whirl::properties {

namespace {

using nlohmann::ordered_json;

/// Numbers out, lines and gaps of tables to one of each: columns grow with their numbers.
std::string words_of(const std::string &text) {
    static const std::regex number(R"([-+−]?(\d+(\.\d+)?|\.\d+)([eE][-+]?\d+)?)");
    static const std::regex gap(R"([ \t]+)");
    static const std::regex line("(-|─|═|_)+");
    std::string out = std::regex_replace(text, number, "#");
    out = std::regex_replace(out, gap, " ");
    return std::regex_replace(out, line, "-");
}

/// First line in which two texts differ.
std::string first_difference(const std::string &a, const std::string &b) {
    std::size_t i = 0;
    while (i < a.size() && i < b.size() && a[i] == b[i])
        ++i;
    if (i == a.size() && i == b.size())
        return {};
    const std::size_t from = a.rfind('\n', i) == std::string::npos ? 0 : a.rfind('\n', i) + 1;
    const auto line = [from](const std::string &s) {
        return from < s.size() ? s.substr(from, s.find('\n', from) - from) : std::string();
    };
    return fmt::format("\"{}\" becomes \"{}\"", line(a), line(b));
}

/// Wall time and date, and errors, whose share of rounding is itself rounding.
bool left_out(const std::string &key) {
    static const std::set<std::string> keys{
        "seconds",          "residual", "version",          "rounding",   "name",
        "forward_fraction", "steps",    "rate_evaluations", "provenance", "defect"};
    return keys.count(key) > 0 || key.find("error") != std::string::npos;
}

/// Walks through two results; what it finds is told once for each key.
class Comparison {
  public:
    explicit Comparison(double digits) : _digits(digits) {}

    std::vector<std::string> found;

    void compare(const ordered_json &a, const ordered_json &b, const std::string &path) {
        if (a.type() != b.type() && !(a.is_number() && b.is_number())) {
            tell(path,
                 fmt::format("{} becomes {}", a.dump().substr(0, 60), b.dump().substr(0, 60)));
        } else if (a.is_object()) {
            if (a.size() != b.size())
                tell(path, "other keys");
            // Rows with a unit of their own: named, or that of what they are rows of.
            std::string of = path;
            for (const char *key : {"unit", "of"})
                if (a.contains(key))
                    of += "/" + a.at(key).dump();
            for (const auto &[key, value] : a.items()) {
                if (left_out(key))
                    continue;
                if (!b.contains(key))
                    tell(path, "no " + key);
                else
                    compare(value, b.at(key), of + "/" + key);
            }
        } else if (a.is_array()) {
            compare_lists(a, b, path);
        } else if (a.is_string()) {
            const std::string difference =
                first_difference(words_of(a.get<std::string>()), words_of(b.get<std::string>()));
            if (!difference.empty())
                tell(path, difference);
        } else if (a.is_number()) {
            compare_numbers(a.get<double>(), b.get<double>(), std::abs(a.get<double>()), path);
        } else if (a != b) {
            tell(path, "another value");
        }
    }

  private:
    double _digits;
    std::map<std::string, int> _powers; ///< of two, between the numbers of a key
    std::set<std::string> _told;

    void tell(const std::string &path, const std::string &what) {
        if (_told.insert(path).second)
            found.push_back(path + ": " + what);
    }

    void compare_lists(const ordered_json &a, const ordered_json &b, const std::string &path) {
        if (a.size() != b.size()) {
            tell(path, fmt::format("{} entries become {}: {} / {}", a.size(), b.size(),
                                   a.dump().substr(0, 150), b.dump().substr(0, 150)));
            return;
        }
        // Small beside its neighbours a number is rounding of theirs.
        static const std::regex shape(".*/[xy]_(real|imag)"); // scaled to 1 over both planes
        double largest = std::regex_match(path, shape) ? 1 : 0;
        for (const ordered_json &item : a)
            if (item.is_number())
                largest = std::max(largest, std::abs(item.get<double>()));
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (a[i].is_number() && b[i].is_number())
                compare_numbers(a[i].get<double>(), b[i].get<double>(), largest, path);
            else
                compare(a[i], b[i], path);
        }
    }

    void compare_numbers(double a, double b, double size, const std::string &path) {
        if (a == 0 && b == 0)
            return;
        const auto known = _powers.find(path);
        if (known != _powers.end()) {
            if (std::abs(std::ldexp(a, known->second) - b) >
                _digits * std::ldexp(size, known->second))
                tell(path, fmt::format("{:.12g} becomes {:.12g} in the old unit", a,
                                       std::ldexp(b, -known->second)));
            return;
        }
        if (std::abs(a) < 1e-6 * size)
            return; // no power to be learnt from rounding
        const double power = std::log2(std::abs(b / a));
        if (a * b <= 0 || !(std::abs(power - std::round(power)) < 2 * _digits)) {
            tell(path, fmt::format("{:.12g} becomes {:.12g}, 2^{:.9g} times", a, b, power));
            return;
        }
        _powers[path] = static_cast<int>(std::round(power));
    }
};

} // namespace

std::vector<std::string> scaling_differences(const CommandOutput &here, const CommandOutput &there,
                                             double digits) {
    if (!here.refusal.empty() || !there.refusal.empty()) {
        const std::string difference =
            first_difference(words_of(here.refusal), words_of(there.refusal));
        return difference.empty() ? std::vector<std::string>{}
                                  : std::vector<std::string>{"answer: " + difference};
    }
    Comparison comparison(digits);
    comparison.compare(ordered_json::parse(here.json), ordered_json::parse(there.json), "");
    const std::string difference = first_difference(words_of(here.text), words_of(there.text));
    if (!difference.empty())
        comparison.found.push_back("text: " + difference);
    return comparison.found;
}

} // namespace whirl::properties

#include "report/compare/check.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace whirl::report {

namespace {

/// What is read of a result of each command: a path and what is there, a text, a number, or with a
/// question mark a number or null. A key with a question mark may be missing or null; a list in
/// brackets has as many entries as is said there, by number or by the name of a list around it.
const std::map<std::string, std::vector<std::string_view>> rules_of_commands{
    {"critical",
     {"critical_speeds[].speed number", "critical_speeds[].whirl text",
      "critical_speeds[].error number?"}},
    {"campbell",
     {"speeds[] number", "modes[].label text", "modes[].frequency[speeds] number?",
      "modes[].error[speeds] number?", "crossings[].mode number", "crossings[].multiple number",
      "crossings[].speed number"}},
    {"response",
     {"speeds[] number", "nodes[].amplitude[speeds] number?", "nodes[].name text",
      "nodes[].z number?", "curves.speeds[] number", "curves.nodes[].amplitude[speeds] number?",
      "peaks[].of text", "peaks[].name text", "peaks[].z number?", "peaks[].speed number?",
      "peaks[].speed_error number?", "peaks[].value number?", "peaks[].error number?"}},
    {"stability",
     {"speeds[] number", "growth[speeds] number?", "unstable[][2] number?",
      "unstable_error[unstable][2] number?", "level1?.critical_cross_coupling number?",
      "level1?.error number?", "level1?.log_dec[] number?"}},
    {"balance",
     {"planes[].name text", "planes[].z number?", "planes[].bands[][2] number?",
      "planes[].band_errors[bands][2] number?", "joint?.bands[][2] number?",
      "joint?.band_errors[bands][2] number?"}},
    {"modes", {"modes[].label? text", "modes[].frequency number?", "modes[].error? number?"}},
    {"show",
     {"mass number?", "shaft_mass number?", "center_of_mass number?", "length number?",
      "Id number?", "Ip number?"}},
    {"samples",
     {"answers[].of text", "answers[].name text", "answers[].unit text",
      "answers[].nominal number?", "answers[].nominal_error number?", "answers[].mean number?",
      "answers[].mean_error number?", "answers[].deviation number?",
      "answers[].deviation_error number?"}},
    {"simulate",
     {"residual_ratio number?", "balancers[].name text", "balancers[].z number?",
      "balancers[].amplitude number?", "stations[].name text", "stations[].z number?",
      "stations[].peak number?", "stations[].peak_speed number?", "stations[].amplitude number?",
      "series.time[] number", "series.amplitude[][time] number?"}}};

/// Of every command.
constexpr std::string_view common_rules[] = {"case text",
                                             "title text",
                                             "order number?",
                                             "elements number?",
                                             "provenance.date text",
                                             "provenance.case text",
                                             "provenance.set?[] text"};

/// Holds a result that was read from a file against rules.
class Checker {
  public:
    /// @param name  of the file
    Checker(const Json &result, const std::string &name) : _around{&result}, _name(name) {}

    void check(std::string_view rule) {
        const std::size_t blank = rule.find(' ');
        _type = rule.substr(blank + 1);
        walk(rule.substr(0, blank), "");
    }

    [[noreturn]] void refuse(const Json &json, const std::string &path,
                             const std::string &expected) const {
        constexpr std::size_t longest = 40;
        std::string got = json.is_object() ? "an object"
                          : json.is_array()
                              ? fmt::format("a list of {}", json.size())
                              : json.dump(-1, ' ', false, Json::error_handler_t::replace);
        if (got.size() > longest)
            got = got.substr(0, longest) + "...";
        throw model::BadInput(
            fmt::format("{}: {}: expected {}, got {}", _name, path, expected, got));
    }

  private:
    std::vector<const Json *> _around; ///< from the result inwards, last what is looked at
    const std::string &_name;
    std::string_view _type;

    /// @param rest  of the path, from what is looked at on
    void walk(std::string_view rest, const std::string &path) {
        const Json &here = *_around.back();
        if (rest.empty())
            check_type(here, path);
        else if (rest.starts_with('['))
            walk_list(here, rest, path);
        else
            walk_key(here, rest.substr(rest.starts_with('.') ? 1 : 0), path);
    }

    void walk_into(const Json &json, std::string_view rest, const std::string &path) {
        _around.push_back(&json);
        walk(rest, path);
        _around.pop_back();
    }

    void walk_list(const Json &list, std::string_view rest, const std::string &path) {
        if (!list.is_array())
            refuse(list, path, "a list");
        const std::size_t end = rest.find(']');
        const std::string like(rest.substr(1, end - 1));
        if (const std::size_t count = count_like(like, list.size()); list.size() != count)
            refuse(list, path, fmt::format("a list of {} like {}", count, like));
        for (std::size_t i = 0; i < list.size(); ++i)
            walk_into(list[i], rest.substr(end + 1), fmt::format("{}[{}]", path, i));
    }

    void walk_key(const Json &object, std::string_view rest, const std::string &path) {
        if (!object.is_object())
            refuse(object, path, "an object");
        const std::size_t end = std::min(rest.find_first_of(".[?"), rest.size());
        const std::string key(rest.substr(0, end));
        rest.remove_prefix(end);
        const bool may_be_missing = rest.starts_with('?');
        const std::string own = path.empty() ? key : path + "." + key;
        const auto found = object.find(key);
        if (may_be_missing && (found == object.end() || found->is_null()))
            return;
        if (found == object.end())
            throw model::BadInput(
                fmt::format("{}: {}: missing in a result of this command", _name, own));
        walk_into(*found, rest.substr(may_be_missing ? 1 : 0), own);
    }

    /// @param otherwise  without a number and a name
    [[nodiscard]] std::size_t count_like(const std::string &like, std::size_t otherwise) const {
        if (like == "2")
            return 2;
        for (auto around = _around.rbegin(); around != _around.rend(); ++around)
            if ((*around)->is_object() && (*around)->contains(like))
                return (*around)->at(like).size();
        return otherwise;
    }

    void check_type(const Json &json, const std::string &path) const {
        if (_type == "text" && !json.is_string())
            refuse(json, path, "a text");
        if (_type == "number" && !json.is_number())
            refuse(json, path, "a number");
        if (_type == "number?" && !json.is_number() && !json.is_null())
            refuse(json, path, "a number or null");
    }
};

/// What crossings name: modes by their places, from 0, and multiples above 0.
void check_crossings(const Json &result, const Checker &checker) {
    const std::size_t modes = result.at("modes").size();
    for (std::size_t i = 0; const Json &crossing : result.at("crossings")) {
        const Json &mode = crossing.at("mode");
        const Json &multiple = crossing.at("multiple");
        const std::string path = fmt::format("crossings[{}]", i++);
        if (!(mode >= 0 && mode < static_cast<double>(modes)))
            checker.refuse(mode, path + ".mode",
                           fmt::format("the place of one of {} modes, from 0", modes));
        if (!(multiple > 0))
            checker.refuse(multiple, path + ".multiple", "a number greater than 0");
    }
}

} // namespace

void check_result(const Json &json, const std::string &name) {
    Checker checker(json, name);
    for (const std::string_view rule : common_rules)
        checker.check(rule);
    const std::string command = json.at("command").get<std::string>();
    // Commands that nothing is compared of are refused by name.
    if (const auto rules = rules_of_commands.find(command); rules != rules_of_commands.end())
        for (const std::string_view rule : rules->second)
            checker.check(rule);
    if (command == "campbell")
        check_crossings(json, checker);
    if (command == "response")
        if (const Json &curves = json.at("curves");
            !curves.at("speeds").empty() && curves.at("nodes").size() != json.at("nodes").size())
            checker.refuse(curves.at("nodes"), "curves.nodes",
                           fmt::format("a list of {} like nodes", json.at("nodes").size()));
}

} // namespace whirl::report

#include "report/compare/check.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <vector>

namespace whirl::report {

namespace {

/// A value of a result that was read from a file.
class Value {
  public:
    Value(const Json &json, std::string path, const std::string &name)
        : _json(&json), _path(std::move(path)), _name(&name) {}

    [[noreturn]] void refuse(const std::string &expected) const {
        constexpr std::size_t longest = 40;
        std::string got = _json->is_object() ? "an object"
                          : _json->is_array()
                              ? fmt::format("a list of {}", _json->size())
                              : _json->dump(-1, ' ', false, Json::error_handler_t::replace);
        if (got.size() > longest)
            got = got.substr(0, longest) + "...";
        throw model::BadInput(
            fmt::format("{}: {}: expected {}, got {}", *_name, _path, expected, got));
    }

    /// An entry that must be there.
    [[nodiscard]] Value key(const char *key) const {
        if (!_json->is_object())
            refuse("an object");
        const auto found = _json->find(key);
        if (found == _json->end())
            throw model::BadInput(
                fmt::format("{}: {}: missing in a result of this command", *_name, path_of(key)));
        return {*found, path_of(key), *_name};
    }
    /// One that may be missing or null.
    [[nodiscard]] std::optional<Value> maybe(const char *key) const {
        if (!_json->is_object())
            refuse("an object");
        const auto found = _json->find(key);
        return found == _json->end() || found->is_null()
                   ? std::nullopt
                   : std::optional(Value(*found, path_of(key), *_name));
    }
    [[nodiscard]] std::vector<Value> items() const {
        if (!_json->is_array())
            refuse("a list");
        std::vector<Value> out;
        for (const Json &item : *_json)
            out.push_back({item, fmt::format("{}[{}]", _path, out.size()), *_name});
        return out;
    }

    double number() const {
        if (!_json->is_number())
            refuse("a number");
        return _json->get<double>();
    }
    void number_or_null() const {
        if (!_json->is_null() && !_json->is_number())
            refuse("a number or null");
    }
    void text() const {
        if (!_json->is_string())
            refuse("a text");
    }
    /// @param count  of entries
    void numbers(std::size_t count) const {
        const std::vector<Value> all = items();
        if (all.size() != count)
            refuse(fmt::format("a list of {}", count));
        for (const Value &value : all)
            value.number_or_null();
    }
    /// Intervals, each of two numbers; null: without end, or an error that is not known.
    std::size_t pairs() const {
        const std::vector<Value> all = items();
        for (const Value &pair : all)
            pair.numbers(2);
        return all.size();
    }

  private:
    const Json *_json;
    std::string _path;
    const std::string *_name;

    [[nodiscard]] std::string path_of(const char *key) const {
        return _path.empty() ? key : _path + "." + key;
    }
};

/// Numbers that each may be null.
void check_numbers(const Value &of, std::initializer_list<const char *> keys) {
    for (const char *key : keys)
        of.key(key).number_or_null();
}

void check_place(const Value &of) {
    of.key("name").text();
    of.key("z").number_or_null();
}

/// Spin speeds, of which none is missing.
std::size_t check_speeds(const Value &of) {
    const std::vector<Value> speeds = of.key("speeds").items();
    for (const Value &speed : speeds)
        (void)speed.number();
    return speeds.size();
}

void check_bands(const Value &of, const char *bands, const char *errors) {
    const std::size_t count = of.key(bands).pairs();
    const Value all = of.key(errors);
    if (all.pairs() != count)
        all.refuse(fmt::format("a list of {} like {}", count, bands));
}

void check_critical(const Value &result) {
    for (const Value &at : result.key("critical_speeds").items()) {
        (void)at.key("speed").number();
        at.key("whirl").text();
        at.key("error").number_or_null();
    }
}

void check_campbell(const Value &result) {
    const std::size_t speeds = check_speeds(result);
    const std::vector<Value> modes = result.key("modes").items();
    for (const Value &mode : modes) {
        mode.key("label").text();
        mode.key("frequency").numbers(speeds);
        mode.key("error").numbers(speeds);
    }
    for (const Value &crossing : result.key("crossings").items()) {
        const Value mode = crossing.key("mode");
        const double place = mode.number();
        if (!(place >= 0 && place < static_cast<double>(modes.size())))
            mode.refuse(fmt::format("the place of one of {} modes, from 0", modes.size()));
        if (!(crossing.key("multiple").number() > 0))
            crossing.key("multiple").refuse("a number greater than 0");
        (void)crossing.key("speed").number();
    }
}

/// Amplitudes of stations over speeds.
/// @returns how many stations
std::size_t check_stations(const Value &of, std::size_t speeds) {
    const std::vector<Value> nodes = of.key("nodes").items();
    for (const Value &node : nodes)
        node.key("amplitude").numbers(speeds);
    return nodes.size();
}

void check_response(const Value &result) {
    const std::size_t stations = check_stations(result, check_speeds(result));
    for (const Value &node : result.key("nodes").items())
        check_place(node);
    const Value curves = result.key("curves");
    const std::size_t dense = check_speeds(curves);
    if (dense > 0 && check_stations(curves, dense) != stations)
        curves.key("nodes").refuse(fmt::format("a list of {} like nodes", stations));
    for (const Value &peak : result.key("peaks").items()) {
        peak.key("of").text();
        check_place(peak);
        check_numbers(peak, {"speed", "speed_error", "value", "error"});
    }
}

void check_stability(const Value &result) {
    result.key("growth").numbers(check_speeds(result));
    check_bands(result, "unstable", "unstable_error");
    if (const auto level1 = result.maybe("level1")) {
        check_numbers(*level1, {"critical_cross_coupling", "error"});
        for (const Value &value : level1->key("log_dec").items())
            value.number_or_null();
    }
}

void check_balance(const Value &result) {
    for (const Value &plane : result.key("planes").items()) {
        check_place(plane);
        check_bands(plane, "bands", "band_errors");
    }
    if (const auto joint = result.maybe("joint"))
        check_bands(*joint, "bands", "band_errors");
}

void check_modes(const Value &result) {
    for (const Value &mode : result.key("modes").items()) {
        if (const auto label = mode.maybe("label"))
            label->text();
        mode.key("frequency").number_or_null();
        if (const auto error = mode.maybe("error"))
            error->number_or_null();
    }
}

void check_show(const Value &result) {
    check_numbers(result, {"mass", "shaft_mass", "center_of_mass", "length", "Id", "Ip"});
}

void check_samples(const Value &result) {
    for (const Value &answer : result.key("answers").items()) {
        for (const char *key : {"of", "name", "unit"})
            answer.key(key).text();
        check_numbers(answer, {"nominal", "nominal_error", "mean", "mean_error", "deviation",
                               "deviation_error"});
    }
}

void check_simulate(const Value &result) {
    result.key("residual_ratio").number_or_null();
    for (const Value &balancer : result.key("balancers").items()) {
        check_place(balancer);
        balancer.key("amplitude").number_or_null();
    }
    for (const Value &station : result.key("stations").items()) {
        check_place(station);
        check_numbers(station, {"peak", "peak_speed", "amplitude"});
    }
    const Value series = result.key("series");
    const std::vector<Value> times = series.key("time").items();
    for (const Value &time : times)
        (void)time.number();
    for (const Value &curve : series.key("amplitude").items())
        curve.numbers(times.size());
}

} // namespace

void check_result(const Json &json, const std::string &name) {
    static const std::map<std::string, void (*)(const Value &)> checks{
        {"critical", check_critical},   {"campbell", check_campbell}, {"response", check_response},
        {"stability", check_stability}, {"balance", check_balance},   {"modes", check_modes},
        {"show", check_show},           {"samples", check_samples},   {"simulate", check_simulate}};
    const Value result(json, "", name);
    for (const char *key : {"case", "title"})
        result.key(key).text();
    for (const char *key : {"order", "elements"})
        result.key(key).number_or_null();
    const Value provenance = result.key("provenance");
    for (const char *key : {"date", "case"})
        provenance.key(key).text();
    if (const auto set = provenance.maybe("set"))
        for (const Value &entry : set->items())
            entry.text();
    // Commands that nothing is compared of are refused by name.
    if (const auto check = checks.find(json.at("command").get<std::string>());
        check != checks.end())
        check->second(result);
}

} // namespace whirl::report

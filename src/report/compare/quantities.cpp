#include "report/compare/comparison.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace whirl::report {

namespace {

using Quantities = std::vector<ComparedNumber>;

std::optional<double> number(const Json &object, const char *key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? std::optional(found->get<double>())
                                                       : std::nullopt;
}

std::string text(const Json &object, const char *key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json &list(const Json &object, const char *key) {
    static const Json none = Json::array();
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : none;
}

/// The name of a place, or where it is.
std::string name_or_place(const Json &of) {
    const std::string name = text(of, "name");
    return name.empty() ? fmt::format("at {:.6g} m", number(of, "z").value_or(0)) : name;
}

/// With an error that is relative to the value.
void add(Quantities &all, const std::string &name, const char *unit, std::optional<double> value,
         std::optional<double> relative) {
    if (value)
        all.push_back({name, unit, *value,
                       relative ? std::optional(*relative * std::abs(*value)) : std::nullopt});
}

void of_critical(const Json &json, Quantities &all) {
    std::map<std::string, int> counted;
    for (const Json &at : list(json, "critical_speeds")) {
        const std::string whirl = text(at, "whirl");
        add(all, fmt::format("critical speed, {} {}", whirl, ++counted[whirl]), "rad/s",
            number(at, "speed"), number(at, "error"));
    }
}

/// Relative error of a crossing with `multiple` times the spin speed s by that of the frequency w
/// of its mode on either side: ds = dw / |multiple - dw/ds|.
std::optional<double> crossing_error(const Json &speeds, const Json &mode, double speed,
                                     double multiple) {
    const Json &frequency = list(mode, "frequency");
    const Json &error = list(mode, "error");
    for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
        const auto s = item(speeds, i);
        const auto next = item(speeds, i + 1);
        if (!s || !next || speed < *s || speed > *next)
            continue;
        const auto w = item(frequency, i);
        const auto w_next = item(frequency, i + 1);
        const auto e = item(error, i);
        const auto e_next = item(error, i + 1);
        if (!w || !w_next || !e || !e_next)
            return std::nullopt;
        const double closing = std::abs(multiple - (*w_next - *w) / (*next - *s));
        return closing > 0 ? std::optional(std::max(*e, *e_next) * multiple / closing)
                           : std::nullopt;
    }
    return std::nullopt;
}

void of_campbell(const Json &json, Quantities &all) {
    const Json &speeds = list(json, "speeds");
    const Json &modes = list(json, "modes");
    std::set<std::size_t> ends; // the first and the last speed
    if (!speeds.empty())
        ends = {0, speeds.size() - 1};
    for (const Json &mode : modes)
        for (const std::size_t i : ends)
            add(all,
                fmt::format("frequency of {} at {:.8g} rad/s", text(mode, "label"),
                            item(speeds, i).value_or(NAN)),
                "rad/s", item(list(mode, "frequency"), i), item(list(mode, "error"), i));
    std::map<std::string, int> counted;
    for (const Json &at : list(json, "crossings")) {
        const auto mode = static_cast<std::size_t>(number(at, "mode").value_or(0));
        if (mode >= modes.size())
            continue;
        const double multiple = number(at, "multiple").value_or(1);
        const std::string name =
            fmt::format("crossing of {} with {:g}x", text(modes[mode], "label"), multiple);
        const int again = ++counted[name];
        add(all, again > 1 ? fmt::format("{}, {}", name, again) : name, "rad/s",
            number(at, "speed"),
            crossing_error(speeds, modes[mode], number(at, "speed").value_or(NAN), multiple));
    }
}

void of_response(const Json &json, Quantities &all) {
    std::map<std::string, int> counted;
    for (const Json &peak : list(json, "peaks")) {
        const std::string of = text(peak, "of");
        const std::string place = of + " " + name_or_place(peak);
        const std::string which = fmt::format("peak {} of {}", ++counted[place], place);
        add(all, which + ", speed", "rad/s", number(peak, "speed"), number(peak, "speed_error"));
        add(all, which, of == "bearing" ? "N" : "m", number(peak, "value"), number(peak, "error"));
    }
}

/// Ends of bands; their errors are absolute.
void add_bands(const Json &bands, const Json &errors, const std::string &of, Quantities &all) {
    constexpr std::array ends{"from", "to"};
    for (std::size_t i = 0; i < bands.size(); ++i)
        for (std::size_t end = 0; end < ends.size(); ++end)
            if (const auto value = item(bands[i], end))
                all.push_back({fmt::format("{}, band {} {}", of, i + 1, ends[end]), "rad/s", *value,
                               i < errors.size() ? item(errors[i], end) : std::nullopt});
}

void of_stability(const Json &json, Quantities &all) {
    add_bands(list(json, "unstable"), list(json, "unstable_error"), "unstable", all);
    if (const auto level1 = json.find("level1"); level1 != json.end() && level1->is_object()) {
        add(all, "critical cross coupling", "N/m", number(*level1, "critical_cross_coupling"),
            number(*level1, "error"));
        add(all, "log. decrement without cross coupling", "", item(list(*level1, "log_dec"), 0),
            std::nullopt);
    }
}

/// What is left of a motion with balancers, and the largest amplitudes on the way.
void of_simulate(const Json &json, Quantities &all) {
    add(all, "residual ratio", "", number(json, "residual_ratio"), std::nullopt);
    for (const Json &balancer : list(json, "balancers"))
        add(all, fmt::format("amplitude of {} at the end", name_or_place(balancer)), "m",
            number(balancer, "amplitude"), std::nullopt);
    for (const Json &station : list(json, "stations")) {
        add(all, "peak of " + name_or_place(station), "m", number(station, "peak"), std::nullopt);
        add(all, fmt::format("peak of {}, speed", name_or_place(station)), "rad/s",
            number(station, "peak_speed"), std::nullopt);
        add(all, fmt::format("amplitude of {} at the end", name_or_place(station)), "m",
            number(station, "amplitude"), std::nullopt);
    }
}

void of_balance(const Json &json, Quantities &all) {
    for (const Json &plane : list(json, "planes"))
        add_bands(list(plane, "bands"), list(plane, "band_errors"), "plane " + name_or_place(plane),
                  all);
    if (const auto joint = json.find("joint"); joint != json.end() && joint->is_object())
        add_bands(list(*joint, "bands"), list(*joint, "band_errors"), "all planes", all);
}

void of_modes(const Json &json, Quantities &all) {
    int place = 0;
    for (const Json &mode : list(json, "modes")) {
        const std::string label = text(mode, "label");
        ++place;
        add(all, "frequency of " + (label.empty() ? fmt::format("mode {}", place) : label), "rad/s",
            number(mode, "frequency"), number(mode, "error"));
    }
}

void of_show(const Json &json, Quantities &all) {
    for (const auto &[key, name, unit] :
         {std::array{"mass", "mass", "kg"}, std::array{"shaft_mass", "mass of the shaft", "kg"},
          std::array{"center_of_mass", "centre of mass", "m"},
          std::array{"length", "length of the shaft", "m"},
          std::array{"Id", "diametral inertia", "kg m2"},
          std::array{"Ip", "polar inertia", "kg m2"}})
        add(all, name, unit, number(json, key), 0.0); // sums, not estimates
}

void of_samples(const Json &json, Quantities &all) {
    for (const Json &answer : list(json, "answers")) {
        const std::string name = text(answer, "of") + " " + text(answer, "name");
        const std::string unit = text(answer, "unit");
        const auto nominal = number(answer, "nominal");
        add(all, name + ", case as it is", unit.c_str(), nominal, number(answer, "nominal_error"));
        const auto absolute = [&](const char *key, const char *error) {
            if (const auto value = number(answer, key))
                all.push_back(
                    {fmt::format("{}, {}", name, key), unit, *value, number(answer, error)});
        };
        absolute("mean", "mean_error");
        absolute("deviation", "deviation_error");
    }
}

} // namespace

std::optional<double> item(const Json &values, std::size_t i) {
    return i < values.size() && values[i].is_number() ? std::optional(values[i].get<double>())
                                                      : std::nullopt;
}

std::vector<ComparedNumber> quantities_of(const ComparedResult &result) {
    static const std::map<std::string, void (*)(const Json &, Quantities &)> readers{
        {"critical", of_critical},   {"campbell", of_campbell}, {"response", of_response},
        {"stability", of_stability}, {"balance", of_balance},   {"modes", of_modes},
        {"show", of_show},           {"samples", of_samples},   {"simulate", of_simulate}};
    const std::string command = text(result.json, "command");
    const auto reader = readers.find(command);
    if (reader == readers.end())
        throw model::BadInput(fmt::format(
            "{}: compare knows the results of campbell, critical, response, stability, balance, "
            "modes, show, samples and simulate, got one of {}",
            result.name, command));
    Quantities all;
    reader->second(result.json, all);
    return all;
}

} // namespace whirl::report

#include "report/compare/comparison.h"

#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace whirl::report {

namespace {

using model::Sentence;
namespace as = model::as;

using Numbers = std::vector<ComparedNumber>;

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
Sentence name_or_place(const Json &of) {
    const std::string name = text(of, "name");
    return name.empty() ? Sentence("at {}", as::length(number(of, "z").value_or(0)))
                        : Sentence("{}", name);
}

/// With an error that is relative to the value.
void add(Numbers &all, const Sentence &name, Quantity quantity, std::optional<double> value,
         std::optional<double> relative) {
    if (value)
        all.push_back({name, quantity, *value,
                       relative ? std::optional(*relative * std::abs(*value)) : std::nullopt});
}

/// Separation margins, %, of peaks and of critical speeds, as they are listed.
void add_margins(const Json &json, Numbers &all) {
    std::map<std::string, int> counted;
    for (const Json &margin : list(json, "margins")) {
        const std::string of = text(margin, "of");
        const Sentence place = of.empty() ? Sentence("{} whirl", text(margin, "whirl"))
                                          : Sentence("{} {}", of, name_or_place(margin));
        add(all, Sentence("separation margin {}, {}, %", ++counted[place.text()], place),
            Quantity::number, number(margin, "found"), std::nullopt);
    }
}

/// Amplitudes, forces and shares of clearances where the machine runs.
void add_operating(const Json &json, Numbers &all) {
    for (const Json &row : list(json, "operating")) {
        // A bearing always is against what holds it; a probe where it is asked to be.
        const bool against = text(row, "of") == "probe" && row.value("relative", Json()) == true;
        const Sentence place("{} {}{}, {} speed", text(row, "of"), name_or_place(row),
                             against ? " against its pedestal" : "", text(row, "at"));
        add(all, Sentence("{}: amplitude", place), Quantity::amplitude, number(row, "amplitude"),
            number(row, "error"));
        add(all, Sentence("{}: force", place), Quantity::force, number(row, "force"),
            number(row, "error"));
        add(all, Sentence("{}: share of the clearance", place), Quantity::number,
            number(row, "clearance_share"), number(row, "error"));
    }
}

void of_critical(const Json &json, Numbers &all) {
    std::map<std::string, int> counted;
    const auto add_one = [&](const Json &at, const char *sign) {
        const std::string whirl = sign + text(at, "whirl");
        add(all, Sentence("critical speed, {} {}", whirl, ++counted[whirl]), Quantity::speed,
            number(at, "speed"), number(at, "error"));
    };
    const Json &speeds = list(json, "critical_speeds"); // ascending: negative ones the last first
    const auto is_negative = [](const Json &at) { return number(at, "speed").value_or(0) < 0; };
    for (auto at = speeds.rbegin(); at != speeds.rend(); ++at)
        if (is_negative(*at))
            add_one(*at, "negative ");
    for (const Json &at : speeds)
        if (!is_negative(at))
            add_one(at, "");
    add_margins(json, all);
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

void of_campbell(const Json &json, Numbers &all) {
    const Json &speeds = list(json, "speeds");
    const Json &modes = list(json, "modes");
    std::set<std::size_t> ends; // the first and the last speed
    if (!speeds.empty())
        ends = {0, speeds.size() - 1};
    for (const Json &mode : modes)
        for (const std::size_t i : ends)
            add(all,
                Sentence("frequency of {} at {}", text(mode, "label"),
                         as::speed(item(speeds, i).value_or(NAN), 8)),
                Quantity::frequency, item(list(mode, "frequency"), i),
                item(list(mode, "error"), i));
    std::map<std::string, int> counted;
    for (const Json &at : list(json, "crossings")) {
        const auto mode = static_cast<std::size_t>(number(at, "mode").value_or(0));
        if (mode >= modes.size())
            continue;
        const double multiple = number(at, "multiple").value_or(1);
        const Sentence name("crossing of {} with {}x", text(modes[mode], "label"),
                            as::number(multiple));
        const int again = ++counted[name.text()];
        add(all, again > 1 ? Sentence("{}, {}", name, again) : name, Quantity::speed,
            number(at, "speed"),
            crossing_error(speeds, modes[mode], number(at, "speed").value_or(NAN), multiple));
    }
}

void of_response(const Json &json, Numbers &all) {
    add_operating(json, all);
    add_margins(json, all);
    std::map<std::string, int> counted;
    for (const Json &peak : list(json, "peaks")) {
        const std::string of = text(peak, "of");
        const Sentence place("{} {}", of, name_or_place(peak));
        const Sentence which("peak {} of {}", ++counted[place.text()], place);
        add(all, Sentence("{}, speed", which), Quantity::speed, number(peak, "speed"),
            number(peak, "speed_error"));
        add(all, which, of == "bearing" ? Quantity::force : Quantity::amplitude,
            number(peak, "value"), number(peak, "error"));
    }
}

/// Ends of bands; their errors are absolute.
void add_bands(const Json &bands, const Json &errors, const Sentence &of, Numbers &all) {
    constexpr std::array ends{"from", "to"};
    for (std::size_t i = 0; i < bands.size(); ++i)
        for (std::size_t end = 0; end < ends.size(); ++end)
            if (const auto value = item(bands[i], end))
                all.push_back({Sentence("{}, band {} {}", of, i + 1, ends[end]), Quantity::speed,
                               *value, i < errors.size() ? item(errors[i], end) : std::nullopt});
}

void of_stability(const Json &json, Numbers &all) {
    add_bands(list(json, "unstable"), list(json, "unstable_error"), "unstable", all);
    if (const auto level1 = json.find("level1"); level1 != json.end() && level1->is_object()) {
        add(all, "critical cross coupling", Quantity::stiffness,
            number(*level1, "critical_cross_coupling"), number(*level1, "error"));
        add(all, "log. decrement without cross coupling", Quantity::number,
            item(list(*level1, "log_dec"), 0), std::nullopt);
    }
}

/// What is left of a motion with balancers, and the largest amplitudes on the way.
void of_simulate(const Json &json, Numbers &all) {
    add(all, "residual ratio", Quantity::number, number(json, "residual_ratio"), std::nullopt);
    for (const Json &balancer : list(json, "balancers"))
        add(all, Sentence("amplitude of {} at the end", name_or_place(balancer)),
            Quantity::amplitude, number(balancer, "amplitude"), std::nullopt);
    for (const Json &station : list(json, "stations")) {
        add(all, Sentence("peak of {}", name_or_place(station)), Quantity::amplitude,
            number(station, "peak"), std::nullopt);
        add(all, Sentence("peak of {}, speed", name_or_place(station)), Quantity::speed,
            number(station, "peak_speed"), std::nullopt);
        add(all, Sentence("amplitude of {} at the end", name_or_place(station)),
            Quantity::amplitude, number(station, "amplitude"), std::nullopt);
    }
}

void of_balance(const Json &json, Numbers &all) {
    for (const Json &plane : list(json, "planes"))
        add_bands(list(plane, "bands"), list(plane, "band_errors"),
                  Sentence("plane {}", name_or_place(plane)), all);
    if (const auto joint = json.find("joint"); joint != json.end() && joint->is_object())
        add_bands(list(*joint, "bands"), list(*joint, "band_errors"), "all planes", all);
}

void of_modes(const Json &json, Numbers &all) {
    int place = 0;
    for (const Json &mode : list(json, "modes")) {
        const std::string label = text(mode, "label");
        ++place;
        add(all,
            label.empty() ? Sentence("frequency of mode {}", place)
                          : Sentence("frequency of {}", label),
            Quantity::frequency, number(mode, "frequency"), number(mode, "error"));
    }
}

void of_show(const Json &json, Numbers &all) {
    for (const auto &[key, name, quantity] :
         {std::tuple{"mass", "mass", Quantity::mass},
          {"shaft_mass", "mass of the shaft", Quantity::mass},
          {"center_of_mass", "centre of mass", Quantity::length},
          {"length", "length of the shaft", Quantity::length},
          {"Id", "diametral inertia", Quantity::inertia},
          {"Ip", "polar inertia", Quantity::inertia}})
        add(all, name, quantity, number(json, key), 0.0); // sums, not estimates
}

/// Of an answer of samples, by the unit that it names.
Quantity quantity_of_answer(const std::string &unit) {
    for (const Quantity quantity : {Quantity::speed, Quantity::amplitude, Quantity::force})
        if (unit == names_of(quantity).si)
            return quantity;
    return Quantity::number;
}

void of_samples(const Json &json, Numbers &all) {
    for (const Json &answer : list(json, "answers")) {
        const std::string name = text(answer, "of") + " " + text(answer, "name");
        const Quantity quantity = quantity_of_answer(text(answer, "unit"));
        const auto nominal = number(answer, "nominal");
        add(all, Sentence("{}, case as it is", name), quantity, nominal,
            number(answer, "nominal_error"));
        const auto absolute = [&](const char *key, const char *error) {
            if (const auto value = number(answer, key))
                all.push_back(
                    {Sentence("{}, {}", name, key), quantity, *value, number(answer, error)});
        };
        absolute("mean", "mean_error");
        absolute("deviation", "deviation_error");
    }
}

void of_weights(const Json &json, Numbers &all) {
    for (const Json &weight : list(json, "weights")) {
        const std::string plane = text(weight, "plane");
        add(all, Sentence("weight in {}", plane), Quantity::imbalance, number(weight, "mr"),
            std::nullopt);
        add(all, Sentence("phase of the weight in {}", plane), Quantity::angle,
            number(weight, "phase"), std::nullopt);
    }
    add(all, "root mean square after", Quantity::amplitude, number(json, "rms"), std::nullopt);
    add(all, "largest after", Quantity::amplitude, number(json, "max"), std::nullopt);
    add(all, "root mean square before", Quantity::amplitude, number(json, "rms_before"),
        std::nullopt);
    add(all, "largest before", Quantity::amplitude, number(json, "max_before"), std::nullopt);
}

} // namespace

std::optional<double> item(const Json &values, std::size_t i) {
    return i < values.size() && values[i].is_number() ? std::optional(values[i].get<double>())
                                                      : std::nullopt;
}

std::vector<ComparedNumber> quantities_of(const ComparedResult &result) {
    static const std::map<std::string, void (*)(const Json &, Numbers &)> readers{
        {"critical", of_critical},   {"campbell", of_campbell}, {"response", of_response},
        {"stability", of_stability}, {"balance", of_balance},   {"modes", of_modes},
        {"show", of_show},           {"samples", of_samples},   {"simulate", of_simulate},
        {"weights", of_weights}};
    const std::string command = text(result.json, "command");
    const auto reader = readers.find(command);
    if (reader == readers.end())
        throw model::BadInput(fmt::format(
            "{}: compare knows the results of campbell, critical, response, stability, balance, "
            "modes, show, samples, simulate and weights, got one of {}",
            result.name, command));
    Numbers all;
    reader->second(result.json, all);
    return all;
}

} // namespace whirl::report

#include "report/common/json.h"
#include "report/common/units.h"

#include <map>
#include <string>

namespace whirl::report {

namespace {

/// What the numbers of a key are, wherever it stands in a result.
const std::map<std::string, std::string> &key_quantities() {
    static const std::map<std::string, std::string> keys{{"speed", "speed"},
                                                         {"speeds", "speed"},
                                                         {"critical_speeds", "speed"},
                                                         {"half_power", "speed"},
                                                         {"frequency", "frequency"},
                                                         {"frequency_rotating", "frequency"},
                                                         {"other_frequency", "frequency"},
                                                         {"critical_frequency", "frequency"},
                                                         {"z", "length"},
                                                         {"length", "length"},
                                                         {"center_of_mass", "length"},
                                                         {"amplitude", "amplitude"},
                                                         {"amplitude_without_balls", "amplitude"},
                                                         {"major", "amplitude"},
                                                         {"minor", "amplitude"},
                                                         {"clearance", "deflection"},
                                                         {"force", "force"},
                                                         {"stiffness", "stiffness"},
                                                         {"kxx", "stiffness"},
                                                         {"kyy", "stiffness"},
                                                         {"shaft_stiffness", "stiffness"},
                                                         {"bearing_stiffness", "stiffness"},
                                                         {"one_percent_stiffness", "stiffness"},
                                                         {"critical_cross_coupling", "stiffness"},
                                                         {"anticipated", "stiffness"},
                                                         {"q", "stiffness"},
                                                         {"mass", "mass"},
                                                         {"shaft_mass", "mass"},
                                                         {"Id", "inertia"},
                                                         {"Ip", "inertia"}};
    return keys;
}

void scale(Json &value, double factor) {
    if (value.is_number())
        value = value.get<double>() * factor;
    else if (value.is_array())
        for (Json &item : value)
            scale(item, factor);
}

/// What an analysis says in words.
void convert_words(Json &value) {
    if (value.is_string())
        value = note_in_written_units(value.get<std::string>());
    else if (value.is_array())
        for (Json &item : value)
            convert_words(item);
}

/// Numbers of a row that says itself what they are: {"unit": "rad/s", "closed_form": 272, ..}.
void scale_row(Json &row, double factor) {
    for (const char *key : {"closed_form", "fe", "rigid_fe", "nominal", "mean", "mean_error",
                            "deviation", "deviation_error", "values", "value", "interval"})
        if (row.contains(key))
            scale(row[key], factor);
    if (row.contains("quantiles"))
        for (Json &quantile : row["quantiles"])
            scale_row(quantile, factor);
}

void convert_row(Json &row) {
    const auto unit = row["unit"].get<std::string>();
    // The lengths among answers of samples are peaks.
    const bool peak = unit == "m" && row.contains("quantiles");
    const std::string quantity = peak ? "amplitude" : quantity_in(unit);
    if (const auto factor = written_factor(quantity)) {
        scale_row(row, *factor);
        row["unit"] = unit_name(quantity, unit);
    }
}

/// The value of a peak of the response: a deflection, or the force in a bearing.
void convert_peak(Json &peak, std::map<std::string, std::string> &names) {
    const bool force = peak["of"] == "bearing";
    const std::string quantity = force ? "force" : "amplitude";
    const auto factor = written_factor(quantity);
    if (!factor)
        return;
    scale(peak["value"], *factor);
    names[force ? "value (of bearings)" : "value (of stations)"] = unit_name(quantity, "");
}

bool is_peak(const Json &json) {
    return json.is_object() && json.contains("of") && json["of"].is_string() &&
           json.contains("half_power") && json.contains("value") && json["value"].is_number();
}

bool says_its_unit(const Json &json) {
    return json.is_object() && json.contains("unit") && json["unit"].is_string();
}

void convert(Json &json, std::map<std::string, std::string> &names) {
    if (!json.is_object() && !json.is_array())
        return;
    if (says_its_unit(json))
        convert_row(json);
    if (is_peak(json))
        convert_peak(json, names);
    for (auto &[key, value] : json.items()) {
        if (json.is_object() &&
            (key == "notes" || key == "findings" || key == "evidence" || key == "sentence"))
            convert_words(value);
        const auto found = json.is_object() ? key_quantities().find(key) : key_quantities().end();
        const bool numbers = value.is_number() || value.is_array();
        const bool objects = value.is_array() && !value.empty() && value.front().is_object();
        const auto factor = found != key_quantities().end() && numbers && !objects
                                ? written_factor(found->second)
                                : std::nullopt;
        if (factor) {
            scale(value, *factor);
            names[key] = unit_name(found->second, "");
        } else {
            convert(value, names);
        }
    }
}

} // namespace

void convert_json(Json &json) {
    std::map<std::string, std::string> names;
    convert(json, names);
    json["units"] = names;
}

} // namespace whirl::report

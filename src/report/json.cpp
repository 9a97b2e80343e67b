#include "report/json.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <vector>

namespace whirl::report {

using Json = nlohmann::ordered_json;

namespace {

Json number(const std::optional<double> &value) {
    // The library writes NaN and infinity as null.
    return value ? Json(*value) : Json(nullptr);
}

Json list(const std::vector<std::optional<double>> &values) {
    Json items = Json::array();
    for (const auto &value : values)
        items.push_back(number(value));
    return items;
}

Json formulation(const analyses::Formulation &used) {
    return {{"frame", "fixed"},
            {"unknowns", analyses::unknowns_name(used.form)},
            {"form", analyses::form_name(used.form)},
            {"why", used.why}};
}

Json envelope(const char *command, const model::Case &scene, const analyses::ModelSummary &model) {
    return {{"program", "whirl"},
            {"version", program_version()},
            {"format", 1},
            {"command", command},
            {"case", scene.name},
            {"title", scene.title},
            {"formulation", formulation(model.formulation)},
            {"order", model.order},
            {"elements", model.elements},
            {"unknowns_count", model.unknowns},
            {"seconds", model.seconds},
            {"notes", model.notes}};
}

std::string text(const Json &json) {
    // A title that is not UTF-8 must not cost the result: bad bytes are replaced.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json campbell_mode(const analyses::CampbellMode &mode) {
    Json whirl = Json::array();
    for (const analyses::Whirl sense : mode.whirl)
        whirl.push_back(analyses::whirl_name(sense));
    return {{"label", mode.label},
            {"frequency", list(mode.frequency)},
            {"real", list(mode.real)},
            {"damping_ratio", list(mode.damping_ratio)},
            {"log_dec", list(mode.log_dec)},
            {"whirl", whirl},
            {"forward_fraction", mode.forward_fraction},
            {"error", list(mode.error)},
            {"residual", list(mode.residual)}};
}

Json mode_shape(const analyses::ModeShape &mode) {
    Json shape{{"label", mode.label},
               {"frequency", mode.eigenvalue.imag()},
               {"real", mode.eigenvalue.real()},
               {"whirl", analyses::whirl_name(mode.whirl)},
               {"forward_fraction", mode.forward_fraction}};
    for (const char *key : {"x_real", "x_imag", "y_real", "y_imag"})
        shape[key] = Json::array();
    for (const auto &x : mode.x) {
        shape["x_real"].push_back(x.real());
        shape["x_imag"].push_back(x.imag());
    }
    for (const auto &y : mode.y) {
        shape["y_real"].push_back(y.real());
        shape["y_imag"].push_back(y.imag());
    }
    return shape;
}

} // namespace

std::string program_version() { return WHIRL_VERSION; }

std::string to_json(const model::Case &scene, const analyses::CampbellResult &result) {
    Json json = envelope("campbell", scene, result.model);
    json["speeds"] = result.speeds;
    json["modes"] = Json::array();
    for (const auto &mode : result.modes)
        json["modes"].push_back(campbell_mode(mode));
    json["crossings"] = Json::array();
    for (const auto &crossing : result.crossings)
        json["crossings"].push_back({{"multiple", crossing.multiple},
                                     {"speed", crossing.speed},
                                     {"frequency", crossing.frequency},
                                     {"mode", crossing.mode}});
    return text(json);
}

std::string to_json(const model::Case &scene, const analyses::CriticalResult &result) {
    Json json = envelope("critical", scene, result.model);
    json["critical_speeds"] = Json::array();
    for (const auto &critical : result.critical_speeds)
        json["critical_speeds"].push_back({{"speed", critical.speed},
                                           {"whirl", analyses::whirl_name(critical.whirl)},
                                           {"real", critical.real},
                                           {"error", critical.error},
                                           {"residual", critical.residual}});
    return text(json);
}

std::string to_json(const model::Case &scene, const analyses::ResponseResult &result) {
    Json json = envelope("response", scene, result.model);
    json["speeds"] = result.speeds;
    json["nodes"] = Json::array();
    for (const auto &node : result.nodes)
        json["nodes"].push_back({{"z", node.z},
                                 {"name", node.name},
                                 {"amplitude", node.amplitude},
                                 {"phase", node.phase},
                                 {"major", node.major},
                                 {"minor", node.minor}});
    json["bearings"] = Json::array();
    for (const auto &bearing : result.bearings)
        json["bearings"].push_back(
            {{"z", bearing.z}, {"name", bearing.name}, {"force", bearing.force}});
    return text(json);
}

std::string to_json(const model::Case &scene, const analyses::ModesResult &result) {
    Json json = envelope("modes", scene, result.model);
    json["speed"] = result.speed;
    json["z"] = result.z;
    json["modes"] = Json::array();
    for (const auto &mode : result.modes)
        json["modes"].push_back(mode_shape(mode));
    return text(json);
}

std::string to_json(const model::Case &scene, const analyses::ShowResult &result) {
    Json json = envelope("show", scene, result.model);
    json["mass"] = result.mass;
    json["center_of_mass"] = result.center_of_mass;
    json["Id"] = result.Id;
    json["Ip"] = result.Ip;
    json["type"] = result.type;
    json["shaft_mass"] = result.shaft_mass;
    json["length"] = result.length;
    json["balancers"] = Json::array();
    json["formulations"] = Json::array();
    for (const auto &[command, used] : result.formulations) {
        Json entry{{"command", command}};
        entry.update(formulation(used));
        json["formulations"].push_back(entry);
    }
    return text(json);
}

std::string to_json(const model::Case &scene, const analyses::AccuracyResult &result) {
    Json json = envelope("accuracy", scene, result.model);
    json["reference"] = result.reference;
    json["speed"] = result.speed;
    json["reference_frequencies"] = result.reference_frequencies;
    json["rows"] = Json::array();
    for (const auto &row : result.rows)
        json["rows"].push_back({{"family", row.family},
                                {"order", row.order},
                                {"elements", row.elements},
                                {"unknowns", row.unknowns},
                                {"seconds", row.seconds},
                                {"error_estimate", number(row.error_estimate)},
                                {"true_error", number(row.true_error)}});
    return text(json);
}

} // namespace whirl::report

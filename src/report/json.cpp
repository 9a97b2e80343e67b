#include "report/json.h"

#include "report/json_balance.h"
#include "report/json_parts.h"
#include "report/json_show.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/show.h"
#include "results/whirl.h"

namespace whirl::report {

namespace {

Json campbell_mode(const results::CampbellMode &mode) {
    Json whirl = Json::array();
    for (const results::Whirl sense : mode.whirl)
        whirl.push_back(results::whirl_name(sense));
    Json absent = Json::array();
    for (const std::string &why : mode.absent)
        absent.push_back(why.empty() ? Json(nullptr) : Json(why));
    Json out{{"label", mode.label}, {"frequency", json_list(mode.frequency)}, {"absent", absent}};
    if (!mode.frequency_rotating.empty())
        out["frequency_rotating"] = json_list(mode.frequency_rotating);
    out.update({{"real", json_list(mode.real)},
                {"damping_ratio", json_list(mode.damping_ratio)},
                {"log_dec", json_list(mode.log_dec)},
                {"whirl", whirl},
                {"forward_share", mode.forward_fraction},
                {"forward_fraction", mode.forward_fraction}, // its older name
                {"error", json_list(mode.error)},
                {"residual", json_list(mode.residual)}});
    return out;
}

Json mode_shape(const results::ModeShape &mode) {
    Json shape{{"label", mode.label},
               {"frequency", mode.eigenvalue.imag()},
               {"real", mode.eigenvalue.real()},
               {"whirl", results::whirl_name(mode.whirl)},
               {"forward_share", mode.forward_fraction},
               {"forward_fraction", mode.forward_fraction}}; // its older name
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

std::string to_json(const model::Case &scene, const results::CampbellResult &result) {
    Json json = json_envelope("campbell", scene, result.model);
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
    json["divergence"] = json_list(result.divergence);
    return json_text(json);
}

std::string to_json(const model::Case &scene, const results::CriticalResult &result) {
    Json json = json_envelope("critical", scene, result.model);
    json["critical_speeds"] = Json::array();
    for (const auto &critical : result.critical_speeds)
        json["critical_speeds"].push_back({{"speed", critical.speed},
                                           {"whirl", results::whirl_name(critical.whirl)},
                                           {"real", critical.real},
                                           {"error", critical.error},
                                           {"residual", critical.residual}});
    return json_text(json);
}

std::string to_json(const model::Case &scene, const results::ModesResult &result) {
    Json json = json_envelope("modes", scene, result.model);
    json["speed"] = result.speed;
    json["z"] = result.z;
    json["modes"] = Json::array();
    for (const auto &mode : result.modes)
        json["modes"].push_back(mode_shape(mode));
    return json_text(json);
}

std::string to_json(const model::Case &scene, const results::ShowResult &result) {
    Json json = json_envelope("show", scene, result.model);
    json["mass"] = result.mass;
    json["center_of_mass"] = result.center_of_mass;
    json["Id"] = result.Id;
    json["Ip"] = result.Ip;
    json["type"] = result.type;
    json["shaft_mass"] = result.shaft_mass;
    json["length"] = result.length;
    json["dI"] = json_number(result.dI);
    json["dI_angle"] = json_number(result.dI_angle);
    json["balancers"] = Json::array();
    for (const auto &balancer : result.balancers)
        json["balancers"].push_back(balancer_json(balancer));
    json["anisotropy"] = anisotropy_json(result.anisotropy);
    json["formulations"] = Json::array();
    for (const auto &[command, used] : result.formulations) {
        Json entry{{"command", command}};
        entry.update(json_formulation(used));
        json["formulations"].push_back(entry);
    }
    return json_text(json);
}

std::string to_json(const model::Case &scene, const results::AccuracyResult &result) {
    Json json = json_envelope("accuracy", scene, result.model);
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
                                {"error_estimate", json_number(row.error_estimate)},
                                {"true_error", json_number(row.true_error)}});
    return json_text(json);
}

std::string to_json(const model::Case &scene, const results::BalanceResult &result) {
    Json json = json_envelope("balance", scene, result.model);
    json.update(balance_json(result));
    return json_text(json);
}

} // namespace whirl::report

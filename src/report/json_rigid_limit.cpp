#include "report/json.h"

#include "report/json_parts.h"
#include "results/rigid_limit.h"

namespace whirl::report {

namespace {

Json shaft_json(const std::optional<results::RigidShaft> &shaft) {
    if (!shaft)
        return nullptr;
    return {{"factor", shaft->factor},
            {"stiffness", shaft->stiffness},
            {"over_bearings", shaft->over_bearings},
            {"relative_difference", shaft->largest},
            {"quantity", shaft->quantity}};
}

Json numbers_json(const std::vector<double> &values) {
    Json list = Json::array();
    for (const double value : values)
        list.push_back(json_number(value));
    return list;
}

Json row_json(const results::RigidLimitRow &row) {
    Json json{{"quantity", row.quantity}, {"unit", row.unit}, {"closed_form", row.closed_form}};
    json["fe"] = json_list(row.fe);
    if (row.elements.empty())
        json["stiffness"] = numbers_json(row.stiffness);
    else
        json["elements"] = row.elements;
    json["stiffness_factor"] = numbers_json(row.factor);
    json["relative_difference"] = json_list(row.relative_difference);
    json["rounding"] = json_list(row.rounding);
    json["rate"] = json_number(row.rate);
    json["order"] = row.order;
    if (row.elements.empty())
        json["rigid_fe"] = json_number(row.rigid);
    return json;
}

} // namespace

std::string to_json(const model::Case &scene, const results::RigidLimitResult &result) {
    Json json = json_envelope("rigid-limit", scene, result.model);
    json["sentence"] = result.sentence;
    json["stiffness_definition"] = "48 EI/L^3 (N/m): EI the mean over the length L of the shaft";
    json["shaft_stiffness"] = json_number(result.stiffness);
    json["bearing_stiffness"] = json_number(result.bearing_stiffness);
    json["as_is"] = shaft_json(result.as_is);
    json["one_percent"] = shaft_json(result.one_percent);
    json["one_percent_stiffness"] =
        result.one_percent ? Json(result.one_percent->stiffness) : Json(nullptr);
    json["mesh_stiffness_factor"] = json_number(result.mesh_factor);
    json["rows"] = Json::array();
    for (const auto &row : result.rows)
        json["rows"].push_back(row_json(row));
    return json_text(json);
}

} // namespace whirl::report

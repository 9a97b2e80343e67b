#include "report/json.h"

#include "report/json_parts.h"
#include "results/stability.h"

namespace whirl::report {

namespace {

Json family_json(const results::ArrangementFamily &family) {
    return {{"arrangements", family.arrangements},
            {"unstable", json_bands(family.unstable)},
            {"always_unstable", json_bands(family.always_unstable)},
            {"critical_speeds", json_bands(family.critical_speeds)},
            {"additional_speeds", json_bands(family.additional_speeds)},
            {"anisotropy", json_bands(family.anisotropy)}};
}

Json verdicts_json(const std::vector<results::Verdict> &verdicts) {
    Json items = Json::array();
    for (const results::Verdict verdict : verdicts) {
        const std::string name = results::verdict_name(verdict);
        items.push_back(name.empty() ? Json(nullptr) : Json(name));
    }
    return items;
}

Json map_json(const results::StabilityMap &map) {
    return {{"x", {{"path", map.x.path}, {"values", map.x_values}}},
            {"y", {{"path", map.y.path}, {"values", map.y_values}}},
            {"growth", map.growth}};
}

} // namespace

std::string to_json(const model::Case &scene, const results::StabilityResult &result) {
    Json json = json_envelope("stability", scene, result.model);
    json["speeds"] = result.speeds;
    json["growth"] = result.growth;
    json["verdict"] = verdicts_json(result.verdict);
    json["unstable"] = json_bands(result.unstable);
    json["unstable_error"] = json_bands(result.unstable_error);
    json["critical_speeds"] = result.critical_speeds;
    json["zero_root_speeds"] = result.zero_root_speeds;
    json["additional_speeds"] = result.additional_speeds;
    json["permissible"] = Json::array();
    for (const auto &entry : result.permissible)
        json["permissible"].push_back({{"z", entry.z},
                                       {"name", entry.name},
                                       {"dI", json_number(entry.dI)},
                                       {"closed_form", json_number(entry.closed_form)},
                                       {"most", entry.most},
                                       {"of_disc", entry.of_disc}});
    json["neutral_pairs"] = result.neutral_pairs;
    json["harmonics"] = result.harmonics;
    json["family"] = result.family ? family_json(*result.family) : Json(nullptr);
    json["map"] = result.map ? map_json(*result.map) : Json(nullptr);
    return json_text(json);
}

} // namespace whirl::report

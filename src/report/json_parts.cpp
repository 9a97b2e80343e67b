#include "report/json_parts.h"

#include "report/json.h"
#include "results/formulation.h"
#include "results/model_summary.h"

namespace whirl::report {

std::string program_version() { return WHIRL_VERSION; }

Json json_number(const std::optional<double> &value) {
    // The library writes NaN and infinity as null.
    return value ? Json(*value) : Json(nullptr);
}

Json json_list(const std::vector<std::optional<double>> &values) {
    Json items = Json::array();
    for (const auto &value : values)
        items.push_back(json_number(value));
    return items;
}

Json json_formulation(const results::Formulation &used) {
    return {{"frame", results::frame_name(used.form)},
            {"unknowns", results::unknowns_name(used.form)},
            {"form", results::form_name(used.form)},
            {"why", used.why}};
}

Json json_envelope(const char *command, const model::Case &scene,
                   const results::ModelSummary &model) {
    return {{"program", "whirl"},
            {"version", program_version()},
            {"format", 1},
            {"command", command},
            {"case", scene.name},
            {"title", scene.title},
            {"formulation", json_formulation(model.formulation)},
            {"order", model.order},
            {"elements", model.elements},
            {"unknowns_count", model.unknowns},
            {"seconds", model.seconds},
            {"notes", model.notes}};
}

std::string json_text(const Json &json) {
    // A title that is not UTF-8 must not cost the result: bad bytes are replaced.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_bands(const std::vector<std::pair<double, double>> &bands) {
    Json items = Json::array();
    for (const auto &[from, to] : bands)
        items.push_back({from, to});
    return items;
}

} // namespace whirl::report

#include "report/common/json.h"

namespace nlohmann {
WHIRL_JSON(template);
}

void nlohmann::adl_serializer<std::optional<double>>::to_json(nlohmann::ordered_json &json,
                                                              const std::optional<double> &value) {
    json = value ? ordered_json(*value) : ordered_json(nullptr);
}

namespace whirl::report {

Json json_object(std::size_t entries) {
    Json object = Json::object();
    object.get_ref<Json::object_t &>().reserve(entries);
    return object;
}

void take_entries(Json &object, Json &&more) {
    object.get_ref<Json::object_t &>().reserve(object.size() + more.size());
    for (auto &[key, value] : more.get_ref<Json::object_t &>())
        object[key] = std::move(value);
}

} // namespace whirl::report

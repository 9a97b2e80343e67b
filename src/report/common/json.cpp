#include "report/common/json.h"

#include <fmt/format.h>

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

std::string json_text(const Json &json) {
    std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    // The library does so below U+0020; a terminal obeys U+007F to U+009F too.
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const unsigned next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (byte == 0x7f)
            text.replace(i, 1, "\\u007f");
        else if (byte == 0xc2 && next < 0xa0)
            text.replace(i, 2, fmt::format("\\u{:04x}", next));
    }
    return text;
}

Json scaled(Json numbers, double factor) {
    if (factor == 1)
        return numbers;
    if (numbers.is_number())
        return numbers.get<double>() * factor;
    if (numbers.is_array())
        for (Json &item : numbers)
            item = scaled(std::move(item), factor);
    return numbers;
}

Json unit_names(const Units &units) {
    Json names = Json::object();
    for (std::size_t i = 0; i < model::quantities; ++i) {
        const auto quantity = static_cast<Quantity>(i);
        names[names_of(quantity).name] = units.name(quantity);
    }
    return names;
}

Json written(const Units &units, const std::vector<model::Sentence> &sentences) {
    return json_list(sentences, [&units](const auto &sentence) { return units.text(sentence); });
}

void take_entries(Json &object, Json &&more) {
    object.get_ref<Json::object_t &>().reserve(object.size() + more.size());
    for (auto &[key, value] : more.get_ref<Json::object_t &>())
        object[key] = std::move(value);
}

} // namespace whirl::report

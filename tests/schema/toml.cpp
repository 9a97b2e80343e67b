#include "schema/toml.h"

#include <toml++/toml.h>

#include <sstream>

namespace whirl::tests {

using nlohmann::json;

namespace {

json of_table(const toml::table &table) {
    std::ostringstream text;
    text << toml::json_formatter(table);
    return json::parse(text.str());
}

std::string value_text(const json &value) {
    std::string text;
    if (value.is_object()) {
        for (const auto &[key, item] : value.items())
            text += (text.empty() ? "{" : ", ") + key + " = " + value_text(item);
        return text.empty() ? "{}" : text + "}";
    }
    if (!value.is_array())
        return value.dump(); // numbers, texts, true and false are written alike in both
    for (const json &item : value)
        text += (text.empty() ? "[" : ", ") + value_text(item);
    return text.empty() ? "[]" : text + "]";
}

} // namespace

json json_of_toml_file(const std::string &path) { return of_table(toml::parse_file(path)); }

json json_of_toml(const std::string &text) { return of_table(toml::parse(text)); }

std::string to_toml(const json &document) {
    std::string text;
    for (const auto &[key, value] : document.items())
        text += key + " = " + value_text(value) + "\n";
    return text;
}

} // namespace whirl::tests

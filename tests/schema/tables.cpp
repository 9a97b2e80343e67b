#include "schema/tables.h"

#include <cctype>

namespace whirl::tests {

using nlohmann::json;
using Pointer = json::json_pointer;

namespace {

using Places = std::vector<Pointer>;

class Walk {
  public:
    Walk(const json &schema, const json &document) : _schema(schema), _document(document) {}

    /// Everything below a rule. @param places  what in the document it is a rule for
    void visit(const json &rule, const std::string &of, const Places &places) {
        if (rule.contains("$ref"))
            return visit(_schema.at(Pointer(rule.at("$ref").get<std::string>().substr(1))), of,
                         places);
        for (const json &choice : rule.value("anyOf", json::array()))
            visit(choice, of, places);
        if (rule.contains("items"))
            visit(rule.at("items"), of, items_of(places));
        if (rule.contains("properties"))
            add(rule.at("properties"), of, places);
        if (rule.contains("additionalProperties") && rule.at("additionalProperties").is_object())
            visit(rule.at("additionalProperties"), of + ".*", entries_of(places));
    }

    std::map<std::string, SchemaTable> tables;

  private:
    void add(const json &properties, const std::string &of, const Places &places) {
        tables[of].properties = properties;
        for (const Pointer &place : places)
            if (_document.at(place).is_object())
                tables[of].places.push_back(place);
        for (const auto &[key, rule] : properties.items()) {
            Places below;
            for (const Pointer &place : tables[of].places)
                if (_document.at(place).contains(key))
                    below.push_back(place / key);
            visit(rule, of.empty() ? key : of + "." + key, below);
        }
    }
    [[nodiscard]] Places items_of(const Places &places) const {
        Places items;
        for (const Pointer &place : places)
            for (std::size_t i = 0;
                 _document.at(place).is_array() && i < _document.at(place).size(); ++i)
                items.push_back(place / i);
        return items;
    }
    [[nodiscard]] Places entries_of(const Places &places) const {
        Places entries;
        for (const Pointer &place : places)
            for (const auto &entry : _document.at(place).items())
                entries.push_back(place / entry.key());
        return entries;
    }

    const json &_schema;
    const json &_document;
};

} // namespace

std::map<std::string, SchemaTable> tables_of(const json &schema, const json &document) {
    Walk walk(schema, document);
    walk.visit(schema, "", {Pointer("")});
    return walk.tables;
}

std::string path_text(const Pointer &place) {
    std::string text;
    std::string rest = place.to_string();
    while (!rest.empty()) {
        rest = rest.substr(1);
        const std::string step = rest.substr(0, rest.find('/'));
        rest = rest.substr(step.size());
        if (std::isdigit(static_cast<unsigned char>(step.front())) != 0)
            text += "[" + step + "]";
        else
            text += (text.empty() ? "" : ".") + step;
    }
    return text;
}

} // namespace whirl::tests

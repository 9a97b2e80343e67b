#pragma once

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include <fstream>
#include <string>

namespace whirl::tests {

/// A file of docs/schema/.
inline nlohmann::json schema_file(const std::string &name) {
    return nlohmann::json::parse(std::ifstream(std::string(WHIRL_ROOT "/docs/schema/") + name));
}

/// A part of a schema as a schema of its own: it may refer to the definitions of the whole.
inline nlohmann::json part_of_schema(const nlohmann::json &whole, nlohmann::json part) {
    part["$schema"] = whole.at("$schema");
    if (whole.contains("definitions"))
        part["definitions"] = whole.at("definitions");
    return part;
}

/// What a document breaks of a JSON Schema (draft 7), a line each: place, rule. Empty: it is valid.
inline std::string broken_rules(const nlohmann::json &schema, const nlohmann::json &document) {
    valijson::Schema parsed;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), parsed);
    valijson::ValidationResults results;
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    if (validator.validate(parsed, valijson::adapters::NlohmannJsonAdapter(document), &results))
        return "";
    std::string text;
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
        for (const std::string &step : error.context)
            text += step;
        text += ": " + error.description + "\n";
    }
    return text;
}

/// The same of a result of a command: the rules of that command alone, whose places say more.
inline std::string broken_rules_of_result(const nlohmann::json &result) {
    const nlohmann::json schema = schema_file("result.schema.json");
    const nlohmann::json rules =
        schema.at("definitions").at(result.at("command").get<std::string>());
    return broken_rules(part_of_schema(schema, rules), result);
}

} // namespace whirl::tests

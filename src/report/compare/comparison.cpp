#include "report/compare/comparison.h"

#include "model/errors.h"
#include "report/common/files.h"
#include "report/compare/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <system_error>

namespace whirl::report {

namespace {

std::string command_of_result(const Json &json) { return json.value("command", ""); }

const ComparedNumber *named(const std::vector<ComparedNumber> &all, const model::Sentence &name) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&name](const ComparedNumber &at) { return at.name == name; });
    return found == all.end() ? nullptr : &*found;
}

Difference difference_of(const ComparedNumber *first, const ComparedNumber *other,
                         const std::string &name) {
    Difference out;
    out.name = (first ? first : other)->name;
    out.quantity = (first ? first : other)->quantity;
    out.other = name;
    if (first)
        out.first_value = first->value;
    if (other)
        out.other_value = other->value;
    if (!first || !other)
        return out;
    out.difference = other->value - first->value;
    if (*out.difference == 0)
        out.relative = 0;
    else if (first->value != 0)
        out.relative = *out.difference / std::abs(first->value);
    if (first->error && other->error) {
        out.error = *first->error + *other->error;
        out.within = std::abs(*out.difference) <= *out.error;
    }
    return out;
}

void add_notes(Comparison &out) {
    bool not_known = false;
    for (const std::vector<Difference> &all : out.differences) {
        const auto only = std::count_if(all.begin(), all.end(),
                                        [](const Difference &at) { return !at.difference; });
        if (only > 0)
            out.notes.push_back(fmt::format("{} numbers are only in one of {} and {}", only,
                                            out.results[0].name, all.front().other));
        not_known = not_known || std::any_of(all.begin(), all.end(), [](const Difference &at) {
                        return at.difference && !at.within;
                    });
    }
    if (not_known)
        out.notes.emplace_back("where an error is not known, whether a difference is within the "
                               "errors is not said");
}

} // namespace

ComparedResult read_result(const std::filesystem::path &file) {
    constexpr std::uintmax_t largest = 200'000'000; // bytes; read it takes ten times as much memory
    std::error_code ignored;
    const auto refuse = [&file](const std::string &why) {
        throw model::BadInput(
            fmt::format("{}: expected a result that whirl wrote{}", file.string(), why));
    };
    if (!std::filesystem::exists(file, ignored))
        refuse(", there is no such file");
    if (!std::filesystem::is_regular_file(file, ignored))
        refuse(", this is no regular file");
    if (std::filesystem::file_size(file, ignored) > largest)
        refuse(fmt::format(", this file is larger than {} MB", largest / 1'000'000));
    Json json;
    try {
        json = Json::parse(content_of(file), [](int depth, Json::parse_event_t, Json &) {
            constexpr int deepest = 60; // a result has ten
            if (depth > deepest)
                throw std::length_error("deep");
            return true;
        });
    } catch (const std::exception &) { // cut short, or something else
    }
    if (!json.is_object() || json.value("program", Json()) != "whirl" ||
        json.value("format", Json()) != 1 || !json.value("command", Json()).is_string())
        refuse(" (JSON, format 1)");
    if (json.contains("units"))
        throw model::BadInput(fmt::format("{}: expected a result in SI, got one that was written "
                                          "with --json-units",
                                          file.string()));
    check_result(json, file.string());
    return {file.string(), std::move(json)};
}

Comparison compare(std::vector<ComparedResult> results) {
    if (results.size() < 2)
        throw model::BadInput("compare: expected two results or more");
    Comparison out;
    out.results = std::move(results);
    out.command = command_of_result(out.results.front().json);
    for (const ComparedResult &result : out.results)
        if (command_of_result(result.json) != out.command)
            throw model::BadInput(fmt::format(
                "compare: expected results of one command, got {} ({}) and {} ({})", out.command,
                out.results.front().name, command_of_result(result.json), result.name));
    for (std::size_t i = 0; i < out.results.size(); ++i) { // curves of one name have one entry
        const std::string name = out.results[i].name;
        int alike = 1;
        for (std::size_t k = 0; k < i; ++k)
            if (out.results[k].name == name || out.results[k].name.starts_with(name + " ("))
                ++alike;
        if (alike > 1)
            out.results[i].name = fmt::format("{} ({})", name, alike);
    }
    const std::vector<ComparedNumber> first = quantities_of(out.results.front());
    for (std::size_t i = 1; i < out.results.size(); ++i) {
        const std::vector<ComparedNumber> other = quantities_of(out.results[i]);
        const std::string &name = out.results[i].name;
        std::vector<Difference> &all = out.differences.emplace_back();
        for (const ComparedNumber &quantity : first)
            all.push_back(difference_of(&quantity, named(other, quantity.name), name));
        for (const ComparedNumber &quantity : other)
            if (!named(first, quantity.name))
                all.push_back(difference_of(nullptr, &quantity, name));
    }
    add_notes(out);
    return out;
}

} // namespace whirl::report

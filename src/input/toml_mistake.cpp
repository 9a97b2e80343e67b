#include "input/toml_mistake.h"

#include "input/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace whirl::input {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// What stands between the first two quotation marks of the parser.
std::string quoted(std::string_view found) {
    const std::size_t begin = std::min(found.find('\''), found.size() - 1) + 1;
    return std::string(found.substr(begin, found.find('\'', begin) - begin));
}

/// As much of a text as a message holds.
std::string shortened(std::string_view text) {
    constexpr std::size_t longest = 60;
    return std::string(text.substr(0, longest)) + (text.size() > longest ? "..." : "");
}

/// Lines without white space around them; empty beyond the last.
class Lines {
  public:
    explicit Lines(std::string_view document) {
        while (!document.empty()) {
            const std::size_t end = std::min(document.find('\n'), document.size());
            _lines.push_back(trimmed(document.substr(0, end)));
            document.remove_prefix(std::min(end + 1, document.size()));
        }
    }
    /// From 1.
    [[nodiscard]] std::string_view line(int number) const {
        const auto place = static_cast<std::size_t>(number - 1);
        return number > 0 && place < _lines.size() ? _lines[place] : std::string_view();
    }
    [[nodiscard]] bool is_header(int number) const { return line(number).starts_with('['); }

  private:
    std::vector<std::string_view> _lines;
};

/// The table whose header is the last of a document, "bearing[1]"; what follows belongs to it.
struct LastTable {
    const Lines &lines;
    int line = 0;
    std::string path = {};

    void look_in(const Node &node, const std::string &around) {
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const Node &item = node.items[i];
            const std::string own = node.is_list()   ? fmt::format("{}[{}]", around, i)
                                    : around.empty() ? item.key
                                                     : around + "." + item.key;
            if (item.kind == Node::Kind::table && item.origin.line >= line &&
                lines.is_header(item.origin.line)) {
                line = item.origin.line;
                path = own;
            }
            look_in(item, own);
        }
    }
};

/// ", first in line 7".
std::string first_at(const Node *first) {
    return first != nullptr ? fmt::format(", first in line {}", first->origin.line) : "";
}

/// A header of a name that there is already.
Problem second_header(std::string_view header, const std::string &path, const Origin &at,
                      const Node *first) {
    constexpr std::array lists{
        "disc",      "bearing", "seal",  "anisotropy", "balancer",           "plane",
        "imbalance", "force",   "probe", "trial",      "simulate.imbalance", "simulate.force"};
    const bool list = header.starts_with("[[");
    const bool tables = first != nullptr && (first->is_list() || first->kind == Node::Kind::table);
    if (tables && first->is_list() != list) {
        const Origin single = list ? first->origin : at;
        return {single, path,
                fmt::format("expected [[{0}]], as in line {1}, got [{0}]", path,
                            list ? at.line : first->origin.line)};
    }
    if (!list && std::ranges::find(lists, path) != lists.end())
        return {at, path,
                fmt::format("expected [[{0}]] above each, as there may be several, got [{0}] "
                            "twice{1}",
                            path, first_at(first))};
    return {at, path, "expected each section once, got it twice" + first_at(first)};
}

/// A number that is beyond those that the program computes with.
std::string too_large(std::string_view found) {
    const std::string number = shortened(quoted(found));
    return has(found, "integer")
               ? fmt::format("expected a whole number of up to 18 digits, or one with a decimal "
                             "point or an exponent, got {}",
                             number)
               : fmt::format("expected a number below 1.8e308, got {}", number);
}

/// A value that is neither number nor flag, and begins as no text, list or table does.
std::string no_value(std::string_view value) {
    return value.empty() ? "expected a value, got none"
                         : fmt::format("expected a number, true, false, or in quotation marks a "
                                       "text or a number with its unit, got {}{}",
                                       shortened(value), decimal_comma_hint(value));
}

} // namespace

Problem toml_mistake(std::string_view document, std::string_view found, const Origin &at,
                     const Node *before) {
    const Lines lines(document);
    const std::string_view line = lines.line(at.line);
    if (before != nullptr && lines.is_header(at.line)) {
        if (has(found, "cannot redefine existing"))
            return second_header(line, quoted(found), at, find_path(*before, quoted(found)));
        return {at, "",
                fmt::format("expected a section, [NAME] or [[NAME]], got {}", shortened(line))};
    }
    const std::size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, equals));
    const bool plain =
        before != nullptr && !key.empty() && key.find_first_of("\"'{}[]#,") == key.npos;
    const bool number = has(found, "not representable") || has(found, "could not be interpreted");
    if (!plain)
        return {at, "", number ? too_large(found) : fmt::format("not valid TOML: {}", found)};
    if (equals == line.npos || key.find_first_of(" \t:") != key.npos)
        return {at, "", fmt::format("expected KEY = VALUE, got {}", shortened(line))};
    LastTable table{lines};
    table.look_in(*before, "");
    const std::string around = table.path.empty() ? "" : table.path + ".";
    const std::string path = around + std::string(key);
    if (has(found, "cannot redefine existing") && has(found, "'")) {
        const std::string again = quoted(found); // another than the key in an inline table
        return {at, path,
                fmt::format("expected each key once, got {} twice{}", again,
                            first_at(again == key ? find_path(*before, path) : nullptr))};
    }
    if (number)
        return {at, path, too_large(found)};
    const std::string_view value = trimmed(line.substr(equals + 1, line.find('#') - equals - 1));
    if (value.empty() || value.find_first_of("\"'[{") == value.npos)
        return {at, path, no_value(value)};
    const auto marks = std::ranges::count(value, value[0]);
    if (has(found, "parsing string") && (value[0] == '"' || value[0] == '\'') && marks == 1)
        return {at, path,
                "expected a quotation mark at the end of the text, got " + shortened(value)};
    return {at, path, fmt::format("not valid TOML: {}", found)};
}

} // namespace whirl::input

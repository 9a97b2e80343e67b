#include "input/toml_text.h"

#include "input/problems.h"
#include "input/toml_mistake.h"
#include "input/units.h"
#include "model/errors.h"

// The only translation unit that sees toml++: it is slow to compile.
#include <toml++/toml.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>

namespace whirl::input {
namespace {

Node convert(const toml::node &source, const Origin &around) {
    Node node;
    node.origin = around;
    // Tables that only a dotted key or a deeper header implies have no line of their own, and what
    // is given on the command line has none at all.
    if (around.line > 0 && source.source().begin.line > 0)
        node.origin.line = static_cast<int>(source.source().begin.line);
    if (const toml::table *table = source.as_table()) {
        for (const auto &[key, value] : *table) {
            node.items.push_back(convert(value, node.origin));
            node.items.back().key = std::string(key.str());
        }
    } else if (const toml::array *list = source.as_array()) {
        node.kind = Node::Kind::list;
        for (const toml::node &item : *list)
            node.items.push_back(convert(item, node.origin));
    } else if (const auto *text = source.as_string()) {
        node.kind = Node::Kind::text;
        node.text = text->get();
    } else if (const auto *integer = source.as_integer()) {
        node.kind = Node::Kind::integer;
        node.number = static_cast<double>(integer->get());
    } else if (const auto *real = source.as_floating_point()) {
        node.kind = Node::Kind::real;
        node.number = real->get();
    } else if (const auto *flag = source.as_boolean()) {
        node.kind = Node::Kind::boolean;
        node.flag = flag->get();
    } else {
        node.kind = Node::Kind::other;
    }
    return node;
}

toml::table table_of(const Node &node);
toml::array list_of(const Node &node);

/// Hands over the value; what TOML has beside the kinds a case knows is an error of any case.
template <class Add> void hand_over(const Node &node, Add add) {
    switch (node.kind) {
    case Node::Kind::table:
        return add(table_of(node));
    case Node::Kind::list:
        return add(list_of(node));
    case Node::Kind::text:
        return add(node.text);
    case Node::Kind::integer:
        if (std::abs(node.number) < 0x1p63)
            return add(static_cast<std::int64_t>(node.number));
        return add(node.number);
    case Node::Kind::real:
        return add(node.number);
    case Node::Kind::boolean:
        return add(node.flag);
    case Node::Kind::other:
        break;
    }
}

toml::table table_of(const Node &node) {
    toml::table table;
    for (const Node &item : node.items)
        hand_over(item, [&](auto &&value) { table.insert_or_assign(item.key, value); });
    return table;
}

toml::array list_of(const Node &node) {
    toml::array list;
    for (const Node &item : node.items)
        hand_over(item, [&](auto &&value) { list.push_back(value); });
    return list;
}

/// Follows a document far enough to see how deep its keys and brackets go.
class DepthReader {
  public:
    explicit DepthReader(std::string_view document) : _rest(document) {}

    /// The line at which it is deeper than is allowed; none: nowhere.
    std::optional<int> too_deep() {
        std::size_t dots = 0;            // of the key that is read
        std::vector<std::size_t> around; // depth of each bracket that is open
        const auto depth = [&] { return (around.empty() ? 0 : around.back()) + dots; };
        while (!_rest.empty()) {
            const char c = _rest[0];
            if (c == '"' || c == '\'') {
                skip_string();
                continue;
            }
            if (c == '#') {
                _rest.remove_prefix(std::min(_rest.find('\n'), _rest.size()));
                continue;
            }
            _rest.remove_prefix(1);
            _line += c == '\n' ? 1 : 0;
            if (c == '.')
                ++dots;
            else if (c == '\n' || c == ',')
                dots = 0;
            if (c == '[' || c == '{') {
                around.push_back(depth() + 1);
                dots = 0;
            } else if ((c == ']' || c == '}') && !around.empty()) {
                around.pop_back();
                dots = 0;
            }
            if (depth() > deepest)
                return _line;
        }
        return std::nullopt;
    }

  private:
    std::string_view _rest;
    int _line = 1;

    void skip_string() {
        const char mark = _rest[0];
        const std::string whole(3, mark);
        const bool lines = _rest.starts_with(whole);
        const std::string end = lines ? whole : std::string(1, mark);
        _rest.remove_prefix(end.size());
        while (!_rest.empty() && !_rest.starts_with(end) && (lines || _rest[0] != '\n')) {
            const bool escape = mark == '"' && _rest[0] == '\\' && _rest.size() > 1;
            _line += _rest[escape ? 1 : 0] == '\n' ? 1 : 0;
            _rest.remove_prefix(escape ? 2 : 1);
        }
        _rest.remove_prefix(std::min(end.size(), _rest.size()));
    }
};

/// The document, parsed where it is not too deep to be.
Node parsed(std::string_view document, const Origin &origin) {
    if (const auto line = DepthReader(document).too_deep())
        throw model::BadInput(
            fmt::format("{}: expected keys and lists within one another up to {} deep, got more",
                        Origin{origin.file, origin.line > 0 ? *line : 0}.text(), deepest));
    return convert(toml::parse(document, origin.file), origin);
}

/// The lines before that one, where they are a document.
std::optional<Node> parsed_before(std::string_view document, const Origin &at) {
    std::size_t end = 0;
    for (int line = 1; line < at.line; ++line)
        end = std::min(document.find('\n', end), document.size() - 1) + 1;
    try {
        return parsed(document.substr(0, end), {at.file, 1});
    } catch (const toml::parse_error &) {
        return std::nullopt;
    }
}

/// Finds the places of a document's entries.
class PlaceFinder {
  public:
    explicit PlaceFinder(std::string_view document) : _document(document) {
        _lines.push_back(0);
        for (std::size_t i = 0; i < document.size(); ++i)
            if (document[i] == '\n')
                _lines.push_back(i + 1);
    }

    std::map<std::string, TextPlace> found(const toml::table &root) {
        entries(root, "");
        return std::move(_places);
    }

  private:
    std::string_view _document;
    std::vector<std::size_t> _lines; ///< where each begins
    std::map<std::string, TextPlace> _places;

    /// toml++ counts lines and, in them, characters, both from 1.
    [[nodiscard]] std::size_t offset(const toml::source_position &at) const {
        std::size_t byte = _lines.at(std::min<std::size_t>(at.line - 1, _lines.size() - 1));
        const auto follows = [this](std::size_t k) { // a further byte of a character
            return k < _document.size() &&
                   (static_cast<unsigned char>(_document[k]) & 0xC0U) == 0x80U;
        };
        for (toml::source_index column = 1; column < at.column && byte < _document.size(); ++column)
            do
                ++byte;
            while (follows(byte));
        return byte;
    }

    void entries(const toml::table &table, const std::string &path) {
        for (const auto &[key, value] : table)
            if (key.str().find_first_of(".[]") == std::string_view::npos && !key.str().empty())
                note(value,
                     path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()));
    }

    void note(const toml::node &node, const std::string &path) {
        const toml::table *table = node.as_table();
        const toml::array *list = node.as_array();
        const toml::source_region &region = node.source();
        // Tables that a deeper header or a dotted key implies stand nowhere themselves, and lists
        // of tables with headers in several places.
        const bool below_headers = list != nullptr && !list->empty() && list->front().is_table() &&
                                   !list->front().as_table()->is_inline();
        const bool header = table != nullptr && !table->is_inline();
        if (region.begin.line > 0 && !below_headers &&
            (!header || _document[offset(region.begin)] == '['))
            _places[path] = {header             ? TextPlace::Kind::header
                             : table != nullptr ? TextPlace::Kind::inline_table
                                                : TextPlace::Kind::value,
                             offset(region.begin), offset(region.end)};
        if (table != nullptr)
            entries(*table, path);
        for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
            note((*list)[i], fmt::format("{}[{}]", path, i));
    }
};

} // namespace

std::map<std::string, TextPlace> text_places(std::string_view document) {
    const toml::table root = toml::parse(document);
    return PlaceFinder(document).found(root);
}

std::string value_text(const Node &value) {
    std::ostringstream text;
    const auto put = [&text](const auto &own) { text << own; };
    hand_over(value, [&put](auto own) {
        if constexpr (std::is_same_v<decltype(own), toml::table>) {
            own.is_inline(true);
            put(own);
        } else if constexpr (std::is_same_v<decltype(own), toml::array>) {
            put(own);
        } else {
            put(toml::value(own));
        }
    });
    return text.str();
}

std::string key_text(const std::string &key) {
    const bool bare =
        !key.empty() && key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKL"
                                              "MNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
    Node text;
    text.kind = Node::Kind::text;
    text.text = key;
    return bare ? key : value_text(text);
}

Node parse_toml(std::string_view document, const std::string &file) {
    try {
        return parsed(document, {file, 1});
    } catch (const toml::parse_error &error) {
        const Origin at{file, static_cast<int>(error.source().begin.line)};
        const std::optional<Node> before = parsed_before(document, at);
        throw model::BadInput(
            toml_mistake(document, error.description(), at, before ? &*before : nullptr).message());
    }
}

Node parse_value(std::string_view text, const Origin &origin) {
    Node node;
    try {
        Node table = parsed("value = " + std::string(text), origin);
        // A line break in the text could have smuggled further keys in.
        if (table.items.size() == 1)
            node = table.items.front();
    } catch (const toml::parse_error &) {
        node = Node{};
    }
    if (node.key.empty()) {
        node.kind = Node::Kind::text;
        node.origin = origin;
        node.text = std::string(trimmed(text));
    }
    return node;
}

std::string to_toml(const Node &root) {
    std::ostringstream text;
    text << table_of(root) << '\n';
    return text.str();
}

} // namespace whirl::input

#include "input/toml_text.h"

#include "input/problems.h"
#include "input/units.h"
#include "model/errors.h"

// The only translation unit that sees toml++: it is slow to compile.
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

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
        return add(static_cast<std::int64_t>(node.number));
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

/// Of a line whose value begins as a number does.
std::string hint_for_line(std::string_view document, toml::source_index line) {
    for (; line > 1; --line)
        document.remove_prefix(std::min(document.find('\n') + 1, document.size()));
    document = document.substr(0, document.find('\n'));
    const std::size_t value = document.find_first_of("+-0123456789", document.find('=') + 1);
    if (value != document.find_first_not_of(" \t", document.find('=') + 1))
        return "";
    document.remove_prefix(std::min(value, document.size()));
    return decimal_comma_hint(document.substr(0, document.find_first_of(" \t#")));
}

} // namespace

Node parse_toml(std::string_view document, const std::string &file) {
    try {
        return convert(toml::parse(document, file), {file, 1});
    } catch (const toml::parse_error &error) {
        const Origin origin{file, static_cast<int>(error.source().begin.line)};
        std::string text(error.description());
        text += hint_for_line(document, error.source().begin.line);
        throw model::BadInput(origin.text() + ": not valid TOML: " + text);
    }
}

Node parse_value(std::string_view text, const Origin &origin) {
    Node node;
    try {
        Node table = convert(toml::parse("value = " + std::string(text)), origin);
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

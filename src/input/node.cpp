#include "input/node.h"
#include "input/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace whirl::input {
namespace {

const Node *follow(const Node &node, const PathStep &step) {
    if (!step.key.empty())
        return node.find(step.key);
    return step.index && node.is_list() && *step.index < node.items.size()
               ? &node.items[*step.index]
               : nullptr;
}

/// What stands between the brackets: an index, "*" or a name, which may be in quotation marks.
PathStep items_of(std::string_view text) {
    std::size_t index = 0;
    const char *end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, index);
    if (error == std::errc() && next == end)
        return {"", index, {}};
    if (text == "*")
        return {};
    if (text.size() > 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return {"", {}, std::string(text)};
}

/// Reads "[3][0]" from the front of `text`; false where it is malformed.
bool parse_indices(std::string_view &text, std::vector<PathStep> &steps) {
    while (text.starts_with('[') && steps.size() <= deepest) {
        const std::size_t end = text.find(']');
        if (end == std::string_view::npos || end == 1)
            return false;
        steps.push_back(items_of(text.substr(1, end - 1)));
        text.remove_prefix(end + 1);
    }
    return true;
}

} // namespace

const Node *Node::find(std::string_view name) const {
    if (kind != Kind::table)
        return nullptr;
    const auto found = std::ranges::find(items, name, &Node::key);
    return found == items.end() ? nullptr : &*found;
}

Node *Node::find(std::string_view name) {
    return const_cast<Node *>(std::as_const(*this).find(name));
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string out(text.substr(0, longest));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return "\"" + out + (text.size() > longest ? "...\"" : "\"");
}

std::string as_written(const Node *node, double value, std::string_view unit, double other) {
    return node != nullptr && node->kind == Node::Kind::text && !parse_number(node->text)
               ? in_quotes(node->text)
               : fmt::format("{} {}", digits_apart(value, other), unit);
}

std::string shown(const Node &node) {
    switch (node.kind) {
    case Node::Kind::table:
        return "a table";
    case Node::Kind::list:
        return fmt::format("a list of {}", node.items.size());
    case Node::Kind::text:
        return in_quotes(node.text);
    case Node::Kind::integer:
    case Node::Kind::real:
        return fmt::format("{}", node.number);
    case Node::Kind::boolean:
        return node.flag ? "true" : "false";
    case Node::Kind::other:
        break;
    }
    return "a date or time";
}

std::vector<PathStep> parse_path(std::string_view text) {
    std::vector<PathStep> steps;
    while (steps.size() <= deepest) {
        const std::size_t end = std::min(text.find_first_of(".[]"), text.size());
        if (end == 0)
            return {};
        steps.push_back({std::string(text.substr(0, end)), {}, {}});
        text.remove_prefix(end);
        if (!parse_indices(text, steps))
            return {};
        if (text.empty())
            return steps;
        if (text[0] != '.')
            return {};
        text.remove_prefix(1);
    }
    return {};
}

bool is_named(const Node &item, std::string_view name) {
    const Node *own = item.find("name");
    return own && own->kind == Node::Kind::text && own->text == name;
}

const Node *find_path(const Node &root, std::string_view path) {
    const std::vector<PathStep> steps = parse_path(path);
    const Node *node = steps.empty() ? nullptr : &root;
    for (const PathStep &step : steps)
        if (node)
            node = follow(*node, step);
    return node;
}

Origin origin_of(const Node &root, std::string_view path) {
    const Node *node = &root;
    for (const PathStep &step : parse_path(path)) {
        const Node *next = follow(*node, step);
        if (!next)
            break;
        node = next;
    }
    return node->origin;
}

} // namespace whirl::input

#include "input/overrides.h"

#include "input/toml_text.h"
#include "input/units.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

/// The entry `name` of a table; where it is missing it is made as an empty table, but not if
/// `list_wanted`. Null where there is none or `node` is no table.
Node *entry(Node &node, const std::string &name, bool list_wanted, const Origin &origin) {
    if (node.kind != Node::Kind::table)
        return nullptr;
    if (Node *found = node.find(name))
        return found;
    if (list_wanted)
        return nullptr;
    Node made;
    made.key = name;
    made.origin = origin;
    node.items.push_back(std::move(made));
    return &node.items.back();
}

Node *item(Node &node, std::size_t index) {
    return node.kind == Node::Kind::list && index < node.items.size() ? &node.items[index]
                                                                      : nullptr;
}

/// What stands in the way of the step, for the message.
std::string obstacle(const Node &node, const PathStep &step, const std::string &walked) {
    const std::string where = walked.empty() ? "the case" : walked;
    if (const auto *index = std::get_if<std::size_t>(&step)) {
        if (node.kind == Node::Kind::list)
            return fmt::format("expected an index below {}, got {}: {} has {} items",
                               node.items.size(), *index, where, node.items.size());
        return fmt::format("expected a list at {}, got {}", where, shown(node));
    }
    if (node.kind == Node::Kind::table)
        return fmt::format("expected a list of the case, there is no {} in {}",
                           std::get<std::string>(step), where);
    return fmt::format("expected a table at {}, got {}", where, shown(node));
}

void apply(Node &root, const std::string &path, std::string_view value, const Origin &origin,
           Problems &problems) {
    Node *node = &root;
    std::string walked;
    const std::vector<PathStep> steps = parse_path(path);
    if (steps.empty()) {
        problems.add(origin, "", "expected a path such as bearing[0].k, got " + in_quotes(path));
        return;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const PathStep &step = steps[i];
        const auto *name = std::get_if<std::string>(&step);
        const bool list_wanted =
            i + 1 < steps.size() && std::holds_alternative<std::size_t>(steps[i + 1]);
        Node *next = name ? entry(*node, *name, list_wanted, origin)
                          : item(*node, std::get<std::size_t>(step));
        if (!next) {
            problems.add(origin, path, obstacle(*node, step, walked));
            return;
        }
        walked += name ? (walked.empty() ? *name : "." + *name)
                       : fmt::format("[{}]", std::get<std::size_t>(step));
        node = next;
    }
    const std::string key = node->key;
    *node = parse_value(value, origin);
    node->key = key;
}

} // namespace

void apply_overrides(Node &root, const std::vector<std::string> &overrides, Problems &problems) {
    for (const std::string &text : overrides) {
        const Origin origin{"--set " + text, 0};
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) {
            problems.add(origin, "", "expected path.to.key=value, got no \"=\"");
            continue;
        }
        const std::string path(trimmed(std::string_view(text).substr(0, equals)));
        apply(root, path, std::string_view(text).substr(equals + 1), origin, problems);
    }
}

} // namespace whirl::input

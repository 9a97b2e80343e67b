#include "input/overrides.h"

#include "input/toml_text.h"
#include "input/units.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

using Nodes = std::vector<Node *>;

/// The entry `name` of a table; where it is missing it is made as an empty table, but not if
/// `list_wanted`. Null where there is none or `node` is no table.
Node *entry(Node &node, const std::string &name, bool list_wanted, const Origin &origin) {
    if (node.is_list() && node.items.size() == 1) // bearing.k of the only bearing
        return entry(node.items.front(), name, list_wanted, origin);
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

/// Items of a list that a step speaks of.
Nodes items(Node &node, const PathStep &step) {
    Nodes out;
    for (std::size_t i = 0; node.is_list() && i < node.items.size(); ++i)
        if (step.index ? i == *step.index : !step.name || is_named(node.items[i], *step.name))
            out.push_back(&node.items[i]);
    return out;
}

Nodes followed(Node &node, const PathStep &step, bool list_wanted, const Origin &origin) {
    if (step.key.empty())
        return items(node, step);
    Node *found = entry(node, step.key, list_wanted, origin);
    return found ? Nodes{found} : Nodes{};
}

std::string step_text(const PathStep &step) {
    if (!step.key.empty())
        return step.key;
    return step.index ? fmt::format("[{}]", *step.index)
                      : fmt::format("[{}]", step.name.value_or("*"));
}

/// What stands in the way of the step, for the message.
std::string obstacle(const Node &node, const PathStep &step, const std::string &walked) {
    const std::string where = walked.empty() ? "the case" : walked;
    const bool key = !step.key.empty();
    if (key && node.is_list())
        return fmt::format("expected which of the {1} items of {0} is meant: {0}[0].{2}, or all of "
                           "them: {0}[*].{2}",
                           where, node.items.size(), step.key);
    if (key && node.kind == Node::Kind::table) {
        std::vector<std::string> keys;
        for (const Node &item : node.items)
            keys.push_back(item.key);
        return fmt::format("expected a list of the case, there is no {} in {}{}", step.key, where,
                           did_you_mean(step.key, keys));
    }
    if (key)
        return fmt::format("expected a table at {}, got {}", where, shown(node));
    if (!node.is_list())
        return fmt::format("expected a list at {}, got {}", where, shown(node));
    if (step.index)
        return fmt::format("expected an index below {}, got {}: {} has {} item{}",
                           node.items.size(), *step.index, where, node.items.size(),
                           node.items.size() == 1 ? "" : "s");
    return fmt::format("expected the name of an item of {}, there is no {}{}", where, where,
                       step_text(step));
}

/// Takes what the step speaks of out of a table or list. @returns whether there was anything
bool remove(Node &node, const PathStep &step) {
    if (!step.key.empty() && node.is_list() && node.items.size() == 1)
        return remove(node.items.front(), step);
    const Nodes gone = step.key.empty() ? items(node, step) : Nodes{node.find(step.key)};
    return std::erase_if(node.items, [&](const Node &item) {
               return std::ranges::find(gone, &item) != gone.end();
           }) > 0;
}

void apply(Node &root, const std::string &path, std::string_view value, const Origin &origin,
           Problems &problems) {
    const std::vector<PathStep> steps = parse_path(path);
    if (steps.empty()) {
        problems.add(origin, "", "expected a path such as bearing[0].k, got " + in_quotes(path));
        return;
    }
    const bool removes = trimmed(value).empty();
    Nodes nodes{&root};
    std::string walked;
    for (std::size_t i = 0; i + (removes ? 1 : 0) < steps.size(); ++i) {
        const bool list_wanted = i + 1 < steps.size() && steps[i + 1].key.empty();
        Nodes next;
        for (Node *node : nodes) {
            const Nodes found = followed(*node, steps[i], list_wanted || removes, origin);
            if (found.empty()) {
                problems.add(origin, path, obstacle(*node, steps[i], walked));
                return;
            }
            next.insert(next.end(), found.begin(), found.end());
        }
        walked += (walked.empty() || steps[i].key.empty() ? "" : ".") + step_text(steps[i]);
        nodes = std::move(next);
    }
    if (removes) {
        const auto gone =
            std::ranges::count_if(nodes, [&](Node *node) { return remove(*node, steps.back()); });
        if (gone == 0)
            problems.add(origin, path,
                         "expected something to take out of the case, there is no such entry");
        return;
    }
    for (Node *node : nodes) {
        const std::string key = node->key;
        *node = parse_value(value, origin);
        node->key = key;
    }
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

#include "input/overrides.h"

#include "input/toml_text.h"
#include "input/units.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

/// A node of the case with its path, in which every item has its index: "bearing[1].k".
struct Place {
    Node *node;
    std::string path;

    [[nodiscard]] Place entry(Node &of, const std::string &key) const {
        return {&of, path.empty() ? key : path + "." + key};
    }
    [[nodiscard]] Place item(std::size_t i) const {
        return {&node->items[i], fmt::format("{}[{}]", path, i)};
    }
};
using Places = std::vector<Place>;

/// The entry `key` of a table; where it is missing it is made as an empty table, but not if
/// `list_wanted`. None where there is none or the node is no table.
Places entry(const Place &place, const std::string &key, bool list_wanted, const Origin &origin) {
    Node &node = *place.node;
    if (node.is_list() && node.items.size() == 1) // bearing.k of the only bearing
        return entry(place.item(0), key, list_wanted, origin);
    if (node.kind != Node::Kind::table)
        return {};
    if (Node *found = node.find(key))
        return {place.entry(*found, key)};
    if (list_wanted)
        return {};
    Node made;
    made.key = key;
    made.origin = origin;
    node.items.push_back(std::move(made));
    return {place.entry(node.items.back(), key)};
}

/// Items of a list that a step speaks of.
Places items(const Place &place, const PathStep &step) {
    Places out;
    const Node &node = *place.node;
    for (std::size_t i = 0; node.is_list() && i < node.items.size(); ++i)
        if (step.index ? i == *step.index : !step.name || is_named(node.items[i], *step.name))
            out.push_back(place.item(i));
    return out;
}

Places followed(const Place &place, const PathStep &step, bool list_wanted, const Origin &origin) {
    return step.key.empty() ? items(place, step) : entry(place, step.key, list_wanted, origin);
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
    std::vector<const Node *> gone{node.find(step.key)};
    if (step.key.empty()) {
        gone.clear();
        for (const Place &item : items({&node, ""}, step))
            gone.push_back(item.node);
    }
    return std::erase_if(node.items, [&](const Node &item) {
               return std::ranges::find(gone, &item) != gone.end();
           }) > 0;
}

/// Places that all but the last `left` steps of a path speak of; none with a problem.
Places places_of(Node &root, const std::vector<PathStep> &steps, std::size_t left,
                 const std::string &path, const Origin &origin, Problems &problems) {
    Places places{{&root, ""}};
    std::string walked;
    for (std::size_t i = 0; i + left < steps.size(); ++i) {
        const bool list_wanted = i + 1 < steps.size() && steps[i + 1].key.empty();
        Places next;
        for (const Place &place : places) {
            const Places found = followed(place, steps[i], list_wanted || left > 0, origin);
            if (found.empty()) {
                problems.add(origin, path, obstacle(*place.node, steps[i], walked));
                return {};
            }
            next.insert(next.end(), found.begin(), found.end());
        }
        walked += (walked.empty() || steps[i].key.empty() ? "" : ".") + step_text(steps[i]);
        places = std::move(next);
    }
    return places;
}

/// "path.to.key=", which takes entries or items out.
void take_out(Node &root, const std::string &path, const Origin &origin, Problems &problems) {
    const std::vector<PathStep> steps = parse_path(path);
    const std::size_t before = problems.count();
    const Places places = places_of(root, steps, 1, path, origin, problems);
    const auto gone = std::ranges::count_if(
        places, [&](const Place &place) { return remove(*place.node, steps.back()); });
    if (gone == 0 && problems.count() == before)
        problems.add(origin, path,
                     "expected something to take out of the case, there is no such entry");
}

} // namespace

std::vector<std::string> set_entries(Node &root, const std::string &path, std::string_view value,
                                     const Origin &origin, Problems &problems) {
    std::vector<std::string> paths;
    for (const Place &place : places_of(root, parse_path(path), 0, path, origin, problems)) {
        const std::string key = place.node->key;
        *place.node = parse_value(value, origin);
        place.node->key = key;
        paths.push_back(place.path);
    }
    return paths;
}

void apply_overrides(Node &root, const std::vector<std::string> &overrides, Problems &problems) {
    for (const std::string &text : overrides) {
        constexpr std::size_t shown = 200; // of a text that is no override
        const Origin origin{
            "--set " + (text.size() <= shown ? text : text.substr(0, shown) + "..."), 0};
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) {
            problems.add(origin, "", "expected path.to.key=value, got no \"=\"");
            continue;
        }
        const std::string path(trimmed(std::string_view(text).substr(0, equals)));
        const std::string_view value = std::string_view(text).substr(equals + 1);
        if (parse_path(path).empty())
            problems.add(origin, "",
                         "expected a path such as bearing[0].k, got " + in_quotes(path));
        else if (trimmed(value).empty())
            take_out(root, path, origin, problems);
        else
            (void)set_entries(root, path, value, origin, problems);
    }
}

} // namespace whirl::input

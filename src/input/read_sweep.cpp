#include "input/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <set>
#include <string_view>

namespace whirl::input {

namespace {

/// Largest number of rotors of a sweep: as of samples.
constexpr double most_rotors = 1e6;

/// The texts of `path`: one, or those of a list.
/// @param besides  a word that may stand for one: "speed", or empty
std::vector<std::string> paths_of(CheckedTable &table, const std::string &besides) {
    const auto entry = table.entry("path");
    if (!entry) {
        table.fail("path", fmt::format("missing, expected {}a numeric entry of the case, or a list "
                                       "of them that change together",
                                       besides.empty() ? "" : in_quotes(besides) + ", "));
        return {};
    }
    if (!entry->node.is_list()) {
        const auto path = table.text("path"); // of another kind: told
        return path ? std::vector{*path} : std::vector<std::string>{};
    }
    std::vector<std::string> paths;
    for (const CheckedEntry &item : entry->items())
        if (item.node.kind == Node::Kind::text && !besides.empty() && item.node.text == besides)
            item.fail(in_quotes(besides) + " stands alone, not in a list of entries");
        else if (item.node.kind == Node::Kind::text)
            paths.push_back(item.node.text);
        else
            item.fail("expected a numeric entry of the case in quotes, got " + shown(item.node));
    if (entry->node.items.empty())
        entry->fail("expected at least one numeric entry of the case, got none");
    return paths;
}

/// All entries that the axis changes; a mistake leaves them out.
/// @param besides   a word that may stand for one: "speed", or empty
/// @param quantity  gets that of the entries
void read_entries(CheckedTable &table, const std::string &besides, model::SweepAxis &axis,
                  std::optional<Quantity> &quantity) {
    const bool relative = axis.change != model::SweepChange::value;
    for (const std::string &path : paths_of(table, besides)) {
        if (path.empty()) {
            table.fail("path", "expected a numeric entry of the case, got \"\"");
            continue;
        }
        const auto found = numeric_entries(table, path, besides);
        if (!found)
            continue;
        // Factors may change stiffness and damping together; values and shifts are of one kind.
        if (axis.change != model::SweepChange::factor && quantity && *quantity != found->quantity)
            table.fail("path", fmt::format("expected entries of one quantity, got {} and {}: "
                                           "change = \"factor\" scales entries of any kind",
                                           describe(*quantity), describe(found->quantity)));
        quantity = found->quantity;
        if (axis.label.empty())
            axis.label = path;
        for (const std::string &own : found->paths) {
            if (!relative) {
                axis.entries.push_back({own, 0});
                continue;
            }
            const auto given = value_in_case({{own}, found->quantity}, table.context().tree);
            if (!given)
                table.fail("path",
                           "expected an entry that the case gives, to change it by a factor "
                           "or a shift; " +
                               own + " is left at its default");
            else
                axis.entries.push_back({own, *given});
        }
    }
}

void read_range(CheckedTable &table, Quantity quantity, model::SweepAxis &axis) {
    const Range range = axis.logarithmic ? Range::positive() : Range{};
    const double from = table.number("from", quantity, range);
    const double to = table.number("to", quantity, range);
    const int count = table.whole("count", 2, largest_count);
    if (to <= from)
        table.fail("to", fmt::format("expected more than from = {}, got {}", from, to));
    for (int i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / (count - 1);
        axis.values.push_back(i == count - 1     ? to
                              : axis.logarithmic ? from * std::pow(to / from, share)
                                                 : from + (to - from) * share);
    }
}

void read_values(CheckedTable &table, Quantity quantity, model::SweepAxis &axis) {
    axis.values = table.numbers("values", quantity);
    const Node *list = table.find("values");
    if (list->is_list() && list->items.empty())
        table.fail("values", "expected at least one value, got none");
    for (const char *other : {"from", "to", "count", "spacing"})
        if (table.has(other))
            table.fail(other, "expected either `values` or `from`, `to` and `count`, got both");
}

/// What changes, without its values; no quantity with a mistake.
/// @param besides  as of read_entries
std::optional<Quantity> read_change(CheckedTable &table, const std::string &besides,
                                    model::SweepAxis &axis) {
    axis.change =
        static_cast<model::SweepChange>(table.choice("change", {"value", "factor", "shift"}, 0));
    std::optional<Quantity> of_entries;
    read_entries(table, besides, axis, of_entries);
    if (of_entries)
        axis.quantity = axis.change == model::SweepChange::factor ? Quantity::number : *of_entries;
    return of_entries;
}

model::SweepAxis read_sweep_axis(CheckedTable &table) {
    model::SweepAxis axis;
    if (!read_change(table, "", axis))
        return axis;
    if (table.has("values")) {
        read_values(table, axis.quantity, axis);
    } else {
        axis.logarithmic = table.choice("spacing", {"linear", "log"}, 0) == 1;
        read_range(table, axis.quantity, axis);
    }
    table.refuse_unknown();
    return axis;
}

} // namespace

model::SweepAxis read_map_axis(CheckedTable &table) {
    model::SweepAxis axis;
    if (const Node *path = table.find("path");
        path != nullptr && path->kind == Node::Kind::text && path->text == "speed") {
        axis.label = *table.text("path");
        axis.quantity = Quantity::speed;
        if (table.choice("change", {"value", "factor", "shift"}, 0) != 0)
            table.fail("change", "expected \"value\" of the spin speed, which is no entry of the "
                                 "case, got " +
                                     shown(*table.find("change")));
    } else if (!read_change(table, "speed", axis)) {
        return axis;
    }
    read_range(table, axis.quantity, axis);
    table.refuse_unknown();
    return axis;
}

void refuse_twice(CheckedTable &table, const std::vector<model::SweepAxis> &axes) {
    std::set<std::string> changed;
    for (const model::SweepAxis &axis : axes)
        for (const model::SweptEntry &entry : axis.entries)
            if (!changed.insert(entry.path).second)
                table.fail("expected each entry once, got " + in_quotes(entry.path) + " twice");
}

void read_sweep(CheckedTable &table, model::Case &scene) {
    model::SweepSettings sweep;
    read_wanted(table, scene, sweep.of);
    double points = 1;
    for (const char *key : {"x", "y"}) {
        if (auto axis = table.table(key)) {
            sweep.axes.push_back(read_sweep_axis(*axis));
            points *= static_cast<double>(sweep.axes.back().values.size());
        } else if (std::string_view(key) == "x" && !table.has(key)) {
            table.fail(key, "missing, expected a table {path, from, to, count}");
        }
    }
    refuse_twice(table, sweep.axes);
    if (points > most_rotors)
        table.fail(fmt::format("expected at most {:.0f} rotors, got {:.0f}", most_rotors, points));
    scene.sweep = std::move(sweep);
}

} // namespace whirl::input

#include "input/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
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
    const bool number = axis.dimensionless.has_value();
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
        const auto whole = std::ranges::find_if(found->paths, [&table](const std::string &own) {
            return table.context().whole.contains(own);
        });
        if (number && whole != found->paths.end())
            table.fail("path", fmt::format("expected an entry that may have any value, of which "
                                           "one gives the rotor its {}, got {}, a whole number",
                                           axis.dimensionless->name, in_quotes(*whole)));
        for (const std::string &own : found->paths) {
            if (!relative && !number) {
                axis.entries.push_back({own, 0});
                continue;
            }
            const auto given = value_in_case({{own}, found->quantity}, table.context().tree);
            if (!relative)
                axis.entries.push_back({own, given.value_or(0)});
            else if (!given)
                table.fail("path",
                           "expected an entry that the case gives, to change it by a factor "
                           "or a shift; " +
                               own + " is left at its default");
            else
                axis.entries.push_back({own, *given});
        }
    }
}

/// Values that an axis may have.
Range range_of(const model::SweepAxis &axis) {
    Range range = axis.logarithmic ? Range::positive() : Range{};
    if (axis.dimensionless &&
        (axis.dimensionless->name == "m" || axis.dimensionless->name == "A_m")) {
        range = Range::positive();
        range.otherwise = ": the parts of every balancer have mass";
    }
    return range;
}

void read_range(CheckedTable &table, model::SweepAxis &axis) {
    const double from = table.number("from", axis.quantity, range_of(axis));
    const double to = table.number("to", axis.quantity, range_of(axis));
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

void read_values(CheckedTable &table, model::SweepAxis &axis) {
    axis.values = table.numbers("values", axis.quantity, range_of(axis));
    const Node *list = table.find("values");
    if (list->is_list() && list->items.empty())
        table.fail("values", "expected at least one value, got none");
    for (const char *other : {"from", "to", "count", "spacing"})
        if (table.has(other))
            table.fail(other, "expected either `values` or `from`, `to` and `count`, got both");
}

/// What changes, without its values.
/// @param besides  as of read_entries
/// @returns false with a mistake that leaves no entry
bool read_change(CheckedTable &table, const std::string &besides, model::SweepAxis &axis) {
    axis.change =
        static_cast<model::SweepChange>(table.choice("change", {"value", "factor", "shift"}, 0));
    std::optional<Quantity> of_entries;
    read_entries(table, besides, axis, of_entries);
    if (of_entries && axis.change != model::SweepChange::factor && !axis.dimensionless)
        axis.quantity = *of_entries;
    return of_entries.has_value();
}

std::string list_of(const auto &...names) {
    std::vector<std::string> all;
    (all.insert(all.end(), names.begin(), names.end()), ...);
    return fmt::format("\"{}\"", fmt::join(all, "\", \""));
}

/// The dimensionless number that the values of an axis are of, where the axis asks for one.
/// @param of_speed  the axis is the spin speed
void read_dimensionless(CheckedTable &table, const model::Rotor &rotor, bool of_speed,
                        model::SweepAxis &axis) {
    const auto name = table.text_entry("dimensionless");
    const std::size_t count = rotor.balancers.size();
    if (!name) {
        if (table.has("balancer"))
            table.fail("balancer", "expected none without `dimensionless`: it says whose number "
                                   "the values are of");
        return;
    }
    const std::string &word = name->node.text;
    const auto is_of = [&word](const auto &names) {
        return std::ranges::find(names, word) != names.end();
    };
    const bool of_balancer = is_of(model::balancer_numbers);
    if (of_speed ? word != model::speed_number : !of_balancer && !is_of(model::rotor_numbers)) {
        name->fail(of_speed ? fmt::format("expected \"{}\" of the spin speed, got {}",
                                          model::speed_number, in_quotes(word))
                            : fmt::format("expected one of the numbers of show, {}, got {}",
                                          list_of(model::rotor_numbers, model::balancer_numbers),
                                          in_quotes(word)));
        return;
    }
    axis.dimensionless = model::DimensionlessNumber{word, std::nullopt,
                                                    name->node.origin.text() + ": " + name->path};
    if (table.has("balancer") && of_speed)
        table.fail("balancer", "expected none: the spin speed is over that of the whole rotor");
    else if (table.has("balancer") && count == 0)
        table.fail("balancer", "expected a balancer, the case has none");
    else if (table.has("balancer"))
        axis.dimensionless->balancer =
            static_cast<std::size_t>(table.whole("balancer", 0, static_cast<int>(count) - 1));
    else if (of_balancer && count != 1)
        name->fail(count == 0 ? "expected a number of the rotor, the case has no balancer, got " +
                                    in_quotes(word)
                              : fmt::format("expected whose of the {} balancers, as balancer = 0, "
                                            "got {} alone",
                                            count, in_quotes(word)));
}

model::SweepAxis read_sweep_axis(CheckedTable &table, const model::Rotor &rotor) {
    model::SweepAxis axis;
    read_dimensionless(table, rotor, false, axis);
    if (!read_change(table, "", axis))
        return axis;
    if (table.has("values")) {
        read_values(table, axis);
    } else {
        axis.logarithmic = table.choice("spacing", {"linear", "log"}, 0) == 1;
        read_range(table, axis);
    }
    table.refuse_unknown();
    return axis;
}

} // namespace

model::SweepAxis read_map_axis(CheckedTable &table, const model::Rotor &rotor) {
    model::SweepAxis axis;
    const Node *path = table.find("path");
    const bool of_speed =
        path != nullptr && path->kind == Node::Kind::text && path->text == "speed";
    read_dimensionless(table, rotor, of_speed, axis);
    if (of_speed) {
        axis.label = *table.text("path");
        if (!axis.dimensionless)
            axis.quantity = Quantity::speed;
        if (table.choice("change", {"value", "factor", "shift"}, 0) != 0)
            table.fail("change", "expected \"value\" of the spin speed, which is no entry of the "
                                 "case, got " +
                                     shown(*table.find("change")));
    } else if (!read_change(table, "speed", axis)) {
        return axis;
    }
    read_range(table, axis);
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
            sweep.axes.push_back(read_sweep_axis(*axis, scene.rotor));
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

#include "input/checked_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace whirl::input {

bool Range::contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::words() const {
    if (std::isinf(low) && std::isinf(high))
        return "";
    if (std::isinf(high))
        return low_open ? fmt::format(" greater than {}", low) : fmt::format(", {} or more", low);
    return fmt::format(" in {}{}, {}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
}

std::string ReadContext::elsewhere(const std::string &key) const {
    for (const auto &[path, quantity] : numeric)
        if (path.ends_with("." + key))
            return fmt::format(", did you mean \"{}\"?", path);
    return "";
}

std::optional<double> number_of(const Node &node, Quantity quantity) {
    if (node.is_number() && std::isfinite(node.number))
        return node.number;
    return parse_quantity(node.text, quantity);
}

double CheckedEntry::number(Quantity quantity, Range range) const {
    context.numeric.insert_or_assign(path, quantity);
    const std::optional<double> value = number_of(node, quantity);
    if (value && range.contains(*value))
        return *value;
    fail(fmt::format("expected {}{}{}, got {}{}", describe(quantity), range.words(),
                     node.is_number() && !value ? ", finite" : "", shown(node),
                     value ? std::string(range.otherwise) : quantity_hint(node.text, quantity)));
    return std::numeric_limits<double>::quiet_NaN();
}

int CheckedEntry::whole(int low, int high) const {
    context.numeric.insert_or_assign(path, Quantity::number);
    context.whole.insert(path);
    if (node.is_number() && node.number == std::floor(node.number) && node.number >= low &&
        node.number <= high)
        return static_cast<int>(node.number);
    fail(fmt::format("expected a whole number from {} to {}, got {}", low, high, shown(node)));
    return low;
}

std::vector<CheckedEntry> CheckedEntry::items() const {
    std::vector<CheckedEntry> out;
    if (node.is_list())
        for (const Node &item : node.items)
            out.push_back({item, fmt::format("{}[{}]", path, out.size()), context});
    return out;
}

std::vector<double> CheckedEntry::numbers(Quantity quantity, Range range) const {
    std::vector<double> values;
    for (const CheckedEntry &item : items())
        values.push_back(item.number(quantity, range));
    return values;
}

void CheckedEntry::fail(std::string text) const {
    context.problems.add(node.origin, path, std::move(text));
}

std::string one_of(const std::vector<std::string> &words, const Node &node) {
    return fmt::format("expected \"{}\", got {}{}", fmt::join(words, "\" or \""), shown(node),
                       did_you_mean(node.text, words));
}

const Node *CheckedTable::find(const std::string &key) {
    if (std::ranges::find(_known, key) == _known.end())
        _known.push_back(key);
    return node().find(key);
}

std::optional<CheckedEntry> CheckedTable::entry(const std::string &key) {
    const Node *found = find(key);
    return found ? std::optional(CheckedEntry{*found, path_of(key), context()}) : std::nullopt;
}

double CheckedTable::number(const std::string &key, Quantity quantity, Range range) {
    if (const auto own = entry(key))
        return own->number(quantity, range);
    fail(key, fmt::format("missing, expected {}{}", describe(quantity), range.words()));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> CheckedTable::optional_number(const std::string &key, Quantity quantity,
                                                    Range range) {
    const auto own = entry(key);
    return own ? std::optional(own->number(quantity, range)) : std::nullopt;
}

std::vector<double> CheckedTable::numbers(const std::string &key, Quantity quantity, Range range) {
    const auto list = entry(key);
    if (!list)
        return {};
    if (!list->node.is_list())
        list->fail(fmt::format("expected a list, each {}{}, got {}", describe(quantity),
                               range.words(), shown(list->node)));
    return list->numbers(quantity, range);
}

int CheckedTable::whole(const std::string &key, int low, int high) {
    if (!has(key))
        fail(key, fmt::format("missing, expected a whole number of {} or more", low));
    return whole_or(key, low, low, high);
}

int CheckedTable::whole_or(const std::string &key, int fallback, int low, int high) {
    const auto own = entry(key);
    return own ? own->whole(low, high) : fallback;
}

bool CheckedTable::flag_or(const std::string &key, bool fallback) {
    const Node *own = find(key);
    if (!own)
        return fallback;
    if (own->kind == Node::Kind::boolean)
        return own->flag;
    fail(key, "expected true or false, got " + shown(*own));
    return fallback;
}

std::optional<CheckedEntry> CheckedTable::text_entry(const std::string &key) {
    auto own = entry(key);
    if (own && own->node.kind != Node::Kind::text) {
        own->fail("expected a text, got " + shown(own->node));
        return std::nullopt;
    }
    return own;
}

std::optional<std::string> CheckedTable::text(const std::string &key) {
    const auto own = text_entry(key);
    return own ? std::optional(own->node.text) : std::nullopt;
}

std::size_t CheckedTable::choice(const std::string &key, const std::vector<std::string> &choices,
                                 std::size_t fallback) {
    const Node *own = find(key);
    if (!own)
        return fallback;
    const auto found = std::ranges::find(choices, own->text);
    if (found != choices.end())
        return static_cast<std::size_t>(found - choices.begin());
    fail(key, one_of(choices, *own));
    return fallback;
}

std::optional<CheckedTable> CheckedTable::table(const std::string &key) {
    auto own = entry(key);
    if (!own)
        return std::nullopt;
    if (own->node.kind != Node::Kind::table) {
        own->fail(fmt::format("expected a table, got {}{}", shown(own->node),
                              own->node.is_number() ? context().elsewhere(key) : ""));
        return std::nullopt;
    }
    return CheckedTable(std::move(*own));
}

std::vector<CheckedTable> CheckedTable::tables(const std::string &key) {
    const auto list = entry(key);
    if (!list)
        return {};
    if (!list->node.is_list())
        list->fail(
            fmt::format("expected a list of tables, [[{}]], got {}", key, shown(list->node)));
    std::vector<CheckedTable> tables;
    for (const CheckedEntry &item : list->items())
        if (item.node.kind == Node::Kind::table)
            tables.emplace_back(item);
        else
            item.fail("expected a table, got " + shown(item.node));
    return tables;
}

void CheckedTable::fail(const std::string &key, std::string text) const {
    const Node *own = node().find(key);
    context().problems.add((own ? *own : node()).origin, path_of(key), std::move(text));
}

void CheckedTable::refuse_unknown() {
    for (const Node &own : node().items)
        if (std::ranges::find(_known, own.key) == _known.end()) {
            // At the root of the case a number stands in none of its tables: it was meant in one.
            const std::string table = path().empty() ? context().elsewhere(own.key) : "";
            context().problems.add(own.origin, path_of(own.key),
                                   "unknown key" +
                                       (table.empty() ? suggestion(own.key, _known) : table));
        }
}

} // namespace whirl::input

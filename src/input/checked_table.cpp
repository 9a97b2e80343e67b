#include "input/checked_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace whirl::input {

namespace {

/// What may have been meant by a text that is no number.
std::string hint_for(const Node &node, Quantity quantity) {
    return node.kind == Node::Kind::text
               ? decimal_comma_hint(node.text) + spaced_unit_hint(node.text, quantity)
               : "";
}

} // namespace

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

double ReadContext::number(const Node &node, const std::string &path, Quantity quantity,
                           Range range) {
    numeric.insert_or_assign(path, quantity);
    std::optional<double> value;
    if (node.is_number() && std::isfinite(node.number))
        value = node.number;
    else if (node.kind == Node::Kind::text)
        value = parse_quantity(node.text, quantity);
    if (value && range.contains(*value))
        return *value;
    problems.add(node.origin, path,
                 fmt::format("expected {}{}{}, got {}{}", describe(quantity), range.words(),
                             node.is_number() && !value ? ", finite" : "", shown(node),
                             hint_for(node, quantity)));
    return std::numeric_limits<double>::quiet_NaN();
}

int ReadContext::whole(const Node &node, const std::string &path, int low, int high) {
    numeric.insert_or_assign(path, Quantity::dimensionless);
    if (node.is_number() && node.number == std::floor(node.number) && node.number >= low &&
        node.number <= high)
        return static_cast<int>(node.number);
    problems.add(
        node.origin, path,
        fmt::format("expected a whole number from {} to {}, got {}", low, high, shown(node)));
    return low;
}

std::string one_of(const std::vector<std::string> &words, const Node &node) {
    const std::string best = node.kind == Node::Kind::text ? nearest(node.text, words) : "";
    return fmt::format("expected \"{}\", got {}{}", fmt::join(words, "\" or \""), shown(node),
                       best.empty() ? "" : fmt::format(", did you mean \"{}\"?", best));
}

const Node *CheckedTable::find(const std::string &key) {
    if (std::ranges::find(_known, key) == _known.end())
        _known.push_back(key);
    return _node->find(key);
}

double CheckedTable::number(const std::string &key, Quantity quantity, Range range) {
    if (const Node *entry = find(key))
        return _context->number(*entry, path_of(key), quantity, range);
    fail(key, fmt::format("missing, expected {}{}", describe(quantity), range.words()));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> CheckedTable::optional_number(const std::string &key, Quantity quantity,
                                                    Range range) {
    const Node *entry = find(key);
    if (!entry)
        return std::nullopt;
    return _context->number(*entry, path_of(key), quantity, range);
}

std::vector<double> CheckedTable::numbers(const std::string &key, Quantity quantity, Range range) {
    const Node *entry = find(key);
    if (!entry)
        return {};
    if (entry->kind != Node::Kind::list) {
        fail(key, fmt::format("expected a list, each {}{}, got {}", describe(quantity),
                              range.words(), shown(*entry)));
        return {};
    }
    std::vector<double> values;
    for (const Node &item : entry->items)
        values.push_back(_context->number(item, fmt::format("{}[{}]", path_of(key), values.size()),
                                          quantity, range));
    return values;
}

int CheckedTable::whole(const std::string &key, int low, int high) {
    if (!has(key))
        fail(key, fmt::format("missing, expected a whole number of {} or more", low));
    return whole_or(key, low, low, high);
}

int CheckedTable::whole_or(const std::string &key, int fallback, int low, int high) {
    const Node *entry = find(key);
    return entry ? _context->whole(*entry, path_of(key), low, high) : fallback;
}

bool CheckedTable::flag_or(const std::string &key, bool fallback) {
    const Node *entry = find(key);
    if (!entry)
        return fallback;
    if (entry->kind != Node::Kind::boolean)
        fail(key, "expected true or false, got " + shown(*entry));
    return entry->flag;
}

std::optional<std::string> CheckedTable::text(const std::string &key) {
    const Node *entry = find(key);
    if (!entry)
        return std::nullopt;
    if (entry->kind != Node::Kind::text) {
        fail(key, "expected a text, got " + shown(*entry));
        return std::nullopt;
    }
    return entry->text;
}

std::size_t CheckedTable::choice(const std::string &key, const std::vector<std::string> &choices,
                                 std::size_t fallback) {
    const Node *entry = find(key);
    if (!entry)
        return fallback;
    const auto found = std::ranges::find(choices, entry->text);
    if (entry->kind == Node::Kind::text && found != choices.end())
        return static_cast<std::size_t>(found - choices.begin());
    fail(key, one_of(choices, *entry));
    return fallback;
}

std::optional<CheckedTable> CheckedTable::table(const std::string &key) {
    const Node *entry = find(key);
    if (!entry)
        return std::nullopt;
    if (entry->kind != Node::Kind::table) {
        fail(key, fmt::format("expected a table, got {}{}", shown(*entry),
                              entry->is_number() ? _context->elsewhere(key) : ""));
        return std::nullopt;
    }
    return CheckedTable(*entry, path_of(key), *_context);
}

std::vector<CheckedTable> CheckedTable::tables(const std::string &key) {
    const Node *entry = find(key);
    if (!entry)
        return {};
    if (entry->kind != Node::Kind::list) {
        fail(key, fmt::format("expected a list of tables, [[{}]], got {}", key, shown(*entry)));
        return {};
    }
    std::vector<CheckedTable> tables;
    for (std::size_t i = 0; i < entry->items.size(); ++i) {
        const std::string item_path = fmt::format("{}[{}]", path_of(key), i);
        const Node &item = entry->items[i];
        if (item.kind == Node::Kind::table)
            tables.emplace_back(item, item_path, *_context);
        else
            _context->problems.add(item.origin, item_path, "expected a table, got " + shown(item));
    }
    return tables;
}

void CheckedTable::fail(const std::string &key, std::string text) {
    const Node *entry = _node->find(key);
    _context->problems.add(entry ? entry->origin : _node->origin, path_of(key), std::move(text));
}

void CheckedTable::refuse_unknown() {
    for (const Node &entry : _node->items)
        if (std::ranges::find(_known, entry.key) == _known.end()) {
            // At the root of the case a number stands in none of its tables: it was meant in one.
            const std::string table = _path.empty() ? _context->elsewhere(entry.key) : "";
            _context->problems.add(entry.origin, path_of(entry.key),
                                   "unknown key" +
                                       (table.empty() ? suggestion(entry.key, _known) : table));
        }
}

} // namespace whirl::input

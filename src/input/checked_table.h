#pragma once

#include "input/file_text.h"
#include "input/node.h"
#include "input/units.h"

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace whirl::input {

/// Values that a number may have.
struct Range {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double low = -infinity;
    double high = infinity;
    bool low_open = false;  ///< low itself is not allowed
    bool high_open = false; ///< high itself is not allowed
    /// What else may be given where a number is out of range, for the end of a message.
    std::string_view otherwise = {};

    /// False for nan.
    [[nodiscard]] bool contains(double value) const;
    /// " greater than 0", " in [0, 0.5)", or nothing for all numbers.
    [[nodiscard]] std::string words() const;

    static Range positive() { return {0, infinity, true, true, {}}; }
    static Range not_negative() { return {0, infinity, false, false, {}}; }
    static Range inside(double low, double high) { return {low, high, true, true, {}}; }
};

/// What reading a case shares: the mistakes found, and which entries are numbers of which kind.
struct ReadContext {
    ReadContext(const Node &whole, FileTexts &tables) : tree(whole), files(tables) {}

    const Node &tree; ///< the case
    FileTexts &files;
    Problems problems;
    std::map<std::string, Quantity> numeric; ///< path of an entry, its quantity
    std::set<std::string> whole;             ///< those of them that are whole numbers
    std::vector<model::Sentence> remarks;    ///< what is no mistake and looks like one
    std::filesystem::path folder;            ///< of the case file; paths in it start here

    /// `, did you mean "material.steel.E"?` for E: a number of that key read in some table.
    [[nodiscard]] std::string elsewhere(const std::string &key) const;
};

/// A number or a text with its unit in SI; empty where it is none or not finite.
[[nodiscard]] std::optional<double> number_of(const Node &node, Quantity quantity);

/// An entry of a case file, or an item of a list there.
struct CheckedEntry {
    const Node &node;
    std::string path;
    ReadContext &context;

    /// In SI. A mistake is collected and gives nan, which no comparison of a later check holds for,
    /// so that one mistake is reported once.
    [[nodiscard]] double number(Quantity quantity, Range range = {}) const;
    /// The same for a whole number; a mistake gives `low`.
    [[nodiscard]] int whole(int low, int high) const;
    /// Items of a list; none of anything else.
    [[nodiscard]] std::vector<CheckedEntry> items() const;
    /// All of them as numbers.
    [[nodiscard]] std::vector<double> numbers(Quantity quantity, Range range = {}) const;
    /// Collects a mistake.
    void fail(std::string text) const;
};

/// What to say of a node that is none of some words: `expected "a" or "b", got "c", did you mean
/// ...`.
[[nodiscard]] std::string one_of(const std::vector<std::string> &words, const Node &node);

/// A table of a case file whose every entry must be asked for: those nobody asked for are unknown
/// keys. Mistakes are collected with line and path.
class CheckedTable {
  public:
    /// @param own  a table; its node and context must outlive this
    explicit CheckedTable(CheckedEntry own) : _own(std::move(own)) {}

    /// The node of an entry or null; makes the key known.
    const Node *find(const std::string &key);
    /// The same with its path.
    std::optional<CheckedEntry> entry(const std::string &key);
    bool has(const std::string &key) { return find(key) != nullptr; }

    /// A required number in SI; nan where it is missing or wrong (see CheckedEntry::number).
    double number(const std::string &key, Quantity quantity, Range range = {});
    /// A number that may be missing.
    std::optional<double> optional_number(const std::string &key, Quantity quantity,
                                          Range range = {});
    double number_or(const std::string &key, double fallback, Quantity quantity, Range range = {}) {
        return optional_number(key, quantity, range).value_or(fallback);
    }
    /// A list of numbers; empty where it is missing or wrong.
    std::vector<double> numbers(const std::string &key, Quantity quantity, Range range = {});
    /// A required whole number; `low` where it is missing or wrong.
    int whole(const std::string &key, int low, int high);
    /// A whole number from `low` to `high`.
    int whole_or(const std::string &key, int fallback, int low, int high);
    bool flag_or(const std::string &key, bool fallback);
    std::optional<std::string> text(const std::string &key);
    /// The same with its place.
    std::optional<CheckedEntry> text_entry(const std::string &key);
    /// Index of the text of `key` in `choices`; `fallback` where it is missing or wrong.
    std::size_t choice(const std::string &key, const std::vector<std::string> &choices,
                       std::size_t fallback);

    std::optional<CheckedTable> table(const std::string &key);
    std::vector<CheckedTable> tables(const std::string &key);

    /// Collects a mistake at the entry `key`, or at the table where it has no such entry.
    void fail(const std::string &key, std::string text) const;
    /// Collects a mistake of the table itself.
    void fail(std::string text) const { _own.fail(std::move(text)); }
    /// Collects a mistake for each entry that was never asked for. Call last.
    void refuse_unknown();

    [[nodiscard]] const Node &node() const { return _own.node; }
    [[nodiscard]] const std::string &path() const { return _own.path; }
    [[nodiscard]] ReadContext &context() const { return _own.context; }

  private:
    CheckedEntry _own;
    std::vector<std::string> _known;

    [[nodiscard]] std::string path_of(const std::string &key) const {
        return path().empty() ? key : path() + "." + key;
    }
};

/// `name` and `z`, which all that sits on a shaft has.
template <class Part> void read_place(CheckedTable &table, Part &part) {
    part.name = table.text("name").value_or("");
    part.z = table.number("z", Quantity::length);
}

/// Reads each table of a list into an item of its own; `read` asks for all entries there may be.
template <class Item, class Read>
void read_each(CheckedTable &around, const std::string &key, std::vector<Item> &items, Read read) {
    for (CheckedTable &table : around.tables(key)) {
        Item item;
        read(table, item);
        table.refuse_unknown();
        items.push_back(std::move(item));
    }
}

} // namespace whirl::input

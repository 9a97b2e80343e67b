#pragma once

#include "input/problems.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::input {

/// Tables and lists within one another that a case may have; real ones have a handful. Whoever goes
/// through them calls himself once for each.
inline constexpr std::size_t deepest = 60;

/// A value of a case file with the place where it was written.
struct Node {
    enum class Kind { table, list, text, integer, real, boolean, other };

    Kind kind = Kind::table;
    Origin origin;
    std::string key;         ///< its name in the table above; empty in lists
    std::vector<Node> items; ///< entries of a table, or items of a list
    std::string text;        ///< of Kind::text; else empty
    double number = 0;       ///< of Kind::integer and Kind::real
    bool flag = false;       ///< of Kind::boolean

    [[nodiscard]] bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
    [[nodiscard]] bool is_list() const { return kind == Kind::list; }

    /// The entry of that name, or null.
    [[nodiscard]] const Node *find(std::string_view name) const;
    [[nodiscard]] Node *find(std::string_view name);
};

/// The value as the user wrote it, for messages: `"5 kg"`, `-3.5`, `a table`.
[[nodiscard]] std::string shown(const Node &node);

/// A number with its unit as the user wrote it, `"420 mm"`; else its value in SI, `0.42 m`, in
/// digits that tell it from another one.
[[nodiscard]] std::string as_written(const Node *node, double value, std::string_view unit,
                                     double other);

/// `text` in quotation marks, cut where it is long, control characters replaced.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A key, or which items of a list: one, those that have a `name`, or (without either) every one.
struct PathStep {
    std::string key;                  ///< empty: items
    std::optional<std::size_t> index; ///< "[1]"
    std::optional<std::string> name;  ///< "[left]"
};

/// Steps of "shaft.segments[1].outer", "bearing[*].k" or "bearing[left].k"; empty where the text is
/// no path.
[[nodiscard]] std::vector<PathStep> parse_path(std::string_view text);

/// Whether an item of a list has this `name`.
[[nodiscard]] bool is_named(const Node &item, std::string_view name);

/// The node at that path below `root`, or null; also where the path says of many.
[[nodiscard]] const Node *find_path(const Node &root, std::string_view path);

/// Where the entry stands, or the deepest of the entries around it.
[[nodiscard]] Origin origin_of(const Node &root, std::string_view path);

} // namespace whirl::input

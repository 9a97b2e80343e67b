#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whirl::input {

/// Where an entry was written: a line of a file, or an override on the command line (line 0).
struct Origin {
    std::string file; ///< as the user named it, or "--set path=value"
    int line = 0;     ///< from 1; 0: no line to name

    /// "cases/x/case.toml:12".
    [[nodiscard]] std::string text() const;
};

/// A mistake in a case: where it stands, at which entry, what was expected and what was given.
struct Problem {
    Origin origin;
    std::string key; ///< path of the entry, or empty
    std::string text;

    /// "cases/x/case.toml:12: bearing[0].k: expected ..., got ...".
    [[nodiscard]] std::string message() const;
};

/// Collects all mistakes of a case, so that the user sees them at once.
class Problems {
  public:
    /// `text` says what was expected and what was given; `key` is the path of the entry, or empty.
    /// Of more than a thousand the rest is counted.
    void add(Origin origin, std::string key, std::string text);

    [[nodiscard]] bool empty() const { return _problems.empty(); }
    [[nodiscard]] std::size_t count() const { return _problems.size() + _more; }

    /// Those of one file together and in the order of their lines.
    [[nodiscard]] std::vector<Problem> sorted() const;

    /// Throws model::BadInput with one line for each problem, "origin: key: text", in that order;
    /// does nothing where there is no problem.
    void throw_if_any() const;

  private:
    std::vector<Problem> _problems;
    std::size_t _more = 0; ///< beyond those
};

/// `, did you mean "x"?` for the nearest candidate, or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string> &candidates);

/// The same, but `, known are a, b, c` where none is near.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string> &candidates);

/// A number for a message with six digits, or with all it has where `other` would read the same.
[[nodiscard]] std::string digits_apart(double value, double other);

/// What may have been meant by a text in place of a number: its first comma is between digits.
[[nodiscard]] std::string decimal_comma_hint(std::string_view text);

} // namespace whirl::input

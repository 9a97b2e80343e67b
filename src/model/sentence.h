#pragma once

#include "model/quantity.h"

#include <concepts>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::model {

/// Numbers of a sentence that share a unit: "3 rad/s", "3 to 4 rad/s", "1, 2 and 3 rad/s".
struct Value {
    std::vector<double> numbers;
    Quantity of = Quantity::number;
    int digits = 6;       ///< significant ones
    bool from_to = false; ///< a range; else a list
    bool sign = false;    ///< of positive numbers too

    [[nodiscard]] Value with_sign() const {
        Value out = *this;
        out.sign = true;
        return out;
    }
};

/// Makes values of one quantity: as::speed(x), as::speed.range(a, b), as::speed.list(speeds).
struct ValueOf {
    Quantity of;

    [[nodiscard]] Value operator()(double number, int digits = 6) const {
        return {{number}, of, digits};
    }
    [[nodiscard]] Value range(double from, double to, int digits = 6) const {
        return {{from, to}, of, digits, true};
    }
    [[nodiscard]] Value list(const std::vector<double> &numbers, int digits = 6) const {
        return {numbers, of, digits};
    }
};
namespace as {
inline constexpr ValueOf number{Quantity::number};
inline constexpr ValueOf speed{Quantity::speed};
inline constexpr ValueOf frequency{Quantity::frequency};
inline constexpr ValueOf rate{Quantity::rate};
inline constexpr ValueOf length{Quantity::length};
inline constexpr ValueOf amplitude{Quantity::amplitude};
inline constexpr ValueOf deflection{Quantity::deflection};
inline constexpr ValueOf force{Quantity::force};
inline constexpr ValueOf stiffness{Quantity::stiffness};
inline constexpr ValueOf damping{Quantity::damping};
inline constexpr ValueOf mass{Quantity::mass};
inline constexpr ValueOf inertia{Quantity::inertia};
inline constexpr ValueOf imbalance{Quantity::imbalance};
inline constexpr ValueOf moment{Quantity::moment};
inline constexpr ValueOf time{Quantity::time};
inline constexpr ValueOf angle{Quantity::angle};
inline constexpr ValueOf velocity{Quantity::velocity};
inline constexpr ValueOf acceleration{Quantity::acceleration};
inline constexpr ValueOf pressure{Quantity::pressure};
inline constexpr ValueOf density{Quantity::density};
inline constexpr ValueOf inverse_mass{Quantity::inverse_mass};
} // namespace as

/// The units in which a sentence is written.
using UnitOf = std::function<Unit(Quantity)>;

/// What a result says in words: words and numbers that know what they are, so that each reader gets
/// them in units of his own. Numbers never stand in the words.
///
///     Sentence("the list of critical speeds is complete up to {}", as::speed(complete_to))
///
/// Each {} takes a value with its unit, a text, a whole number or another sentence.
class Sentence {
  public:
    Sentence() = default;
    /// Without values.
    Sentence(const char *words); // NOLINT(google-explicit-constructor)
    /// What somebody else says, as it is: input, a library.
    explicit Sentence(const std::string &words);

    template <class First, class... More>
    Sentence(std::string_view pattern, const First &first, const More &...more) {
        take(pattern, {Sentence::part(first), Sentence::part(more)...});
    }

    /// In SI.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string text(const UnitOf &units) const;
    operator std::string() const { return text(); } // NOLINT(google-explicit-constructor)

    Sentence &operator+=(const Sentence &more);
    [[nodiscard]] bool empty() const { return _pieces.empty(); }
    [[nodiscard]] std::size_t find(std::string_view words) const { return text().find(words); }
    [[nodiscard]] bool starts_with(std::string_view words) const {
        return text().starts_with(words);
    }
    /// The words alone, with {} for values.
    [[nodiscard]] std::string pattern() const;

    friend std::ostream &operator<<(std::ostream &stream, const Sentence &sentence);
    friend bool operator==(const Sentence &a, const Sentence &b) { return a.text() == b.text(); }
    friend bool operator==(const Sentence &a, const std::string &b) { return a.text() == b; }

  private:
    /// Words, or a value.
    struct Piece {
        std::string words;
        Value value;
    };
    using Pieces = std::vector<Piece>;

    void take(std::string_view pattern, const std::vector<Sentence> &parts);

    static Sentence part(const Value &value);
    static Sentence part(std::string_view words);
    static Sentence part(const std::string &words) { return part(std::string_view(words)); }
    static Sentence part(const char *words) { return part(std::string_view(words)); }
    static Sentence part(const Sentence &sentence) { return sentence; }
    static Sentence part(std::integral auto count) { return part(std::to_string(count)); }
    static Sentence part(bool) = delete;
    static Sentence part(char) = delete;
    static Sentence part(double) = delete; // say what it is: as::number(x), as::speed(x)

    Pieces _pieces;
};

/// Sentences one after another, with words between.
[[nodiscard]] Sentence joined(const std::vector<Sentence> &sentences, const char *between);

/// A number for readers, at most `digits` significant digits; without a power of ten below 1e6.
[[nodiscard]] std::string readable(double value, int digits);

} // namespace whirl::model

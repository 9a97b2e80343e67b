#pragma once

#include "input/units.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::input {

/// A part of a unit: a word with its exponent, or what stands between words.
struct UnitPart {
    enum class Kind { word, times, over, open, close, one };
    Kind kind = Kind::word;
    std::string text; ///< of a word, as it was written
    int power = 1;    ///< of a word or of what a parenthesis closes
};

/// Parts of a unit as engineers write it: "lb-in-s2", "N·s/m", "kg m²", "oz.-in.", "min⁻¹". Empty
/// where a text is no product of words with exponents: a number in it would multiply the one
/// before the unit, "50 mm 2", and is none (but for the one of "1/s").
[[nodiscard]] std::optional<std::vector<UnitPart>> parts_of_unit(std::string_view unit);

/// The parts as one text again, "lb.in.s2", in the words of the user.
[[nodiscard]] std::string text_of(const std::vector<UnitPart> &parts);

/// What UDUNITS-2 reads: words that it does not know by those it does ("tr" -> "turn").
/// @param pounds_force  pounds and ounces are forces
[[nodiscard]] std::string for_udunits(const std::vector<UnitPart> &parts, bool pounds_force);

/// Why a word is not taken, though UDUNITS-2 may know it: it has two meanings in workshops, as
/// "gr", or another one than most who write it mean, as "Mm". Empty: it is.
[[nodiscard]] std::string two_meanings(const std::vector<UnitPart> &parts, Quantity quantity);

/// A sign, and what stands for it in ASCII.
struct Replacement {
    std::string_view from, to;
};
/// The text with each sign beyond ASCII that the table has replaced, from its beginning on.
[[nodiscard]] std::string replaced_signs(std::string_view text, std::span<const Replacement> table);

/// Signs that typesetting and spreadsheets put in place of ASCII: blanks of all widths, products,
/// minus signs, superscripts, micro, units in one character ("㎜").
[[nodiscard]] std::string with_plain_signs(std::string_view text);

/// Of the ten of ASCII.
[[nodiscard]] bool is_digit(char c);

/// Longest text of a unit, bytes.
inline constexpr std::size_t longest_unit = 60;

} // namespace whirl::input

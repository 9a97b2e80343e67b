#pragma once

#include "model/quantity.h"

#include <optional>
#include <string>
#include <string_view>

namespace whirl::input {

using model::Quantity;

/// The quantity with its article and SI unit, for messages: "a stiffness in N/m".
[[nodiscard]] std::string describe(Quantity quantity);

/// Whether it counts turns as radians: spins and whirls.
[[nodiscard]] inline bool turns(Quantity quantity) {
    return quantity == Quantity::speed || quantity == Quantity::frequency;
}

/// Multiplier that turns a value in `unit` ("mm", "lbf/in", "rpm") into the SI unit.
///
/// The unit language is that of UDUNITS-2 in the spellings of engineers (unit_spelling.h), with Hz
/// counted as a whole turn a second (2 pi rad/s). An angle or angular speed must name an angle:
/// "1/s" is refused, since it may mean turns or radians; "1/min" is rpm in practice. Where a force
/// is meant pounds and ounces are forces. Empty where the unit is unknown, has another dimension,
/// an offset (degC), a number in it, or two meanings (gr).
/// @throws model::BadInput where the UDUNITS-2 database is not installed.
[[nodiscard]] std::optional<double> unit_factor(std::string_view unit, Quantity quantity);

/// `value` times `factor`, exactly rounded where the factor or its inverse is a whole number, so
/// that "35 mm" is the same number as 0.035.
[[nodiscard]] double scaled(double value, double factor);

/// A finite number without unit, or empty: "12", "-1e5", "+.5".
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The value in SI of a number, or of a number with its unit ("25 mm"); empty where the text is
/// something else, the unit does not fit the quantity or the value is not finite.
[[nodiscard]] std::optional<double> parse_quantity(std::string_view text, Quantity quantity);

/// What was meant by a text that parse_quantity() refuses, for the end of a message: `, did you
/// mean "2.5 in"?`, `; "gr" may be a gram or a grain ...`. Nothing where that is not known.
[[nodiscard]] std::string quantity_hint(std::string_view text, Quantity quantity);

/// The same of a unit alone.
[[nodiscard]] std::string unit_hint(std::string_view unit, Quantity quantity);

/// The number that a text begins with, in plain signs, and the rest of it.
struct LeadingNumber {
    double value = 0;
    std::string rest;
};
[[nodiscard]] std::optional<LeadingNumber> leading_number(std::string_view text);

/// `text` without white space at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

} // namespace whirl::input

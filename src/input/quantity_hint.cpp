#include "input/problems.h"
#include "input/unit_spelling.h"
#include "input/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

namespace whirl::input {
namespace {

using Parts = std::vector<UnitPart>;

/// Words of units in the case of letters that counts, the usual one of each first.
constexpr std::array usual_words{"m",   "mm",  "cm",   "um",  "in",  "ft",  "mil", "kg",  "g",
                                 "mg",  "t",   "lb",   "lbf", "lbm", "oz",  "kgf", "N",   "kN",
                                 "MN",  "daN", "dyn",  "Nm",  "kNm", "Nmm", "Ns",  "Pa",  "kPa",
                                 "MPa", "GPa", "bar",  "psi", "ksi", "Msi", "s",   "ms",  "min",
                                 "rad", "deg", "mrad", "Hz",  "kHz", "rpm", "rev", "slug"};

bool same_letters(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    });
}

/// The unit where every word of `parts` is replaced, if that is one of the quantity.
template <class Replace>
std::string replaced(Parts parts, Quantity quantity, const Replace &replace) {
    for (UnitPart &part : parts)
        if (part.kind == UnitPart::Kind::word)
            part.text = replace(part.text);
    const std::string unit = text_of(parts);
    return unit_factor(unit, quantity) ? unit : "";
}

std::string in_usual_letters(const std::string &word) {
    const auto usual = std::ranges::find_if(
        usual_words, [&](const char *known) { return same_letters(known, word); });
    return usual == usual_words.end() ? word : *usual;
}

/// A mass that is meant as the force of its weight.
std::string as_force(const std::string &word) {
    return word == "kg" || word == "g" || word == "t" ? word + "f" : word;
}

std::string as_mass(const std::string &word) {
    return word == "kgf" || word == "gf" || word == "lbf" ? word.substr(0, word.size() - 1) : word;
}

std::string as_length(const std::string &word) {
    return word == "'" ? "ft" : word == "\"" ? "in" : word;
}

/// The unit in the letters and words that make it one of the quantity; empty where nothing does.
std::string respelled(std::string_view unit, Quantity quantity) {
    const auto parts = parts_of_unit(unit);
    if (!parts || !two_meanings(*parts, quantity).empty())
        return "";
    for (const auto &replace : {in_usual_letters, as_force, as_mass, as_length})
        if (std::string found = replaced(*parts, quantity, replace); !found.empty())
            return found;
    return replaced(*parts, quantity,
                    [](const std::string &word) { return as_force(in_usual_letters(word)); });
}

/// The unit of the quantity that was meant by a text; empty where none is found.
std::string meant_unit(std::string_view unit, Quantity quantity) {
    if (unit.size() > longest_unit)
        return "";
    if (std::string found = respelled(unit, quantity); !found.empty())
        return found;
    for (std::size_t k = 1; k < unit.size(); ++k) { // "gmm"
        const std::string apart = fmt::format("{} {}", unit.substr(0, k), unit.substr(k));
        if (unit_factor(apart, quantity))
            return apart;
        if (std::string found = respelled(apart, quantity); !found.empty())
            return found;
    }
    if (const std::string turning = fmt::format("{} rad", unit);
        quantity == Quantity::angle && unit_factor(turning, quantity))
        return turning;
    return "";
}

/// Units of a quantity in which it is often given, for a word that is a slip away; of those that no
/// key of a case has, or that have no unit, none.
std::vector<std::string> usual_units(Quantity quantity) {
    static const std::map<Quantity, std::vector<std::string>> units{
        {Quantity::length, {"mm", "cm", "inch", "foot", "metre", "micron", "mil"}},
        {Quantity::amplitude, {"mm", "cm", "inch", "foot", "metre", "micron", "mil"}},
        {Quantity::mass, {"kg", "gram", "lb", "pound", "slug", "tonne"}},
        {Quantity::inertia, {"kg m2", "kg mm2", "g mm2", "lb in2", "lb in s2", "lb ft2"}},
        {Quantity::stiffness,
         {"N/m", "N/mm", "kN/mm", "N/um", "MN/m", "lbf/in", "kgf/mm", "dyn/cm"}},
        {Quantity::damping, {"N s/m", "N s/mm", "kN s/m", "lbf s/in", "kgf s/mm"}},
        {Quantity::tilt_stiffness, {"N m/rad", "kN m/rad", "lbf in/rad"}},
        {Quantity::tilt_damping, {"N m s/rad", "lbf in s/rad"}},
        {Quantity::pressure, {"Pa", "MPa", "GPa", "N/mm2", "psi", "ksi", "Msi", "kgf/mm2", "bar"}},
        {Quantity::density, {"kg/m3", "g/cm3", "t/m3", "lb/in3", "slug/ft3"}},
        {Quantity::angle, {"deg", "rad", "rev", "degree", "radian"}},
        {Quantity::speed, {"rpm", "rad/s", "Hz", "rev/min", "rev/s", "deg/s", "1/min"}},
        {Quantity::frequency, {"rpm", "rad/s", "Hz", "rev/min", "rev/s", "deg/s", "1/min"}},
        {Quantity::time, {"ms", "min", "second", "minute", "hour"}},
        {Quantity::force, {"kN", "lbf", "kgf", "dyn", "newton"}},
        {Quantity::imbalance, {"g mm", "kg mm", "kg m", "oz in", "g cm", "g in"}},
        {Quantity::moment, {"N m", "kN m", "N mm", "lbf in", "lbf ft", "kgf m"}},
        {Quantity::velocity, {"mm/s", "m/s", "in/s", "um/s"}},
        {Quantity::acceleration, {"m/s2", "mm/s2", "in/s2", "ft/s2"}},
        {Quantity::rate, {"1/s", "1/min"}},
        {Quantity::influence, {"um/(g mm)", "m/(kg m)", "mil/(oz in)"}}};
    const auto found = units.find(quantity);
    return found == units.end() ? std::vector<std::string>() : found->second;
}

/// ", did you mean "50 g mm"?", the number in it as it was written.
std::string meant(double number, std::string_view unit) {
    return fmt::format(", did you mean \"{:.12g}{}{}\"?", number, unit.empty() ? "" : " ", unit);
}

/// A whole number of digits taken off the front; empty where there is none, or one of more than
/// nine.
std::optional<double> take_digits(std::string_view &text) {
    std::size_t count = 0;
    while (count < text.size() && is_digit(text[count]))
        ++count;
    if (count == 0 || count > 9)
        return std::nullopt;
    double value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = 10 * value + (text[i] - '0');
    text.remove_prefix(count);
    return value;
}

/// "2 1/2 in", "2-1/2 in", "1/2 in": what they are in decimals.
std::string mixed_fraction(std::string_view text, Quantity quantity) {
    const bool minus = text.starts_with('-');
    if (minus)
        text.remove_prefix(1);
    auto whole = take_digits(text);
    if (!whole)
        return "";
    std::optional<double> over = whole;
    if (!trimmed(text).starts_with('/')) {
        while (text.starts_with(' ') || text.starts_with('-'))
            text.remove_prefix(1);
        over = take_digits(text);
    } else {
        whole = 0;
    }
    text = trimmed(text);
    if (!over || !text.starts_with('/'))
        return "";
    text = trimmed(text.substr(1));
    const auto under = take_digits(text);
    text = trimmed(text);
    if (!under || *under == 0)
        return "";
    const std::string unit = text.empty() || unit_factor(text, quantity)
                                 ? std::string(text)
                                 : meant_unit(text, quantity);
    if (unit.empty() && !text.empty())
        return "";
    return meant((minus ? -1 : 1) * (*whole + *over / *under), unit);
}

/// "5 x 10^6 N/m", "5*10^6", "5 10^6", "5D6": with an exponent.
std::string power_of_ten(const LeadingNumber &number, Quantity quantity) {
    std::string_view rest = number.rest;
    double power = 1;
    if (rest.starts_with('D') || rest.starts_with('d')) { // of FORTRAN
        rest.remove_prefix(1);
    } else {
        if (rest.starts_with("x") || rest.starts_with("X") || rest.starts_with("*"))
            rest = trimmed(rest.substr(1));
        if (!rest.starts_with("10"))
            return "";
        rest = rest.substr(2);
        if (rest.starts_with("**"))
            rest = rest.substr(2);
        else if (rest.starts_with("^"))
            rest = rest.substr(1);
        else if (!rest.starts_with("-^")) // superscript minus
            return "";
    }
    if (rest.starts_with('-') || rest.starts_with('+')) {
        power = rest[0] == '-' ? -1 : 1;
        rest.remove_prefix(1);
    }
    double exponent = 0;
    bool any = false;
    // Superscripts come one by one, each with its own "^".
    for (; !rest.empty() && (is_digit(rest[0]) || (rest[0] == '^' && rest.size() > 1)) &&
           exponent < 100;
         rest.remove_prefix(1))
        if (rest[0] != '^') {
            exponent = 10 * exponent + (rest[0] - '0');
            any = true;
        }
    rest = trimmed(rest);
    const std::string unit = rest.empty() || unit_factor(rest, quantity)
                                 ? std::string(rest)
                                 : meant_unit(rest, quantity);
    if (!any || (unit.empty() && !rest.empty()))
        return "";
    return fmt::format(", did you mean \"{:g}e{:g}{}{}\"?", number.value, power * exponent,
                       unit.empty() ? "" : " ", unit);
}

/// "1,200 rpm", "1 200 rpm", "1'200", "1.200,5": digits in groups of three.
std::string thousands(std::string_view text, Quantity quantity) {
    std::string digits;
    if (text.starts_with('-') || text.starts_with('+')) {
        digits += text[0];
        text.remove_prefix(1);
    }
    char separator = 0;
    std::size_t group = 0;
    std::size_t groups = 1;
    for (; !text.empty(); text.remove_prefix(1)) {
        const char c = text[0];
        if (is_digit(c)) {
            digits += c;
            ++group;
        } else if ((c == ',' || c == ' ' || c == '\'' || c == '_' || c == '.') && text.size() > 1 &&
                   is_digit(text[1]) && (separator == 0 || separator == c)) {
            if (group == 0 || group > 3 || (groups > 1 && group != 3))
                return "";
            separator = c;
            group = 0;
            ++groups;
        } else {
            break;
        }
    }
    if (groups < 2 || group != 3)
        return "";
    const std::size_t whole = digits.size();
    if (text.starts_with('.') || text.starts_with(',')) { // decimals
        digits += '.';
        text.remove_prefix(1);
        for (; !text.empty() && is_digit(text[0]); text.remove_prefix(1))
            digits += text[0];
    }
    if (separator == '.' && groups == 2 && digits.size() == whole)
        return ""; // it is the decimal point
    const std::string_view unit = trimmed(text);
    if (!unit.empty() && !unit_factor(unit, quantity))
        return "";
    const std::string end = unit.empty() ? "" : " " + std::string(unit);
    if (separator != ',' || groups > 2 || digits.size() > whole)
        return fmt::format("; write \"{}{}\", without a separator of thousands", digits, end);
    return fmt::format("; write \"{}{}\", or \"{}.{}{}\" if the comma is a decimal one", digits,
                       end, digits.substr(0, digits.size() - 3), digits.substr(digits.size() - 3),
                       end);
}

/// The next smaller unit where only the larger one is written: 3 ft 11.
std::string smaller(std::string_view unit) {
    if (unit == "ft" || unit == "'" || unit == "foot" || unit == "feet")
        return "in";
    return unit == "lb" || unit == "lbs" ? "oz" : "";
}

/// "3 ft 11 in", "3' 11\"", "3 ft 11": their sum in the last unit.
std::string sum_of_units(std::string_view text, Quantity quantity) {
    double sum = 0; // in SI
    std::string last;
    double last_factor = 0;
    int terms = 0;
    for (std::string rest(text); !rest.empty(); ++terms) {
        const auto number = leading_number(rest);
        if (!number || number->value < 0)
            return "";
        const std::size_t end =
            std::min(number->rest.find_first_of("0123456789"), number->rest.size());
        std::string unit(trimmed(std::string_view(number->rest).substr(0, end)));
        while (unit.ends_with('-') || unit.ends_with(','))
            unit = trimmed(unit.substr(0, unit.size() - 1));
        if (unit.empty())
            unit = smaller(last);
        if (unit == "''")
            unit = "in";
        if (!unit_factor(unit, quantity))
            unit = respelled(unit, quantity);
        const auto factor = unit_factor(unit, quantity);
        if (!factor || (terms > 0 && *factor >= last_factor))
            return "";
        sum += number->value * *factor;
        last = unit;
        last_factor = *factor;
        rest = number->rest.substr(end);
    }
    return terms > 1 ? meant(sum / last_factor, last) : "";
}

/// Of a text with more than a number and a unit: what of it is one.
std::string one_number_and_unit(const LeadingNumber &number, Quantity quantity) {
    std::string example;
    for (std::size_t k = std::min(number.rest.size(), longest_unit); k > 0 && example.empty(); --k)
        if (const std::string_view unit = trimmed(std::string_view(number.rest).substr(0, k));
            unit_factor(unit, quantity))
            example = fmt::format(", as \"{:.12g} {}\"", number.value, unit);
    return "; a quantity is one number and one unit" + example;
}

/// What is to be said of a unit that is none of the quantity; a number before it is shown with it.
std::string advice(std::optional<double> number, std::string_view unit, Quantity quantity) {
    const auto parts = parts_of_unit(unit);
    if (parts)
        if (const std::string says = two_meanings(*parts, quantity); !says.empty())
            return "; " + says;
    if (turns(quantity) && unit_factor(unit, Quantity::rate))
        return fmt::format("; \"{}\" does not say whether radians or turns are meant: write "
                           "\"rad/s\" or \"rev/s\"",
                           unit);
    if (quantity == Quantity::rate && unit_factor(unit, Quantity::speed))
        return "; a rate of growth or decay counts no turns: write \"1/s\"";
    if (const std::string found = meant_unit(unit, quantity); !found.empty())
        return number ? meant(*number, found) : fmt::format(", did you mean \"{}\"?", found);
    return did_you_mean(unit.substr(0, longest_unit), usual_units(quantity));
}

} // namespace

std::string unit_hint(std::string_view unit, Quantity quantity) {
    const std::string plain = with_plain_signs(unit.substr(0, longest_unit));
    return advice({}, trimmed(plain), quantity);
}

std::string quantity_hint(std::string_view text, Quantity quantity) {
    const auto number = leading_number(text);
    if (!number || number->rest.empty() || unit_factor(number->rest, quantity))
        return ""; // it is the number that is refused
    const std::string plain = with_plain_signs(text);
    const std::string_view words = trimmed(plain);
    for (const std::string &hint : {thousands(words, quantity), mixed_fraction(words, quantity),
                                    power_of_ten(*number, quantity), sum_of_units(words, quantity),
                                    decimal_comma_hint(words)})
        if (!hint.empty())
            return hint;
    if (!parts_of_unit(number->rest) && number->rest.find_first_of("0123456789") < longest_unit &&
        meant_unit(number->rest, quantity).empty())
        return one_number_and_unit(*number, quantity);
    return advice(number->value, number->rest, quantity);
}

} // namespace whirl::input

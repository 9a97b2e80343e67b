#include "input/units.h"

#include "input/unit_spelling.h"
#include "model/errors.h"

#include <fmt/core.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace whirl::input {
namespace {

/// UDUNITS counts the radian as dimensionless; this says whether a unit may contain it.
enum class AngleRule { never, allowed, required };

struct QuantityInfo {
    const char *name;
    AngleRule angle = AngleRule::never;
};

/// In the order of the enumeration.
constexpr std::array infos{
    QuantityInfo{"a number"},
    QuantityInfo{"an angular speed", AngleRule::required},
    QuantityInfo{"a frequency", AngleRule::required},
    QuantityInfo{"a rate"},
    QuantityInfo{"a length"},
    QuantityInfo{"an amplitude"},
    QuantityInfo{"a deflection"},
    QuantityInfo{"a force"},
    QuantityInfo{"a stiffness"},
    QuantityInfo{"a damping"},
    QuantityInfo{"a mass"},
    QuantityInfo{"an inertia"},
    QuantityInfo{"an imbalance"},
    QuantityInfo{"a torque"},
    QuantityInfo{"a coupling stiffness", AngleRule::allowed},
    QuantityInfo{"a tilt stiffness", AngleRule::allowed},
    QuantityInfo{"a tilt damping", AngleRule::allowed},
    QuantityInfo{"an angular momentum", AngleRule::allowed},
    QuantityInfo{"an energy"},
    QuantityInfo{"a power"},
    QuantityInfo{"a time"},
    QuantityInfo{"an angle", AngleRule::required},
    QuantityInfo{"a slope", AngleRule::allowed},
    QuantityInfo{"a velocity"},
    QuantityInfo{"an acceleration"},
    QuantityInfo{"a pressure"},
    QuantityInfo{"a density"},
    QuantityInfo{"a receptance"},
    QuantityInfo{"an inverse mass"},
};
static_assert(infos.size() == model::quantities);

const QuantityInfo &info(Quantity quantity) { return infos.at(static_cast<std::size_t>(quantity)); }

/// Owns what a function of the library releases.
template <auto release> struct Release {
    template <class T> void operator()(T *resource) const { release(resource); }
};
using System = std::unique_ptr<ut_system, Release<ut_free_system>>;
using Unit = std::unique_ptr<ut_unit, Release<ut_free>>;
using Converter = std::unique_ptr<cv_converter, Release<cv_free>>;

Unit parse_unit(const ut_system *system, std::string_view text) {
    return Unit(ut_parse(system, std::string(text).c_str(), UT_UTF8));
}

void add_symbol(const ut_system *system, const char *symbol, const char *definition) {
    const Unit unit = parse_unit(system, definition);
    if (unit && !parse_unit(system, symbol))
        ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
}

/// The database of units; reading it takes some 5 ms, so only the first unit that is not common
/// asks for it.
const ut_system *unit_system() {
    static const System system = [] {
        ut_set_error_message_handler(ut_ignore);
        System read(ut_read_xml(nullptr));
        if (!read)
            throw model::BadInput("the UDUNITS-2 database of units cannot be read");
        // A frequency of whirl or spin is counted in turns; UDUNITS has 1 Hz = 1/s = 1 rad/s.
        ut_unmap_symbol_to_unit(read.get(), "Hz", UT_ASCII);
        ut_unmap_name_to_unit(read.get(), "hertz", UT_ASCII);
        add_symbol(read.get(), "Hz", "turn/s");
        add_symbol(read.get(), "hertz", "turn/s");
        ut_unmap_symbol_to_unit(read.get(), "oz", UT_ASCII); // a volume
        add_symbol(read.get(), "oz", "0.0625 lb");
        add_symbol(read.get(), "Nm", "N.m");
        add_symbol(read.get(), "Ns", "N.s");
        add_symbol(read.get(), "Nmm", "N.mm");
        add_symbol(read.get(), "Nms", "N.m.s");
        return read;
    }();
    return system.get();
}

/// True where the radian is part of the unit, spelled out in basic units.
bool contains_angle(const ut_unit *unit) {
    std::array<char, 256> text{};
    const int length = ut_format(unit, text.data(), text.size(), UT_ASCII | UT_DEFINITION);
    return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

} // namespace

std::string describe(Quantity quantity) {
    const std::string unit = model::names_of(quantity).si;
    return info(quantity).name + (unit.empty() ? "" : " in " + unit);
}

std::string_view trimmed(std::string_view text) {
    constexpr const char *blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

double scaled(double value, double factor) {
    constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
    const double whole = std::round(factor);
    if (std::abs(factor - whole) <= round_off * factor)
        return value * whole;
    const double inverse = std::round(1 / factor);
    if (std::abs(1 / factor - inverse) <= round_off / factor)
        return value / inverse;
    return value * factor;
}

namespace {

/// What nearly every case is written in, known without the database: reading that takes longer than
/// some analyses.
struct CommonUnit {
    std::string_view name;
    Quantity quantity;
    double factor;
};
constexpr std::array common_units{
    CommonUnit{"rpm", Quantity::speed, std::numbers::pi / 30},
    CommonUnit{"rad/s", Quantity::speed, 1},
    CommonUnit{"deg", Quantity::angle, std::numbers::pi / 180},
    CommonUnit{"m", Quantity::length, 1},
    CommonUnit{"cm", Quantity::length, 0.01},
    CommonUnit{"mm", Quantity::length, 0.001},
    CommonUnit{"g", Quantity::mass, 0.001},
    CommonUnit{"g mm", Quantity::imbalance, 1e-6},
};

} // namespace

std::optional<double> unit_factor(std::string_view text, Quantity quantity) {
    std::string_view name = trimmed(text);
    if (name == "r.p.m." || name == "r.p.m")
        name = "rpm";
    for (const CommonUnit &unit : common_units)
        if (unit.name == name && unit.quantity == quantity)
            return unit.factor;
    const auto parts = parts_of_unit(name);
    if (!parts || !two_meanings(*parts, quantity).empty())
        return std::nullopt;
    std::string spelled = for_udunits(*parts, false);
    if (turns(quantity) && (spelled == "1/min" || spelled == "min^-1"))
        spelled = "rpm"; // what data sheets of machines mean by it
    if (quantity == Quantity::acceleration && (name == "g" || name == "G" || name == "g0"))
        spelled = "standard_free_fall"; // no gram is meant
    const AngleRule rule = info(quantity).angle;
    const std::string_view si = model::names_of(quantity).si;
    const Unit wanted = parse_unit(unit_system(), si.empty() ? "1" : si);
    Unit unit = parse_unit(unit_system(), spelled);
    if (wanted && !(unit && ut_are_convertible(unit.get(), wanted.get())))
        unit = parse_unit(unit_system(), for_udunits(*parts, true));
    if (!unit || !wanted || !ut_are_convertible(unit.get(), wanted.get()))
        return std::nullopt;
    const bool angle = contains_angle(unit.get());
    if ((angle && rule == AngleRule::never) || (!angle && rule == AngleRule::required))
        return std::nullopt;
    const Converter converter(ut_get_converter(unit.get(), wanted.get()));
    if (!converter || cv_convert_double(converter.get(), 0.0) != 0.0)
        return std::nullopt;
    const double factor = cv_convert_double(converter.get(), 1.0);
    if (!std::isfinite(factor) || factor <= 0)
        return std::nullopt;
    return factor;
}

std::optional<LeadingNumber> leading_number(std::string_view text) {
    constexpr std::size_t longest = 200; // bytes
    if (text.size() > longest)
        return std::nullopt;
    const std::string plain = with_plain_signs(text);
    text = trimmed(plain);
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    LeadingNumber number;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
    if (error != std::errc() || !std::isfinite(number.value))
        return std::nullopt;
    number.rest = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    return number;
}

std::optional<double> parse_number(std::string_view text) {
    const auto number = leading_number(text);
    return number && number->rest.empty() ? std::optional(number->value) : std::nullopt;
}

std::optional<double> parse_quantity(std::string_view text, Quantity quantity) {
    const auto number = leading_number(text);
    if (!number || number->rest.empty())
        return number ? std::optional(number->value) : std::nullopt;
    const auto factor = unit_factor(number->rest, quantity);
    if (!factor)
        return std::nullopt;
    const double value = scaled(number->value, *factor);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace whirl::input

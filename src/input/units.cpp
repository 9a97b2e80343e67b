#include "input/units.h"

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
    const char *unit;
    AngleRule angle = AngleRule::never;
};

/// In the order of the enumeration.
constexpr std::array quantities{
    QuantityInfo{"a number", "1"},
    QuantityInfo{"a length", "m"},
    QuantityInfo{"a mass", "kg"},
    QuantityInfo{"an inertia", "kg m2"},
    QuantityInfo{"a stiffness", "N/m"},
    QuantityInfo{"a damping", "N s/m"},
    QuantityInfo{"a tilt stiffness", "N m/rad", AngleRule::allowed},
    QuantityInfo{"a tilt damping", "N m s/rad", AngleRule::allowed},
    QuantityInfo{"a pressure", "Pa"},
    QuantityInfo{"a density", "kg/m3"},
    QuantityInfo{"an angle", "rad", AngleRule::required},
    QuantityInfo{"an angular speed", "rad/s", AngleRule::required},
    QuantityInfo{"a time", "s"},
    QuantityInfo{"a force", "N"},
    QuantityInfo{"an imbalance", "kg m"},
    QuantityInfo{"a torque", "N m"},
    QuantityInfo{"an acceleration", "m/s2"},
    QuantityInfo{"a rate", "1/s"},
};
static_assert(quantities.size() == static_cast<std::size_t>(Quantity::rate) + 1);

const QuantityInfo &info(Quantity quantity) {
    return quantities.at(static_cast<std::size_t>(quantity));
}

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
        add_symbol(read.get(), "hz", "turn/s");
        add_symbol(read.get(), "cpm", "turn/min"); // cycles
        add_symbol(read.get(), "deg", "degree");
        add_symbol(read.get(), "rev", "turn");
        add_symbol(read.get(), "RPM", "rpm");
        add_symbol(read.get(), "thou", "mil");
        add_symbol(read.get(), "lbm", "lb");
        ut_unmap_symbol_to_unit(read.get(), "oz", UT_ASCII); // a volume
        add_symbol(read.get(), "oz", "0.0625 lb");
        add_symbol(read.get(), "Nm", "N.m");
        add_symbol(read.get(), "Ns", "N.s");
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
    const std::string unit = unit_of(quantity);
    return info(quantity).name + (unit.empty() ? "" : " in " + unit);
}

model::Quantity in_results(Quantity quantity) {
    switch (quantity) {
    case Quantity::dimensionless:
        return model::Quantity::number;
    case Quantity::length:
        return model::Quantity::length;
    case Quantity::mass:
        return model::Quantity::mass;
    case Quantity::inertia:
        return model::Quantity::inertia;
    case Quantity::stiffness:
        return model::Quantity::stiffness;
    case Quantity::damping:
        return model::Quantity::damping;
    case Quantity::tilt_stiffness:
        return model::Quantity::tilt_stiffness;
    case Quantity::tilt_damping:
        return model::Quantity::tilt_damping;
    case Quantity::pressure:
        return model::Quantity::pressure;
    case Quantity::density:
        return model::Quantity::density;
    case Quantity::angle:
        return model::Quantity::angle;
    case Quantity::angular_speed:
        return model::Quantity::speed;
    case Quantity::time:
        return model::Quantity::time;
    case Quantity::force:
        return model::Quantity::force;
    case Quantity::imbalance:
        return model::Quantity::imbalance;
    case Quantity::torque:
        return model::Quantity::moment;
    case Quantity::acceleration:
        return model::Quantity::acceleration;
    case Quantity::rate:
        return model::Quantity::rate;
    }
    return model::Quantity::number;
}

std::string unit_of(Quantity quantity) {
    return quantity == Quantity::dimensionless ? "" : info(quantity).unit;
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

/// "lb/in" for lbf/in: where a force is meant, a pound is one.
std::string with_pounds_force(std::string_view name) {
    std::string out;
    const auto letter = [&name](std::size_t k) {
        return k < name.size() && std::isalpha(static_cast<unsigned char>(name[k])) != 0;
    };
    for (std::size_t k = 0; k < name.size(); ++k) {
        const bool pound =
            name.substr(k, 2) == "lb" && !letter(k + 2) && (k == 0 || !letter(k - 1));
        out += pound ? "lbf" : std::string(1, name[k]);
        k += pound ? 1 : 0;
    }
    return out;
}

/// What nearly every case is written in, known without the database: reading that takes longer than
/// some analyses.
struct CommonUnit {
    std::string_view name;
    Quantity quantity;
    double factor;
};
constexpr std::array common_units{
    CommonUnit{"rpm", Quantity::angular_speed, std::numbers::pi / 30},
    CommonUnit{"rad/s", Quantity::angular_speed, 1},
    CommonUnit{"deg", Quantity::angle, std::numbers::pi / 180},
    CommonUnit{"m", Quantity::length, 1},
    CommonUnit{"cm", Quantity::length, 0.01},
    CommonUnit{"mm", Quantity::length, 0.001},
    CommonUnit{"g", Quantity::mass, 0.001},
    CommonUnit{"g mm", Quantity::imbalance, 1e-6},
};

} // namespace

std::optional<double> unit_factor(std::string_view text, Quantity quantity) {
    constexpr std::array per_minute{"1/min", "/min", "min-1", "min^-1", "U/min", "r/min"};
    std::string_view name = trimmed(text);
    if (quantity == Quantity::angular_speed &&
        std::ranges::find(per_minute, name) != per_minute.end())
        name = "rpm"; // what data sheets of machines mean by it
    for (const CommonUnit &unit : common_units)
        if (unit.name == name && unit.quantity == quantity)
            return unit.factor;
    // A further number would multiply: "2 5 m". Only the one of "1/s" is wanted.
    const bool starts_with_number = !name.empty() && (std::isdigit(name[0]) || name[0] == '.');
    if (name.empty() || (starts_with_number && !name.starts_with("1/")))
        return std::nullopt;
    const QuantityInfo &entry = info(quantity);
    const Unit wanted = parse_unit(unit_system(), entry.unit);
    Unit unit = parse_unit(unit_system(), name);
    if (unit && wanted && !ut_are_convertible(unit.get(), wanted.get()))
        unit = parse_unit(unit_system(), with_pounds_force(name));
    if (!unit || !wanted || !ut_are_convertible(unit.get(), wanted.get()))
        return std::nullopt;
    const bool angle = contains_angle(unit.get());
    if ((angle && entry.angle == AngleRule::never) ||
        (!angle && entry.angle == AngleRule::required))
        return std::nullopt;
    const Converter converter(ut_get_converter(unit.get(), wanted.get()));
    if (!converter || cv_convert_double(converter.get(), 0.0) != 0.0)
        return std::nullopt;
    const double factor = cv_convert_double(converter.get(), 1.0);
    if (!std::isfinite(factor) || factor <= 0)
        return std::nullopt;
    return factor;
}

namespace {

struct LeadingNumber {
    double value = 0;
    std::string_view rest;
};

std::optional<LeadingNumber> leading_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    LeadingNumber number;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
    if (error != std::errc() || !std::isfinite(number.value))
        return std::nullopt;
    number.rest = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    return number;
}

} // namespace

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

std::string spaced_unit_hint(std::string_view text, Quantity quantity) {
    const auto number = leading_number(text);
    if (number && unit_factor(number->rest, quantity))
        return ""; // it is the number that is refused
    for (std::size_t k = 1; number && k < number->rest.size(); ++k) {
        const std::string unit =
            fmt::format("{} {}", number->rest.substr(0, k), number->rest.substr(k));
        if (unit_factor(unit, quantity))
            return fmt::format(", did you mean \"{:.6g} {}\"?", number->value, unit);
    }
    return "";
}

} // namespace whirl::input

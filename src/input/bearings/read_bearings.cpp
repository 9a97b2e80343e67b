#include "input/bearings/coefficients.h"
#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

/// The coefficients of a bearing: one row from its keys, or those of its table.
void read_rows(CheckedTable &table, model::Bearing &bearing) {
    const auto has = [&](const char *name) { return table.has(name); };
    const auto constant = read_coefficients(
        [&](const Coefficient &entry) {
            return table.optional_number(entry.name, entry.quantity, entry.range());
        },
        bearing.seal);
    if (const auto mixed = mixed_keys(has, bearing.seal))
        table.fail(mixed->key, mixed->message);
    if (const auto wrong = against_mass(constant.m, has("m")))
        table.fail(wrong->key, wrong->message);
    constexpr std::size_t none = 2; // said, or none that there is
    const std::size_t between = table.choice("interpolation", {"linear", "spline"}, none);
    const bool spline = between == 1;
    if (!table.has("table")) {
        if (between != none)
            table.fail("interpolation", "expected it with a table, got no table");
        bearing.rows.push_back(constant);
        return;
    }
    bool mass = false;
    bool others = false;
    for (const Coefficient &entry : bearing_coefficients())
        (entry.quantity == Quantity::mass ? mass : others) |= has(entry.name);
    const auto path = table.text("table");
    if (others)
        table.fail("table", "expected either table or constant coefficients, got both");
    else if (path)
        read_bearing_table(*path, spline, bearing, table.context());
    if (mass && bearing.has_mass())
        table.fail("table", "expected mass coefficients in the table or beside it, got both");
    for (model::BearingCoefficients &row : bearing.rows)
        if (mass)
            row.m = constant.m;
}

/// A number for both directions, or one for each.
std::optional<Eigen::Vector2d> read_directions(CheckedTable &table, const std::string &key,
                                               const std::string &stem, Quantity quantity,
                                               Range range) {
    const auto both = table.optional_number(key, quantity, range);
    const auto x = table.optional_number(stem + "x", quantity, range);
    const auto y = table.optional_number(stem + "y", quantity, range);
    if (both && (x || y))
        table.fail(key, fmt::format("expected either {0} or {1}x and {1}y, got both", key, stem));
    if (both)
        return Eigen::Vector2d(*both, *both);
    if (!x && !y)
        return std::nullopt;
    for (const char *side : {"x", "y"})
        if (!table.has(stem + side))
            table.fail(stem + side,
                       fmt::format("missing, expected {} beside {}{}", describe(quantity), stem,
                                   *side == 'x' ? "y" : "x"));
    return Eigen::Vector2d(x.value_or(0), y.value_or(0));
}

void read_tilting(CheckedTable &table, model::Bearing &bearing) {
    const double kt = table.number_or("kt", 0, Quantity::tilt_stiffness, Range::not_negative());
    const double ct = table.number_or("ct", 0, Quantity::tilt_damping, Range::not_negative());
    for (model::BearingCoefficients &row : bearing.rows) {
        row.kt.diagonal().setConstant(kt);
        row.ct.diagonal().setConstant(ct);
    }
}

void read_pedestal(CheckedTable &table, model::Bearing &bearing) {
    const auto mass = read_directions(table, "pedestal_mass", "pedestal_mass_", Quantity::mass,
                                      Range::not_negative());
    const auto k =
        read_directions(table, "pedestal_k", "pedestal_k", Quantity::stiffness, Range::positive());
    const auto c = read_directions(table, "pedestal_c", "pedestal_c", Quantity::damping,
                                   Range::not_negative());
    if (!mass && !k && !c)
        return;
    if (!k)
        table.fail("pedestal_k", "missing, expected a stiffness in N/m greater than 0 for the "
                                 "pedestal");
    const Eigen::Vector2d none = Eigen::Vector2d::Zero();
    model::Pedestal &pedestal = bearing.pedestal.emplace();
    pedestal.mass = mass.value_or(none);
    pedestal.k = k.value_or(none);
    pedestal.c = c.value_or(none);
}

bool is_zero(const model::BearingCoefficients &row) {
    return row.k.isZero(0) && row.c.isZero(0) && row.m.isZero(0) && row.kt.isZero(0) &&
           row.ct.isZero(0);
}

/// [[bearing]], or [[seal]]: one without pedestal and resistance to tilting.
void read_supports(CheckedTable &root, bool seal, const char *expected, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables(seal ? "seal" : "bearing")) {
        model::Bearing bearing;
        bearing.seal = seal;
        read_place(table, bearing);
        read_rows(table, bearing);
        if (!seal) {
            read_tilting(table, bearing);
            read_pedestal(table, bearing);
        }
        bearing.clearance = table.optional_number("clearance", Quantity::length, Range::positive());
        table.refuse_unknown();
        if (!bearing.rows.empty() && std::ranges::all_of(bearing.rows, is_zero))
            table.context().problems.add(table.node().origin, table.path(), expected);
        rotor.bearings.push_back(bearing);
    }
}

} // namespace

void read_bearings(CheckedTable &root, model::Rotor &rotor) {
    read_supports(root, false,
                  "expected stiffness, damping or mass (k, c, kxx, ..., m, mxx, ..., kt, ct or "
                  "table), got a bearing with none",
                  rotor);
}

void read_seals(CheckedTable &root, model::Rotor &rotor) {
    read_supports(root, true,
                  "expected stiffness, damping or mass (k, c, kxx, ..., m or table), got a seal "
                  "with none",
                  rotor);
}

} // namespace whirl::input

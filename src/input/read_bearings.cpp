#include "input/csv_table.h"
#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace whirl::input {
namespace {

/// One of the coefficients k.. or c..: its name and place in the 2x2 matrix.
struct Coefficient {
    const char *name;
    Quantity quantity;
    int row;
    int column;
};

constexpr std::array coefficients{
    Coefficient{"kxx", Quantity::stiffness, 0, 0}, Coefficient{"kxy", Quantity::stiffness, 0, 1},
    Coefficient{"kyx", Quantity::stiffness, 1, 0}, Coefficient{"kyy", Quantity::stiffness, 1, 1},
    Coefficient{"cxx", Quantity::damping, 0, 0},   Coefficient{"cxy", Quantity::damping, 0, 1},
    Coefficient{"cyx", Quantity::damping, 1, 0},   Coefficient{"cyy", Quantity::damping, 1, 1}};

/// Coefficients from `number(name, quantity, range)`, which is empty for a name that is not given.
/// @param seal  the same from every direction unless it says otherwise: kyx = -kxy, cyx = -cxy
template <class Number>
model::BearingCoefficients read_coefficients(const Number &number, bool seal) {
    model::BearingCoefficients row;
    if (const auto k = number("k", Quantity::stiffness, Range::not_negative()))
        row.k.diagonal().setConstant(*k);
    if (const auto c = number("c", Quantity::damping, Range::not_negative()))
        row.c.diagonal().setConstant(*c);
    for (const Coefficient &entry : coefficients) {
        Eigen::Matrix2d &matrix = entry.quantity == Quantity::stiffness ? row.k : row.c;
        if (const auto value = number(entry.name, entry.quantity, Range::any()))
            matrix(entry.row, entry.column) = *value;
        else if (seal && entry.row > entry.column) // read after its opposite
            matrix(1, 0) = 0 - matrix(0, 1);
    }
    return row;
}

/// The isotropic key ("k" or "c") that is given together with one of its matrix, or null. That of a
/// seal goes with the coupling.
template <class Has> const char *mixed_key(const Has &has, bool seal) {
    for (const Coefficient &entry : coefficients) {
        const char *isotropic = entry.quantity == Quantity::stiffness ? "k" : "c";
        const bool coupling = seal && entry.row < entry.column;
        if (!coupling && has(isotropic) && has(entry.name))
            return isotropic;
    }
    return nullptr;
}

std::string mixed_message(const std::string &key, bool seal) {
    return fmt::format("expected either {0}{1} or {0}xx, {0}xy, {0}yx, {0}yy, got both", key,
                       seal ? fmt::format(" (and {}xy)", key) : "");
}

void read_bearing_table(const std::string &path, model::Bearing &bearing, ReadContext &context) {
    std::vector<CsvRule> rules{
        {"speed", Quantity::angular_speed}, {"k", Quantity::stiffness}, {"c", Quantity::damping}};
    for (const Coefficient &entry : coefficients)
        rules.push_back({entry.name, entry.quantity});
    CsvTable table((context.folder / path).lexically_normal(), rules, context.problems);
    if (!table.usable())
        return;
    if (!table.has("speed")) {
        context.problems.add(table.header_origin(), "speed",
                             "missing, expected a column of angular speeds");
        return;
    }
    if (!table.has_unit("speed"))
        context.remarks.push_back(
            fmt::format("the speeds of {} have no unit and are taken in rad/s; a header such as "
                        "\"speed [rpm]\" says which",
                        path));
    const auto has = [&](const char *name) { return table.has(name); };
    if (const char *key = mixed_key(has, bearing.seal))
        context.problems.add(table.header_origin(), key, mixed_message(key, bearing.seal));
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double speed = table.number(i, "speed", Range::any());
        if (!bearing.speeds.empty() && speed <= bearing.speeds.back())
            context.problems.add(table.origin(i), "speed",
                                 fmt::format("expected speeds that ascend, got {} rad/s after {}",
                                             speed, bearing.speeds.back()));
        bearing.speeds.push_back(speed);
        bearing.rows.push_back(read_coefficients(
            [&](const char *name, Quantity, Range range) {
                // An empty cell is a coefficient that was forgotten, not one that is 0.
                return table.has(name) ? std::optional(table.number(i, name, range)) : std::nullopt;
            },
            bearing.seal));
    }
}

/// The coefficients of a bearing: one row from its keys, or those of its table.
void read_rows(CheckedTable &table, model::Bearing &bearing) {
    const auto has = [&](const char *name) { return table.has(name); };
    const auto constant =
        read_coefficients([&](const char *name, Quantity quantity,
                              Range range) { return table.optional_number(name, quantity, range); },
                          bearing.seal);
    if (const char *key = mixed_key(has, bearing.seal))
        table.fail(key, mixed_message(key, bearing.seal));
    if (!table.has("table")) {
        bearing.rows.push_back(constant);
        return;
    }
    bool both = has("k") || has("c");
    for (const Coefficient &entry : coefficients)
        both = both || has(entry.name);
    if (both)
        table.fail("table", "expected either table or constant coefficients, got both");
    else if (const auto path = table.text("table"))
        read_bearing_table(*path, bearing, table.context());
}

void read_pedestal(CheckedTable &table, model::Bearing &bearing) {
    const auto mass = table.optional_number("pedestal_mass", Quantity::mass, Range::not_negative());
    const auto k = table.optional_number("pedestal_k", Quantity::stiffness, Range::positive());
    const auto c = table.optional_number("pedestal_c", Quantity::damping, Range::not_negative());
    if (!mass && !k && !c)
        return;
    if (!k)
        table.fail("pedestal_k", "missing, expected a stiffness in N/m greater than 0 for the "
                                 "pedestal");
    bearing.pedestal = model::Pedestal{mass.value_or(0), k.value_or(0), c.value_or(0)};
}

bool is_zero(const model::BearingCoefficients &row) {
    return row.k.isZero(0) && row.c.isZero(0) && row.kt.isZero(0) && row.ct.isZero(0);
}

/// Adds the bearing; refuses one that does nothing.
void add_acting(CheckedTable &table, const model::Bearing &bearing, const char *expected,
                model::Rotor &rotor) {
    const bool nothing = !bearing.rows.empty() && bearing.mass == 0 &&
                         std::all_of(bearing.rows.begin(), bearing.rows.end(), is_zero);
    if (nothing)
        table.context().problems.add(table.node().origin, table.path(), expected);
    rotor.bearings.push_back(bearing);
}

} // namespace

void read_bearings(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("bearing")) {
        model::Bearing bearing;
        bearing.name = table.text("name").value_or("");
        bearing.z = table.number("z", Quantity::length);
        read_rows(table, bearing);
        const double kt = table.number_or("kt", 0, Quantity::tilt_stiffness, Range::not_negative());
        const double ct = table.number_or("ct", 0, Quantity::tilt_damping, Range::not_negative());
        for (model::BearingCoefficients &row : bearing.rows) {
            row.kt.diagonal().setConstant(kt);
            row.ct.diagonal().setConstant(ct);
        }
        read_pedestal(table, bearing);
        table.refuse_unknown();
        add_acting(table, bearing,
                   "expected stiffness or damping (k, c, kxx, ..., kt, ct or table), got a bearing "
                   "with neither",
                   rotor);
    }
}

void read_seals(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("seal")) {
        model::Bearing seal;
        seal.seal = true;
        seal.name = table.text("name").value_or("");
        seal.z = table.number("z", Quantity::length);
        read_rows(table, seal);
        seal.mass = table.number_or("m", 0, Quantity::mass, Range::not_negative());
        table.refuse_unknown();
        add_acting(table, seal,
                   "expected stiffness, damping or mass (k, c, kxx, ..., m or table), got a seal "
                   "with none",
                   rotor);
    }
}

} // namespace whirl::input

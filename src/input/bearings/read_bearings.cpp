#include "input/bearings/spline.h"
#include "input/csv_table.h"
#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::input {
namespace {

using model::BearingCoefficients;

/// A coefficient of a bearing: its name and its place in one of the 2x2 matrices. Without a place
/// it stands for both entries of the diagonal, alike.
struct Coefficient {
    const char *name;
    Quantity quantity;
    CoefficientMatrix matrix;
    int row = -1;
    int column = -1;

    [[nodiscard]] bool on_diagonal() const { return row < 0; }
    /// Range of those that are the same in x and y.
    [[nodiscard]] Range range() const {
        Range range = on_diagonal() ? Range::not_negative() : Range{};
        if (quantity == Quantity::stiffness)
            range.otherwise = "; negative ones are given as kxx and kyy";
        if (quantity == Quantity::damping)
            range.otherwise = "; negative ones are given as cxx and cyy";
        return range;
    }
};

/// What a table over the speed may have; of each matrix what stands for the diagonal first.
constexpr std::array<Coefficient, 15> coefficients = [] {
    constexpr auto k = &BearingCoefficients::k;
    constexpr auto c = &BearingCoefficients::c;
    constexpr auto m = &BearingCoefficients::m;
    return std::array<Coefficient, 15>{{{"k", Quantity::stiffness, k},
                                        {"kxx", Quantity::stiffness, k, 0, 0},
                                        {"kxy", Quantity::stiffness, k, 0, 1},
                                        {"kyx", Quantity::stiffness, k, 1, 0},
                                        {"kyy", Quantity::stiffness, k, 1, 1},
                                        {"c", Quantity::damping, c},
                                        {"cxx", Quantity::damping, c, 0, 0},
                                        {"cxy", Quantity::damping, c, 0, 1},
                                        {"cyx", Quantity::damping, c, 1, 0},
                                        {"cyy", Quantity::damping, c, 1, 1},
                                        {"m", Quantity::mass, m},
                                        {"mxx", Quantity::mass, m, 0, 0},
                                        {"mxy", Quantity::mass, m, 0, 1},
                                        {"myx", Quantity::mass, m, 1, 0},
                                        {"myy", Quantity::mass, m, 1, 1}}};
}();

/// @param number  of a coefficient; empty where it is not given
/// @param seal    the same from every direction unless it says otherwise: kyx = -kxy, cyx = -cxy
template <class Number> BearingCoefficients read_coefficients(const Number &number, bool seal) {
    BearingCoefficients row;
    for (const Coefficient &entry : coefficients) {
        Eigen::Matrix2d &matrix = row.*entry.matrix;
        if (const std::optional<double> value = number(entry)) {
            if (entry.on_diagonal())
                matrix.diagonal().setConstant(*value);
            else
                matrix(entry.row, entry.column) = *value;
        } else if (seal && entry.row > entry.column) { // read after its opposite
            matrix(1, 0) = 0 - matrix(0, 1);
        }
    }
    return row;
}

/// Collects a mistake where k stands beside kxx and so on (that of a seal goes with the coupling).
template <class Table> void refuse_mixed(Table &table, bool seal) {
    const char *both = nullptr;
    for (const Coefficient &entry : coefficients) {
        const bool coupling = seal && entry.row < entry.column;
        if (entry.on_diagonal()) {
            both = entry.name;
        } else if (!coupling && table.has(both) && table.has(entry.name)) {
            table.fail(both, fmt::format("expected either {0}{1} or {0}xx, {0}xy, {0}yx, {0}yy, "
                                         "got both",
                                         both, seal ? fmt::format(" (and {}xy)", both) : ""));
            return;
        }
    }
}

/// Collects a mistake where mass coefficients would push as if there were less than no mass.
/// @param isotropic  given as m
/// @returns whether they do
template <class Table>
bool refuse_negative(const Eigen::Matrix2d &m, bool isotropic, const Table &table) {
    const double coupling = (m(0, 1) + m(1, 0)) / 2;
    const double least = m.trace() / 2 - std::hypot((m(0, 0) - m(1, 1)) / 2, coupling);
    constexpr double rounding = 1e-12; // of products of numbers in the file's units
    if (!(least < -rounding * m.cwiseAbs().maxCoeff()))
        return false;
    const char *key = isotropic ? "m" : m(0, 0) >= 0 && m(1, 1) < 0 ? "myy" : "mxx";
    table.fail(key, fmt::format("expected mass coefficients that resist acceleration in every "
                                "direction (mxx, myy >= 0, ((mxy + myx)/2)^2 <= mxx myy), got "
                                "{:.6g} kg in one",
                                least));
    return true;
}

std::vector<CsvRule> table_columns() {
    std::vector<CsvRule> rules{{"speed", Quantity::speed}};
    for (const Coefficient &entry : coefficients)
        rules.push_back({entry.name, entry.quantity});
    return rules;
}

void read_table_row(const CsvTable &table, const CsvRow &row, model::Bearing &bearing) {
    const double speed = row.number("speed", Quantity::speed);
    if (!bearing.speeds.empty() && speed <= bearing.speeds.back())
        row.fail("speed", fmt::format("expected speeds that ascend, got {:.6g} rad/s after {:.6g}",
                                      speed, bearing.speeds.back()));
    bearing.speeds.push_back(speed);
    const auto number = [&](const Coefficient &entry) {
        // An empty cell is a coefficient that was forgotten, not one that is 0.
        return table.has(entry.name)
                   ? std::optional(row.number(entry.name, entry.quantity, entry.range()))
                   : std::nullopt;
    };
    bearing.rows.push_back(read_coefficients(number, bearing.seal));
    const Eigen::Matrix2d &m = bearing.rows.back().m;
    if (!refuse_negative(m, table.has("m"), row) && m.allFinite() && m != bearing.rows.front().m)
        row.fail(table.has("m") ? "m" : "mxx",
                 "expected the same mass coefficients at every speed, got others than in the "
                 "first row");
}

/// Reads a bearing table (CSV) into the rows of the bearing.
void read_bearing_table(const CheckedEntry &asked, bool spline, model::Bearing &bearing) {
    ReadContext &context = asked.context;
    const CsvTable table(asked, table_columns());
    if (!table.usable())
        return;
    if (!table.has("speed")) {
        table.fail("speed", "missing, expected a column of angular speeds");
        return;
    }
    if (!table.has_unit("speed")) {
        const model::Sentence remark("the speeds of {} have no unit and are taken in rad/s; a "
                                     "header such as \"speed [rpm]\" says which",
                                     asked.node.text);
        if (std::ranges::find(context.remarks, remark) == context.remarks.end()) // table of another
            context.remarks.push_back(remark);
    }
    refuse_mixed(table, bearing.seal);
    const std::size_t before = context.problems.count();
    for (const CsvRow &row : table.rows())
        read_table_row(table, row, bearing);
    if (spline && context.problems.count() == before && !refine_by_spline(bearing))
        table.fail("interpolation", "expected a table that a spline follows smoothly, got one that "
                                    "changes too abruptly: use interpolation = \"linear\"");
}

/// The coefficients of a bearing: one row from its keys, or those of its table.
void read_rows(CheckedTable &table, model::Bearing &bearing) {
    const auto constant = read_coefficients(
        [&](const Coefficient &entry) {
            return table.optional_number(entry.name, entry.quantity, entry.range());
        },
        bearing.seal);
    refuse_mixed(table, bearing.seal);
    refuse_negative(constant.m, table.has("m"), table);
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
    for (const Coefficient &entry : coefficients)
        (entry.quantity == Quantity::mass ? mass : others) |= table.has(entry.name);
    const auto asked = table.text_entry("table");
    if (others)
        table.fail("table", "expected either table or constant coefficients, got both");
    else if (asked)
        read_bearing_table(*asked, spline, bearing);
    if (mass && bearing.has_mass())
        table.fail("table", "expected mass coefficients in the table or beside it, got both");
    for (model::BearingCoefficients &row : bearing.rows)
        if (mass)
            row.m = constant.m;
}

/// `table_min` or `table_max`, with the clearance that belongs to it.
std::optional<model::BearingAtClearance>
read_at_clearance(CheckedTable &table, const std::string &which, const model::Bearing &bearing) {
    const std::string key = "table_" + which;
    const std::string clearance = "clearance_" + which;
    const auto own = table.optional_number(clearance, Quantity::length, Range::positive());
    if (!table.has(key)) {
        if (own)
            table.fail(clearance, fmt::format("expected only with {}, got none", key));
        return std::nullopt;
    }
    const auto asked = table.text_entry(key);
    if (!table.has("table")) {
        table.fail(key, "expected it beside table, got no table");
        return std::nullopt;
    }
    model::Bearing other;
    other.seal = bearing.seal;
    const Node *between = table.find("interpolation");
    if (asked)
        read_bearing_table(*asked, between && between->text == "spline", other);
    if (other.rows.empty())
        return std::nullopt; // with mistakes
    // What stands beside the table holds for this one too.
    bool beside = false;
    for (const Coefficient &entry : coefficients)
        beside |= entry.quantity == Quantity::mass && table.has(entry.name);
    if (beside && other.has_mass())
        table.fail(key, "expected mass coefficients in the table or beside it, got both");
    for (model::BearingCoefficients &row : other.rows)
        if (!bearing.rows.empty()) {
            if (beside)
                row.m = bearing.rows.front().m;
            row.kt = bearing.rows.front().kt;
            row.ct = bearing.rows.front().ct;
        }
    return model::BearingAtClearance{other.speeds, other.rows, own};
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
        bearing.least = read_at_clearance(table, "min", bearing);
        bearing.most = read_at_clearance(table, "max", bearing);
        const auto least = bearing.least ? bearing.least->clearance : std::nullopt;
        const auto most = bearing.most ? bearing.most->clearance : std::nullopt;
        if (least && most && *least >= *most)
            table.fail("clearance_max",
                       fmt::format("expected more than clearance_min = {}, got {}",
                                   as_written(table.find("clearance_min"), *least, "m", *most),
                                   as_written(table.find("clearance_max"), *most, "m", *least)));
        table.refuse_unknown();
        if (!bearing.rows.empty() && std::ranges::all_of(bearing.rows, is_zero))
            table.fail(expected);
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

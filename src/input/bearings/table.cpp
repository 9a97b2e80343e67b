#include "input/bearings/coefficients.h"
#include "input/csv_table.h"

#include <fmt/core.h>

namespace whirl::input {

namespace {

std::vector<CsvRule> table_columns() {
    std::vector<CsvRule> rules{{"speed", Quantity::angular_speed}};
    for (const Coefficient &entry : bearing_coefficients())
        rules.push_back({entry.name, entry.quantity});
    return rules;
}

void read_table_row(CsvTable &table, std::size_t i, model::Bearing &bearing, Problems &problems) {
    const double speed = table.number(i, "speed", Range::any());
    if (!bearing.speeds.empty() && speed <= bearing.speeds.back())
        problems.add(table.origin(i), "speed",
                     fmt::format("expected speeds that ascend, got {:.6g} rad/s after {:.6g}",
                                 speed, bearing.speeds.back()));
    bearing.speeds.push_back(speed);
    bearing.rows.push_back(read_coefficients(
        [&](const Coefficient &entry) {
            // An empty cell is a coefficient that was forgotten, not one that is 0.
            return table.has(entry.name) ? std::optional(table.number(i, entry.name, entry.range()))
                                         : std::nullopt;
        },
        bearing.seal));
    const Eigen::Matrix2d &m = bearing.rows.back().m;
    if (const auto wrong = against_mass(m, table.has("m")))
        problems.add(table.origin(i), wrong->key, wrong->message);
    else if (m.allFinite() && m != bearing.rows.front().m)
        problems.add(table.origin(i), table.has("m") ? "m" : "mxx",
                     "expected the same mass coefficients at every speed, got others than in the "
                     "first row");
}

} // namespace

void read_bearing_table(const std::string &path, bool spline, model::Bearing &bearing,
                        ReadContext &context) {
    CsvTable table((context.folder / path).lexically_normal(), table_columns(), context.problems);
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
    if (const auto mixed =
            mixed_keys([&](const char *name) { return table.has(name); }, bearing.seal))
        context.problems.add(table.header_origin(), mixed->key, mixed->message);
    const std::size_t before = context.problems.count();
    for (std::size_t i = 0; i < table.rows(); ++i)
        read_table_row(table, i, bearing, context.problems);
    if (spline && context.problems.count() == before && !refine_by_spline(bearing))
        context.problems.add(table.header_origin(), "interpolation",
                             "expected a table that a spline follows smoothly, got one that "
                             "changes too abruptly: use interpolation = \"linear\"");
}

} // namespace whirl::input

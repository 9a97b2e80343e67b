// Report of the command rigid-limit.

#include "results/rigid_limit.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace whirl::report {

using results::RigidLimitResult;
using results::RigidLimitRow;
using Rows = std::vector<RigidLimitRow>;

namespace {

/// The rows of one column differ in what they are, so the units asked for are each row's own.
WrittenUnit unit_of(const RigidLimitRow &row) {
    return written_unit(quantity_in(row.unit), row.unit);
}

Json in_unit(const RigidLimitRow &row, std::optional<double> value) {
    return times(unit_of(row).factor, value);
}
Json closed_form(const RigidLimitRow &row) { return in_unit(row, row.closed_form); }
Json rigid_model(const RigidLimitRow &row) { return in_unit(row, row.rigid); }
Json first(const RigidLimitRow &row) { return in_unit(row, row.fe.front()); }
Json last(const RigidLimitRow &row) { return in_unit(row, row.fe.back()); }
Json first_difference(const RigidLimitRow &row) { return row.relative_difference.front(); }
Json last_difference(const RigidLimitRow &row) { return row.relative_difference.back(); }

std::string label(const RigidLimitRow &row) {
    const std::string unit = unit_of(row).name;
    return unit.empty() ? row.quantity : fmt::format("{} ({})", row.quantity, unit);
}

/// First and last point of every row, and the rate.
const Columns<RigidLimitRow> stiffness_columns{
    {OnPage("Quantity"), label},
    {InText("quantity"), label},
    {"quantity", &RigidLimitRow::quantity},
    {"unit", &RigidLimitRow::unit},
    {OnPage("closed form", "{:.10g}"), InText("closed form", precise), closed_form},
    {"closed_form", &RigidLimitRow::closed_form},
    {"fe", &RigidLimitRow::fe},
    {"stiffness", &RigidLimitRow::stiffness},
    {"stiffness_factor", &RigidLimitRow::factor},
    {"relative_difference", &RigidLimitRow::relative_difference},
    {"rounding", &RigidLimitRow::rounding},
    {OnPage("softest shaft", "{:.10g}"), InText("softest shaft", precise), first},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), first_difference},
    {OnPage("stiffest shaft", "{:.10g}"), InText("stiffest shaft", precise), last},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), last_difference},
    {"rate", OnPage("rate", "{:.5g}"), InText("rate", "{:.4f}"), &RigidLimitRow::rate},
    {"order", &RigidLimitRow::order},
    {OnPage("rigid model", "{:.12g}"), rigid_model},
    {"rigid_fe", &RigidLimitRow::rigid}};

const Columns<RigidLimitRow> mesh_columns{
    {OnPage("Quantity"), label},
    {InText("quantity"), label},
    {"quantity", &RigidLimitRow::quantity},
    {"unit", &RigidLimitRow::unit},
    {OnPage("elements of"),
     [](const RigidLimitRow &row) {
         return row.order == 1 ? "classical" : fmt::format("order {}", row.order);
     }},
    {OnPage("closed form", "{:.10g}"), InText("closed form", precise), closed_form},
    {"closed_form", &RigidLimitRow::closed_form},
    {"order", InText("order"), &RigidLimitRow::order},
    {"fe", &RigidLimitRow::fe},
    {"elements", &RigidLimitRow::elements},
    {"stiffness_factor", &RigidLimitRow::factor},
    {"relative_difference", &RigidLimitRow::relative_difference},
    {"rounding", &RigidLimitRow::rounding},
    {InText("elements"), [](const auto &row) { return row.elements.front(); }},
    {OnPage("finest mesh", "{:.10g}"), first},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), first_difference},
    {InText("elements"), [](const auto &row) { return row.elements.back(); }},
    {OnPage("coarsest mesh", "{:.10g}"), last},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), last_difference},
    {"rate", OnPage("slope", "{:.5g}"), &RigidLimitRow::rate}};

bool of_mesh(const RigidLimitRow &row) { return !row.elements.empty(); }

/// Rows of one sweep.
Rows sweep(const RigidLimitResult &result, bool mesh) {
    Rows rows;
    for (const RigidLimitRow &row : result.rows)
        if (of_mesh(row) == mesh && !row.fe.empty())
            rows.push_back(row);
    return rows;
}

/// A point of the stiffness sweep has a stiffness, one of the mesh sweep a number of elements; the
/// rigid model has neither a factor nor a stiffness.
struct Point {
    const RigidLimitRow &row;
    std::size_t index;
    int elements;
};

const Columns<Point> point_columns{
    {InCsv("quantity"), [](const Point &at) { return at.row.quantity; }},
    {InCsv("unit"), [](const Point &at) { return unit_of(at.row).name; }},
    {InCsv("order"), [](const Point &at) { return at.row.order; }},
    {InCsv("elements"), &Point::elements},
    {InCsv("factor of E and G"), [](const Point &at) { return at.row.factor[at.index]; }},
    {InCsv("stiffness [N/m]"),
     [](const Point &at) {
         return at.row.stiffness.empty() ? Json() : Json(at.row.stiffness[at.index]);
     }},
    {InCsv("closed form"), [](const Point &at) { return closed_form(at.row); }},
    {InCsv("model"), [](const Point &at) { return in_unit(at.row, at.row.fe[at.index]); }},
    {InCsv("relative difference"),
     [](const Point &at) { return at.row.relative_difference[at.index]; }},
    {InCsv("rate"), [](const Point &at) { return at.row.rate; }}};

std::string csv_of(const RigidLimitResult &result, const Units &) {
    std::vector<Point> points;
    for (const RigidLimitRow &row : result.rows)
        for (std::size_t k = 0; k < row.fe.size(); ++k)
            points.push_back({row, k, of_mesh(row) ? row.elements[k] : result.model.elements});
    return csv_table(point_columns, points);
}

Json shaft_json(const std::optional<results::RigidShaft> &shaft) {
    if (!shaft)
        return nullptr;
    return {{"factor", shaft->factor},
            {"stiffness", shaft->stiffness},
            {"over_bearings", shaft->over_bearings},
            {"relative_difference", shaft->largest},
            {"quantity", shaft->quantity}};
}

Json json_of(const RigidLimitResult &result, const Units &) {
    return {{"sentence", result.sentence},
            {"stiffness_definition", "48 EI/L^3 (N/m): EI the mean over the length L of the shaft"},
            {"shaft_stiffness", result.stiffness},
            {"bearing_stiffness", result.bearing_stiffness},
            {"as_is", shaft_json(result.as_is)},
            {"one_percent", shaft_json(result.one_percent)},
            {"one_percent_stiffness",
             result.one_percent ? Json(result.one_percent->stiffness) : Json()},
            {"mesh_stiffness_factor", result.mesh_factor},
            {"rows", json_list(result.rows, [](const RigidLimitRow &row) {
                 return json_row(of_mesh(row) ? mesh_columns : stiffness_columns, row);
             })}};
}

/// Relative differences of the speeds at every stiffness.
std::string sweep_table(const RigidLimitResult &result) {
    const auto cell = [](std::optional<double> value, const char *format) {
        return shown(value, {"", format}, "–");
    };
    Texts table{{"Factor of E and G", "48 EI/L³ (N/m)", "over the bearings"}};
    for (const RigidLimitRow &row : result.rows) {
        if (of_mesh(row))
            continue;
        table[0].push_back(row.quantity);
        table.resize(1 + row.fe.size());
        for (std::size_t k = 0; k < row.fe.size(); ++k) {
            if (table[1 + k].empty())
                table[1 + k] = {cell(row.factor[k], "{:.4g}"), cell(row.stiffness[k], "{:.4g}"),
                                cell(row.stiffness[k] / result.bearing_stiffness, "{:.4g}")};
            table[1 + k].push_back(cell(row.relative_difference[k], "{:.3g}"));
        }
    }
    return page_table(table);
}

std::vector<Section> sections_of(const RigidLimitResult &result, const Units &) {
    return {{"From which stiffness the rigid formulas do", element("p", result.sentence)},
            {"While the shaft stiffens", page_table(stiffness_columns, sweep(result, false))},
            {"Relative differences", sweep_table(result)},
            {std::isfinite(result.mesh_factor)
                 ? fmt::format("While the mesh coarsens, E and G times {:.5g}", result.mesh_factor)
                 : "On the mesh",
             page_table(mesh_columns, sweep(result, true))}};
}

std::string text_of(const model::Case &scene, const RigidLimitResult &result, const Units &) {
    std::string text =
        heading(scene, "Flexible model and rigid closed forms") + result.sentence + "\n\n";
    if (std::isfinite(result.stiffness))
        text += "While the shaft stiffens (E and G multiplied, bearings as they are):\n";
    text += text_table(stiffness_columns, sweep(result, false));
    text +=
        std::isfinite(result.mesh_factor)
            ? fmt::format("\nWhile the mesh coarsens, E and G times {:.4g}:\n", result.mesh_factor)
            : "\nOn the mesh:\n";
    return text + text_table(mesh_columns, sweep(result, true)) + model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const RigidLimitResult &result) {
    return report_of<RigidLimitResult>("rigid-limit", "Flexible model and rigid closed forms",
                                       scene, result,
                                       {json_of, csv_of, sections_of, text_of, rigid_limit_figure});
}

} // namespace whirl::report

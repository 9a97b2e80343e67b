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

/// The rows of one column differ in what they are.
const OfEach of_row{[](const RigidLimitRow &row) { return row.of; }};

std::optional<double> first(const RigidLimitRow &row) { return row.fe.front(); }
std::optional<double> last(const RigidLimitRow &row) { return row.fe.back(); }
std::optional<double> first_difference(const RigidLimitRow &row) {
    return row.relative_difference.front();
}
std::optional<double> last_difference(const RigidLimitRow &row) {
    return row.relative_difference.back();
}

std::string label(const RigidLimitRow &row, const Units &units) {
    return units.label(units.text(row.quantity), row.of);
}
std::string quantity_name(const RigidLimitRow &row, const Units &units) {
    return units.text(row.quantity);
}
std::string unit_name_of(const RigidLimitRow &row, const Units &units) {
    return units.name(row.of);
}

/// First and last point of every row, and the rate.
const Columns<RigidLimitRow> stiffness_columns{
    {Titled("Quantity"), label},
    {"quantity", quantity_name},
    {"unit", unit_name_of},
    {"closed_form", OnPage("closed form", "{:.10g}"), InText("closed form", precise), of_row,
     &RigidLimitRow::closed_form},
    {"fe", of_row, &RigidLimitRow::fe},
    {"stiffness", Quantity::stiffness, &RigidLimitRow::stiffness},
    {"stiffness_factor", Quantity::number, &RigidLimitRow::factor},
    {"relative_difference", Quantity::number, &RigidLimitRow::relative_difference},
    {"rounding", Quantity::number, &RigidLimitRow::rounding},
    {OnPage("softest shaft", "{:.10g}"), InText("softest shaft", precise), of_row, first},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), Quantity::number,
     first_difference},
    {OnPage("stiffest shaft", "{:.10g}"), InText("stiffest shaft", precise), of_row, last},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), Quantity::number,
     last_difference},
    {"rate", OnPage("rate", "{:.5g}"), InText("rate", "{:.4f}"), Quantity::number,
     &RigidLimitRow::rate},
    {"order", &RigidLimitRow::order},
    {"rigid_fe", OnPage("rigid model", "{:.12g}"), of_row, &RigidLimitRow::rigid}};

const Columns<RigidLimitRow> mesh_columns{
    {Titled("Quantity"), label},
    {"quantity", quantity_name},
    {"unit", unit_name_of},
    {OnPage("elements of"),
     [](const RigidLimitRow &row) {
         return row.order == 1 ? "classical" : fmt::format("order {}", row.order);
     }},
    {"closed_form", OnPage("closed form", "{:.10g}"), InText("closed form", precise), of_row,
     &RigidLimitRow::closed_form},
    {"order", InText("order"), &RigidLimitRow::order},
    {"fe", of_row, &RigidLimitRow::fe},
    {"elements", &RigidLimitRow::elements},
    {"stiffness_factor", Quantity::number, &RigidLimitRow::factor},
    {"relative_difference", Quantity::number, &RigidLimitRow::relative_difference},
    {"rounding", Quantity::number, &RigidLimitRow::rounding},
    {InText("elements"), [](const auto &row) { return row.elements.front(); }},
    {OnPage("finest mesh", "{:.10g}"), of_row, first},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), Quantity::number,
     first_difference},
    {InText("elements"), [](const auto &row) { return row.elements.back(); }},
    {OnPage("coarsest mesh", "{:.10g}"), of_row, last},
    {OnPage("difference", "{:.3g}"), InText("difference", rough), Quantity::number,
     last_difference},
    {"rate", OnPage("slope", "{:.5g}"), Quantity::number, &RigidLimitRow::rate}};

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

const OfEach of_point{[](const Point &at) { return at.row.of; }};

const Columns<Point> point_columns{
    {InCsv("quantity"),
     [](const Point &at, const Units &units) { return quantity_name(at.row, units); }},
    {InCsv("unit"), [](const Point &at, const Units &units) { return units.name(at.row.of); }},
    {InCsv("order"), [](const Point &at) { return at.row.order; }},
    {InCsv("elements"), &Point::elements},
    {InCsv("factor of E and G"), Quantity::number,
     [](const Point &at) { return at.row.factor[at.index]; }},
    {InCsv("stiffness"), Quantity::stiffness,
     [](const Point &at) {
         return at.row.stiffness.empty() ? std::nullopt : std::optional(at.row.stiffness[at.index]);
     }},
    {InCsv("closed form"), of_point, [](const Point &at) { return at.row.closed_form; }},
    {InCsv("model"), of_point, [](const Point &at) { return at.row.fe[at.index]; }},
    {InCsv("relative difference"), Quantity::number,
     [](const Point &at) { return at.row.relative_difference[at.index]; }},
    {InCsv("rate"), Quantity::number, [](const Point &at) { return at.row.rate; }}};

std::string csv_of(const RigidLimitResult &result, const Units &units) {
    std::vector<Point> points;
    for (const RigidLimitRow &row : result.rows)
        for (std::size_t k = 0; k < row.fe.size(); ++k)
            points.push_back({row, k, of_mesh(row) ? row.elements[k] : result.model.elements});
    return csv_table(point_columns, points, units);
}

Json shaft_json(const std::optional<results::RigidShaft> &shaft, const Units &units) {
    if (!shaft)
        return nullptr;
    return {{"factor", shaft->factor},
            {"stiffness", written(units, Quantity::stiffness, shaft->stiffness)},
            {"over_bearings", shaft->over_bearings},
            {"relative_difference", shaft->largest},
            {"quantity", units.text(shaft->quantity)}};
}

Json json_of(const RigidLimitResult &result, const Units &units) {
    const auto stiffness = [&units](double of) { return written(units, Quantity::stiffness, of); };
    return {
        {"sentence", units.text(result.sentence)},
        {"stiffness_definition", "48 EI/L^3: EI the mean over the length L of the shaft"},
        {"shaft_stiffness", stiffness(result.stiffness)},
        {"bearing_stiffness", stiffness(result.bearing_stiffness)},
        {"as_is", shaft_json(result.as_is, units)},
        {"one_percent", shaft_json(result.one_percent, units)},
        {"one_percent_stiffness",
         result.one_percent ? stiffness(result.one_percent->stiffness) : Json()},
        {"mesh_stiffness_factor", result.mesh_factor},
        {"omega_0", written(units, Quantity::frequency, result.omega_0)},
        {"partial_frequencies", written(units, Quantity::frequency, result.partial_frequencies)},
        {"z_max", written(units, Quantity::length, result.z_max)},
        {"rows", json_list(result.rows, [&](const RigidLimitRow &row) {
             Json json = json_row(of_mesh(row) ? mesh_columns : stiffness_columns, row, units);
             json["over_omega_0"] =
                 row.of == Quantity::speed ? Json(row.closed_form / result.omega_0) : Json();
             return json;
         })}};
}

/// Relative differences of the speeds at every stiffness.
std::string sweep_table(const RigidLimitResult &result, const Units &units) {
    const auto cell = [](std::optional<double> value, const char *format) {
        return shown(value, {"", format}, "–");
    };
    Texts table{
        {"Factor of E and G", units.label("48 EI/L³", Quantity::stiffness), "over the bearings"}};
    for (const RigidLimitRow &row : result.rows) {
        if (of_mesh(row))
            continue;
        table[0].push_back(quantity_name(row, units));
        table.resize(1 + row.fe.size());
        for (std::size_t k = 0; k < row.fe.size(); ++k) {
            if (table[1 + k].empty())
                table[1 + k] = {cell(row.factor[k], "{:.4g}"),
                                cell(units(Quantity::stiffness, row.stiffness[k]), "{:.4g}"),
                                cell(row.stiffness[k] / result.bearing_stiffness, "{:.4g}")};
            table[1 + k].push_back(cell(row.relative_difference[k], "{:.3g}"));
        }
    }
    return page_table(table);
}

std::vector<Section> sections_of(const RigidLimitResult &result, const Units &units) {
    return {
        {"From which stiffness the rigid formulas do", element("p", units.text(result.sentence))},
        {"While the shaft stiffens", page_table(stiffness_columns, sweep(result, false), units)},
        {"Relative differences", sweep_table(result, units)},
        {std::isfinite(result.mesh_factor)
             ? fmt::format("While the mesh coarsens, E and G times {:.5g}", result.mesh_factor)
             : "On the mesh",
         page_table(mesh_columns, sweep(result, true), units)}};
}

std::string text_of(const model::Case &scene, const RigidLimitResult &result, const Units &units) {
    std::string text = heading(scene, "Flexible model and rigid closed forms") +
                       units.text(result.sentence) + "\n\n";
    if (std::isfinite(result.stiffness))
        text += "While the shaft stiffens (E and G multiplied, bearings as they are):\n";
    text += text_table(stiffness_columns, sweep(result, false), units);
    text +=
        std::isfinite(result.mesh_factor)
            ? fmt::format("\nWhile the mesh coarsens, E and G times {:.4g}:\n", result.mesh_factor)
            : "\nOn the mesh:\n";
    return text + text_table(mesh_columns, sweep(result, true), units) +
           model_text(result.model, units);
}

} // namespace

Report describe(const model::Case &scene, const RigidLimitResult &result) {
    return report_of<RigidLimitResult>("rigid-limit", "Flexible model and rigid closed forms",
                                       scene, result,
                                       {json_of, csv_of, sections_of, text_of, rigid_limit_chart});
}

} // namespace whirl::report

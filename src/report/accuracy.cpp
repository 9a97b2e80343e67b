// Report of the command accuracy.

#include "results/accuracy.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/style.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace whirl::report {

using results::AccuracyResult;
using results::AccuracyRow;

namespace {

const Columns<AccuracyRow> accuracy_columns{
    {InFiles("family"), Titled("Family"), &AccuracyRow::family},
    {InFiles("order"), Titled("Order"), &AccuracyRow::order},
    {InFiles("elements"), Titled("Elements"), &AccuracyRow::elements},
    {InFiles("method"), Titled("Method"), &AccuracyRow::method},
    {InFiles("unknowns"), Titled("Unknowns"), &AccuracyRow::unknowns},
    {InFiles("seconds"), Quantity::time, &AccuracyRow::seconds},
    {OnPage("Wall time (ms)", "{:.4g}"), InText("ms", "{:.3g}"), Quantity::number,
     in(1000, &AccuracyRow::seconds)},
    {InFiles("error_estimate"), OnPage("Estimate", "{:.3g}"), InText("estimate", rough),
     Quantity::number, &AccuracyRow::error_estimate},
    {InFiles("true_error"), OnPage("True error", "{:.3g}"), InText("true error", rough),
     Quantity::number, &AccuracyRow::true_error}};

Json json_of(const AccuracyResult &result, const Units &units) {
    return {{"reference", result.reference},
            {"speed", written(units, Quantity::speed, result.speed)},
            {"reference_frequencies",
             written(units, Quantity::frequency, result.reference_frequencies)},
            {"rows", json_rows(accuracy_columns, result.rows, units)}};
}

std::string csv_of(const AccuracyResult &result, const Units &units) {
    return csv_table(accuracy_columns, result.rows, units);
}

std::vector<Section> sections_of(const AccuracyResult &result, const Units &units) {
    return {
        {"Error against " + result.reference, page_table(accuracy_columns, result.rows, units)}};
}

std::string text_of(const model::Case &scene, const AccuracyResult &result, const Units &units) {
    return heading(scene,
                   fmt::format("Speed and error at {}, against {}",
                               units.text(Quantity::speed, result.speed), result.reference)) +
           text_table(accuracy_columns, result.rows, units) + model_text(result.model, units);
}

/// Rows that one line joins, by its name: of one method, family and order, in the order of their
/// unknowns. Of the followed rows those of all orders: they are on the same elements.
using Families = std::map<std::string, std::vector<AccuracyRow>>;

std::string line_name(const AccuracyRow &row) {
    const bool classical = row.family == "classical";
    if (row.method == "reduced")
        return classical ? "classical, reduced" : "orders, reduced";
    return classical ? "classical" : fmt::format("order {:2}", row.order);
}

Families families_of(const AccuracyResult &result) {
    Families families;
    for (const AccuracyRow &row : result.rows)
        if (row.true_error && *row.true_error > 0)
            families[line_name(row)].push_back(row);
    for (auto &[name, rows] : families)
        std::stable_sort(rows.begin(), rows.end(), [](const AccuracyRow &a, const AccuracyRow &b) {
            return a.unknowns < b.unknowns;
        });
    return families;
}

/// True error over wall time and over unknowns, logarithmic, one line for each element family and
/// order.
Chart accuracy_chart(const model::Case &scene, const AccuracyResult &result, const Units &) {
    Chart chart{"Speed and accuracy: " + title_of(scene),
                "largest relative error of the frequencies against " + result.reference,
                {}};
    const auto add = [&](const std::string &title, const auto &x) {
        ChartPanel panel{380,
                         {.title = title, .logarithmic = true},
                         {.title = "True relative error", .logarithmic = true},
                         {}};
        for (const auto &[name, rows] : families_of(result)) {
            std::vector<PlotPoint> points;
            for (const AccuracyRow &row : rows)
                points.push_back({static_cast<double>(std::invoke(x, row)), row.true_error});
            panel.curves.push_back(chart_curve(name, points, panel.curves.size()));
            panel.curves.back().marker = 1;
        }
        chart.panels.push_back(panel);
    };
    add("Unknowns", &AccuracyRow::unknowns);
    add("Wall time (ms)", in(1000, &AccuracyRow::seconds));
    return chart;
}

} // namespace

Report describe(const model::Case &scene, const AccuracyResult &result) {
    return report_of<AccuracyResult>("accuracy", "Speed and accuracy", scene, result,
                                     {json_of, csv_of, sections_of, text_of, accuracy_chart});
}

} // namespace whirl::report

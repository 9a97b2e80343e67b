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
    {"family", InCsv("family"), OnPage("Family"), InText("family"), &AccuracyRow::family},
    {"order", InCsv("order"), OnPage("Order"), InText("order"), &AccuracyRow::order},
    {"elements", InCsv("elements"), OnPage("Elements"), InText("elements"), &AccuracyRow::elements},
    {"method", InCsv("method"), OnPage("Method"), InText("method"), &AccuracyRow::method},
    {"unknowns", InCsv("unknowns"), OnPage("Unknowns"), InText("unknowns"), &AccuracyRow::unknowns},
    {"seconds", InCsv("seconds [s]"), &AccuracyRow::seconds},
    {OnPage("Wall time (ms)", "{:.4g}"), InText("ms", "{:.3g}"), in(1000, &AccuracyRow::seconds)},
    {"error_estimate", InCsv("error_estimate"), OnPage("Estimate", "{:.3g}"),
     InText("estimate", rough), &AccuracyRow::error_estimate},
    {"true_error", InCsv("true_error"), OnPage("True error", "{:.3g}"), InText("true error", rough),
     &AccuracyRow::true_error}};

Json json_of(const AccuracyResult &result, const Units &) {
    return {{"reference", result.reference},
            {"speed", result.speed},
            {"reference_frequencies", result.reference_frequencies},
            {"rows", json_rows(accuracy_columns, result.rows)}};
}

std::string csv_of(const AccuracyResult &result, const Units &) {
    return csv_table(accuracy_columns, result.rows);
}

std::vector<Section> sections_of(const AccuracyResult &result, const Units &) {
    return {{"Error against " + result.reference, page_table(accuracy_columns, result.rows)}};
}

std::string text_of(const model::Case &scene, const AccuracyResult &result, const Units &) {
    return heading(scene, fmt::format("Speed and error at {:.6g} rpm, against {}",
                                      result.speed * rpm, result.reference)) +
           text_table(accuracy_columns, result.rows) + model_text(result.model);
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

/// @param x  of the axis: a member or a function of the row
std::string plots(const Families &families, const auto &x, bool legend) {
    Curves drawn;
    std::size_t index = 0;
    for (const auto &[title, rows] : families) {
        std::vector<PlotPoint> points;
        for (const AccuracyRow &row : rows)
            points.push_back({static_cast<double>(std::invoke(x, row)), row.true_error});
        const LineStyle style = series_style(index++);
        drawn.add(points,
                  fmt::format("with linespoints lw 1.8 dt {} pt {} ps 1 lc rgb '{}'", style.dash,
                              style.point, style.colour),
                  legend ? plot_text(title) : "");
    }
    return families.empty() ? "set xrange [1:10]\nset yrange [1e-12:1]\nplot NaN notitle\n"
                            : drawn.script();
}

/// True error over wall time and over unknowns, logarithmic, one line for each element family and
/// order.
Figure accuracy_figure(const model::Case &scene, const AccuracyResult &result, const Units &) {
    const Families families = families_of(result);
    return figure_of(1180, 600, "Speed and accuracy: " + title_of(scene),
                     "largest relative error of the frequencies against " + result.reference,
                     std::string("set logscale xy\nset format y '10^{%L}'\n") + grid +
                         "set ylabel 'True relative error'\nset xlabel 'Unknowns'\nunset key\n" +
                         panel_margins(0.075, 0.42, 0.115, 0.87) +
                         plots(families, &AccuracyRow::unknowns, false) +
                         "unset label\nunset ylabel\nset xlabel 'Wall time (ms)'\n"
                         "set key at graph 1.03,1 left top reverse Left vertical samplen 3\n" +
                         panel_margins(0.475, 0.82, 0.115, 0.87) +
                         plots(families, in(1000, &AccuracyRow::seconds), true));
}

} // namespace

Report describe(const model::Case &scene, const AccuracyResult &result) {
    return report_of<AccuracyResult>("accuracy", "Speed and accuracy", scene, result,
                                     {json_of, csv_of, sections_of, text_of, accuracy_figure});
}

} // namespace whirl::report

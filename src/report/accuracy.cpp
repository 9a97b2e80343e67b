// Report of the command accuracy.

#include "results/accuracy.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/style.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>
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
    {OnPage("Wall time (ms)", "{:.4g}"), InText("ms", "{:.3g}"),
     [](const auto &row) { return row.seconds * 1000; }},
    {"error_estimate", InCsv("error_estimate"), OnPage("Estimate", "{:.3g}"),
     InText("estimate", rough), &AccuracyRow::error_estimate},
    {"true_error", InCsv("true_error"), OnPage("True error", "{:.3g}"), InText("true error", rough),
     &AccuracyRow::true_error}};

Json json_of(const AccuracyResult &result) {
    return {{"reference", result.reference},
            {"speed", result.speed},
            {"reference_frequencies", result.reference_frequencies},
            {"rows", json_rows(accuracy_columns, result.rows)}};
}

std::string text_of(const model::Case &scene, const AccuracyResult &result) {
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

std::string plots(const Families &families, int column, bool legend) {
    std::string text;
    std::size_t index = 0;
    for (const auto &[name, rows] : families) {
        const LineStyle style = series_style(index);
        text +=
            fmt::format("$f{} using {}:3 with linespoints lw 1.8 dt {} pt {} ps 1 lc rgb '{}' {}, ",
                        index, column, style.dash, style.point, style.colour,
                        legend ? "title " + plot_text(name) : "notitle");
        ++index;
    }
    if (text.empty())
        return "set xrange [1:10]\nset yrange [1e-12:1]\nplot NaN notitle\n";
    text.resize(text.size() - 2);
    return "plot " + text + "\n";
}

/// True error over wall time and over unknowns, logarithmic, one line for each element family and
/// order.
Figure accuracy_figure(const model::Case &scene, const AccuracyResult &result) {
    const Families families = families_of(result);
    Figure figure;
    figure.width = 1180;
    figure.height = 600;
    figure.script = figure_head(
        "Speed and accuracy: " + title_of(scene),
        "largest relative error of the frequencies against " + result.reference, figure.height);
    std::size_t index = 0;
    for (const auto &[name, rows] : families) {
        figure.script += fmt::format("$f{} << EOD\n", index++);
        for (const AccuracyRow &row : rows)
            figure.script +=
                fmt::format("{} {} {}\n", row.unknowns, plot_number(row.seconds * 1000),
                            plot_number(row.true_error));
        figure.script += "EOD\n";
    }
    figure.script +=
        "set logscale xy\nset format y '10^{%L}'\nset grid lc rgb '#E4E4E4' lt 1 lw 0.6\n"
        "set ylabel 'True relative error'\nset xlabel 'Unknowns'\nunset key\n" +
        panel_margins(0.075, 0.42, 0.115, 0.87) + plots(families, 1, false) +
        "unset label\nunset ylabel\nset xlabel 'Wall time (ms)'\n"
        "set key at graph 1.03,1 left top reverse Left vertical samplen 3\n" +
        panel_margins(0.475, 0.82, 0.115, 0.87) + plots(families, 2, true) + "unset multiplot\n";
    return figure;
}

} // namespace

Report describe(const model::Case &scene, const AccuracyResult &result) {
    return {.command = "accuracy",
            .heading = "Speed and accuracy",
            .scene = &scene,
            .model = &result.model,
            .json = [&] { return json_of(result); },
            .csv = [&] { return csv_table(accuracy_columns, result.rows); },
            .sections =
                [&] {
                    return std::vector{Section{"Error against " + result.reference,
                                               page_table(accuracy_columns, result.rows)}};
                },
            .text = [&] { return text_of(scene, result); },
            .figure = [&] { return accuracy_figure(scene, result); }};
}

} // namespace whirl::report

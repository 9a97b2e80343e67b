// Report of the command weights.

#include "results/weights.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <complex>

namespace whirl::report {

using results::CorrectionWeight;
using results::DependentPlanes;
using results::DoubtfulReading;
using results::InfluenceCoefficient;
using results::PlaneChoice;
using results::WeightPiece;
using results::WeightReading;
using results::WeightsResult;

namespace {

/// Nothing has a direction only where it is not zero.
std::optional<double> phase_of(std::complex<double> value) {
    return value == 0.0 ? std::nullopt : std::optional(std::arg(value));
}
std::optional<double> size_of(std::complex<double> value) {
    return value == 0.0 ? std::nullopt : std::optional(std::abs(value));
}

std::string list_of(const std::vector<std::string> &names) { return joined(names, ", "); }

const Columns<CorrectionWeight> weight_columns{
    {"plane", InCsv("plane"), ForReaders("Plane"), &CorrectionWeight::plane},
    {"mr", InCsv("mr"), ForReaders("Weight to add"), Quantity::imbalance,
     [](const CorrectionWeight &w) { return std::abs(w.weight); }},
    {"phase", InCsv("phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const CorrectionWeight &w) { return std::arg(w.weight); }},
    {"scatter", InCsv("scatter"), ForReaders("± (95 %)", "{:.3g}"), Quantity::imbalance,
     &CorrectionWeight::scatter},
    {"max", Quantity::imbalance, &CorrectionWeight::largest},
    {"on_mr", Quantity::imbalance, [](const CorrectionWeight &w) { return size_of(w.on); }},
    {"on_phase", Quantity::angle, [](const CorrectionWeight &w) { return phase_of(w.on); }},
    {"total_mr", InCsv("total_mr"), OnPage("In place of trial weights that stay"),
     Quantity::imbalance,
     [](const CorrectionWeight &w) {
         return w.on == 0.0 ? std::nullopt : std::optional(std::abs(w.weight + w.on));
     }},
    {"total_phase", InCsv("total_phase"), OnPage("Phase", "{:.2f}"), Quantity::angle,
     [](const CorrectionWeight &w) {
         return w.on == 0.0 ? std::nullopt : std::optional(std::arg(w.weight + w.on));
     }},
    {"fixed_mr", Quantity::imbalance, [](const CorrectionWeight &w) { return size_of(w.fixed); }},
    {"fixed_phase", Quantity::angle, [](const CorrectionWeight &w) { return phase_of(w.fixed); }},
    {"significance", OnPage("Share that no other plane can do", "{:.3f}"), Quantity::number,
     &CorrectionWeight::significance},
    {"permissible", OnPage("Permissible residual"), Quantity::imbalance,
     &CorrectionWeight::permissible}};

const Columns<WeightReading> reading_columns{
    {"probe", InCsv("probe"), ForReaders("Probe"), &WeightReading::probe},
    {"speed", InCsv("speed"), ForReaders("Speed"), Quantity::speed, &WeightReading::speed},
    {"before_amplitude", InCsv("before_amplitude"), ForReaders("Before"), Quantity::amplitude,
     [](const WeightReading &r) { return std::abs(r.before); }},
    {"before_phase", InCsv("before_phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const WeightReading &r) { return std::arg(r.before); }},
    {"amplitude", InCsv("amplitude"), ForReaders("After"), Quantity::amplitude,
     [](const WeightReading &r) { return std::abs(r.after); }},
    {"phase", InCsv("phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const WeightReading &r) { return std::arg(r.after); }},
    {"scatter", InCsv("scatter"), ForReaders("± (95 %)", "{:.3g}"), Quantity::amplitude,
     &WeightReading::scatter},
    {"split_amplitude", InCsv("split_amplitude"), OnPage("After, weights as split"),
     Quantity::amplitude, &WeightReading::split}};

const Columns<InfluenceCoefficient> influence_columns{
    {"probe", InCsv("probe"), OnPage("Probe"), &InfluenceCoefficient::probe},
    {"speed", InCsv("speed"), OnPage("Speed"), Quantity::speed, &InfluenceCoefficient::speed},
    {"plane", InCsv("plane"), OnPage("Plane"), &InfluenceCoefficient::plane},
    {"amplitude", InCsv("influence"), OnPage("Vibration over weight"), Quantity::influence,
     [](const InfluenceCoefficient &c) { return std::abs(c.value); }},
    {"phase", InCsv("phase"), OnPage("Phase", "{:.2f}"), Quantity::angle,
     [](const InfluenceCoefficient &c) { return std::arg(c.value); }}};

const Columns<DependentPlanes> dependent_columns{
    {"planes", Quantity::number, [](const DependentPlanes &d) { return Json(d.planes); }},
    {ForReaders("Planes"), [](const DependentPlanes &d) { return list_of(d.planes); }},
    {"leave_out", ForReaders("Leave out"), &DependentPlanes::leave_out},
    {"rms", ForReaders("Root mean square without it"), Quantity::amplitude, &DependentPlanes::rms},
    {"max", ForReaders("Largest without it"), Quantity::amplitude, &DependentPlanes::max},
    {"largest_weight", ForReaders("Largest weight with all"), Quantity::imbalance,
     &DependentPlanes::largest_weight},
    {"largest_weight_without", ForReaders("Largest weight without it"), Quantity::imbalance,
     &DependentPlanes::largest_without}};

const Columns<PlaneChoice> choice_columns{
    {"count", ForReaders("Planes"), [](const PlaneChoice &c) { return c.planes.size(); }},
    {"planes", Quantity::number, [](const PlaneChoice &c) { return Json(c.planes); }},
    {ForReaders("Best choice"), [](const PlaneChoice &c) { return list_of(c.planes); }},
    {"rms", ForReaders("Root mean square after"), Quantity::amplitude, &PlaneChoice::rms},
    {"max", ForReaders("Largest after"), Quantity::amplitude, &PlaneChoice::max},
    {"largest_weight", ForReaders("Largest weight"), Quantity::imbalance,
     &PlaneChoice::largest_weight}};

const Columns<WeightPiece> piece_columns{
    {InCsv("plane"), ForReaders("Plane"), &WeightPiece::plane},
    {"hole", InCsv("hole"), ForReaders("Hole"), &WeightPiece::hole},
    {"angle", InCsv("angle"), ForReaders("Angle", "{:.2f}"), Quantity::angle, &WeightPiece::angle},
    {"mass", InCsv("mass"), ForReaders("Mass"), Quantity::mass, &WeightPiece::mass},
    {"mr", InCsv("mr"), ForReaders("Weight"), Quantity::imbalance, &WeightPiece::mr}};

const Columns<DoubtfulReading> doubtful_columns{
    {"probe", ForReaders("Probe"), &DoubtfulReading::probe},
    {"speed", ForReaders("Speed"), Quantity::speed, &DoubtfulReading::speed},
    {"run", ForReaders("Run"), &DoubtfulReading::run},
    {"line", ForReaders("Line of the table"), &DoubtfulReading::line},
    {"apart", ForReaders("Apart from the others"), Quantity::amplitude, &DoubtfulReading::apart},
    {"probability", ForReaders("Probability", "{:.1e}"), Quantity::number,
     &DoubtfulReading::probability}};

std::vector<WeightPiece> all_pieces(const WeightsResult &result) {
    std::vector<WeightPiece> all;
    for (const results::SplitPlane &plane : result.split)
        all.insert(all.end(), plane.pieces.begin(), plane.pieces.end());
    return all;
}

const char *source_name(results::InfluenceSource source) {
    switch (source) {
    case results::InfluenceSource::trials:
        return "trials";
    case results::InfluenceSource::table:
        return "table";
    case results::InfluenceSource::model:
        return "model";
    }
    return "";
}

Json split_json(const WeightsResult &result, const Units &units) {
    return json_list(result.split, [&units](const results::SplitPlane &plane) {
        return Json{{"plane", plane.plane},
                    {"pieces", json_rows(piece_columns, plane.pieces, units)},
                    {"mr", written(units, Quantity::imbalance, std::abs(plane.sum))},
                    {"phase", written(units, Quantity::angle, phase_of(plane.sum))},
                    {"missing", written(units, Quantity::imbalance, std::abs(plane.missing))}};
    });
}

Json curves_json(const WeightsResult &result, const Units &units) {
    if (result.curves.empty())
        return nullptr;
    return {{"speeds", written(units, Quantity::speed, result.curve_speeds)},
            {"probes", json_list(result.curves, [&units](const results::VibrationCurve &curve) {
                 return Json{{"probe", curve.probe},
                             {"before", written(units, Quantity::amplitude, curve.before)},
                             {"after", written(units, Quantity::amplitude, curve.after)}};
             })}};
}

Json json_of(const WeightsResult &result, const Units &units) {
    const auto amplitude = [&units](std::optional<double> value) {
        return written(units, Quantity::amplitude, value);
    };
    return {{"method", result.method},
            {"phase", result.lag ? "lag" : "lead"},
            {"vibration_from", result.measured ? "readings" : "model"},
            {"influence_from", source_name(result.source)},
            {"weights", json_rows(weight_columns, result.weights, units)},
            {"residual", json_rows(reading_columns, result.residual, units)},
            {"rms", amplitude(result.rms)},
            {"max", amplitude(result.max)},
            {"rms_before", amplitude(result.rms_before)},
            {"max_before", amplitude(result.max_before)},
            {"reached", amplitude(result.reached)},
            {"bound", amplitude(result.bound)},
            {"influence", json_rows(influence_columns, result.influence, units)},
            {"singular_values", written(units, Quantity::influence, result.singular_values)},
            {"condition", result.condition},
            {"dependent", json_rows(dependent_columns, result.dependent, units)},
            {"choices", json_rows(choice_columns, result.choices, units)},
            {"split", split_json(result, units)},
            {"rms_split", amplitude(result.rms_split)},
            {"max_split", amplitude(result.max_split)},
            {"outliers", json_rows(doubtful_columns, result.outliers, units)},
            {"curves", curves_json(result, units)}};
}

/// Weights, readings, coefficients and pieces under one head; the first column says which.
std::string csv_of(const WeightsResult &result, const Units &units) {
    std::vector<CsvHeading> head{{"kind", Quantity::number}};
    const auto add = [&head](const std::vector<CsvHeading> &more) {
        for (const CsvHeading &own : more)
            if (std::find(head.begin(), head.end(), own) == head.end())
                head.push_back(own);
    };
    add(csv_head(weight_columns));
    add(csv_head(reading_columns));
    add(csv_head(influence_columns));
    add(csv_head(piece_columns));
    const auto rows = [&](const char *kind, auto columns, const auto &items) {
        columns.push_back({InCsv("kind"), [kind](const auto &) { return kind; }});
        return csv_rows(head, columns, items, units);
    };
    return csv_head_line(head, units) + rows("weight", weight_columns, result.weights) +
           rows("reading", reading_columns, result.residual) +
           rows("influence", influence_columns, result.influence) +
           rows("piece", piece_columns, all_pieces(result));
}

/// What the method made small, before and after.
std::string summary_of(const WeightsResult &result, const Units &units) {
    const auto amplitude = [&units](double value) {
        return units.text(Quantity::amplitude, value, 5);
    };
    std::string text =
        fmt::format("Root mean square {} before, {} after; largest {} before, {} after ({}).",
                    amplitude(result.rms_before), amplitude(result.rms),
                    amplitude(result.max_before), amplitude(result.max), result.method);
    if (result.rms_split)
        text += fmt::format(" As split: root mean square {}, largest {}.",
                            amplitude(*result.rms_split), amplitude(result.max_split.value_or(0)));
    return text;
}

std::string convention(const WeightsResult &result) {
    return result.lag ? "Phases count against the spin (lag)."
                      : "Phases count with the spin (lead).";
}

std::vector<Section> sections_of(const WeightsResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Weights", element("p", summary_of(result, units)) +
                        element("p", convention(result) + " Weights are to be added to what is on "
                                                          "the rotor.") +
                        page_table(weight_columns, result.weights, units)},
        {"Readings before and after", page_table(reading_columns, result.residual, units)}};
    if (!result.split.empty())
        sections.push_back(
            {"Weights as split", page_table(piece_columns, all_pieces(result), units)});
    if (!result.choices.empty())
        sections.push_back(
            {"How many planes are needed", page_table(choice_columns, result.choices, units)});
    if (!result.dependent.empty())
        sections.push_back({"Planes that nearly do the same",
                            page_table(dependent_columns, result.dependent, units)});
    if (!result.outliers.empty())
        sections.push_back(
            {"Doubtful readings", page_table(doubtful_columns, result.outliers, units)});
    sections.push_back(
        {"Influence coefficients", page_table(influence_columns, result.influence, units)});
    return sections;
}

std::string text_of(const model::Case &scene, const WeightsResult &result, const Units &units) {
    return heading(scene, "Correction weights") +
           text_table(weight_columns, result.weights, units) + "\n" +
           text_table(reading_columns, result.residual, units) + "\n" + summary_of(result, units) +
           "\n" + convention(result) + "\n" +
           text_table("\nWeights as split:\n", piece_columns, all_pieces(result), units) +
           text_table("\nHow many planes are needed:\n", choice_columns, result.choices, units) +
           text_table("\nPlanes that nearly do the same:\n", dependent_columns, result.dependent,
                      units) +
           text_table("\nDoubtful readings:\n", doubtful_columns, result.outliers, units) +
           model_text(result.model, units);
}

} // namespace

Report describe(const model::Case &scene, const WeightsResult &result) {
    return report_of<WeightsResult>("weights", "Correction weights", scene, result,
                                    {json_of, csv_of, sections_of, text_of, weights_figure});
}

} // namespace whirl::report

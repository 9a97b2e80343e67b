// Report of the command weights.

#include "results/weights.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"
#include "results/enum_name.h"

#include <fmt/format.h>

#include <array>
#include <complex>

namespace whirl::report {

using results::BalancingProcedure;
using results::CorrectionWeight;
using results::DependentPlanes;
using results::DoubtfulReading;
using results::InfluenceCoefficient;
using results::InfluenceCurve;
using results::PlaneChoice;
using results::WeightPiece;
using results::WeightReading;
using results::WeightsResult;

namespace {

std::optional<double> size_of(std::complex<double> value) {
    return value == 0.0 ? std::nullopt : std::optional(std::abs(value));
}

std::string list_of(const std::vector<std::string> &names) { return joined(names, ", "); }

const Columns<CorrectionWeight> weight_columns{
    {InFiles("plane"), ForReaders("Plane"), &CorrectionWeight::plane},
    {InFiles("mr"), ForReaders("Weight to add"), Quantity::imbalance,
     [](const CorrectionWeight &w) { return std::abs(w.weight); }},
    {InFiles("phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const CorrectionWeight &w) { return phase_of(w.weight); }},
    {InFiles("scatter"), ForReaders("± (95 %)", "{:.3g}"), Quantity::imbalance,
     &CorrectionWeight::scatter},
    {"max", Quantity::imbalance, &CorrectionWeight::largest},
    {"on_mr", Quantity::imbalance, [](const CorrectionWeight &w) { return size_of(w.on); }},
    {"on_phase", Quantity::angle, [](const CorrectionWeight &w) { return phase_of(w.on); }},
    {InFiles("total_mr"), OnPage("In place of trial weights that stay"), Quantity::imbalance,
     [](const CorrectionWeight &w) {
         return w.on == 0.0 ? std::nullopt : std::optional(std::abs(w.weight + w.on));
     }},
    {InFiles("total_phase"), OnPage("Phase", "{:.2f}"), Quantity::angle,
     [](const CorrectionWeight &w) {
         return w.on == 0.0 ? std::nullopt : phase_of(w.weight + w.on);
     }},
    {"fixed_mr", Quantity::imbalance, [](const CorrectionWeight &w) { return size_of(w.fixed); }},
    {"fixed_phase", Quantity::angle, [](const CorrectionWeight &w) { return phase_of(w.fixed); }},
    {"significance", OnPage("Share that no other plane can do", "{:.3f}"), Quantity::number,
     &CorrectionWeight::significance},
    {"permissible", OnPage("Permissible residual"), Quantity::imbalance,
     &CorrectionWeight::permissible}};

const Columns<WeightReading> reading_columns{
    {InFiles("probe"), ForReaders("Probe"), &WeightReading::probe},
    {InFiles("speed"), ForReaders("Speed"), Quantity::speed, &WeightReading::speed},
    {InFiles("before_amplitude"), ForReaders("Before"), Quantity::amplitude,
     [](const WeightReading &r) { return std::abs(r.before); }},
    {InFiles("before_phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const WeightReading &r) { return phase_of(r.before); }},
    {InFiles("amplitude"), ForReaders("After"), Quantity::amplitude,
     [](const WeightReading &r) { return std::abs(r.after); }},
    {InFiles("phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const WeightReading &r) { return phase_of(r.after); }},
    {InFiles("scatter"), ForReaders("± (95 %)", "{:.3g}"), Quantity::amplitude,
     &WeightReading::scatter},
    {InFiles("split_amplitude"), OnPage("After, weights as split"), Quantity::amplitude,
     &WeightReading::split}};

const Columns<InfluenceCoefficient> influence_columns{
    {InFiles("probe"), OnPage("Probe"), &InfluenceCoefficient::probe},
    {InFiles("speed"), OnPage("Speed"), Quantity::speed, &InfluenceCoefficient::speed},
    {InFiles("plane"), OnPage("Plane"), &InfluenceCoefficient::plane},
    {"amplitude", InCsv("influence"), OnPage("Vibration over weight"), Quantity::influence,
     [](const InfluenceCoefficient &c) { return std::abs(c.value); }},
    {InFiles("phase"), OnPage("Phase", "{:.2f}"), Quantity::angle,
     [](const InfluenceCoefficient &c) { return phase_of(c.value); }},
    {InFiles("error"), OnPage("Relative error", "{:.1e}"), Quantity::number,
     &InfluenceCoefficient::error}};

/// A curve at one speed.
struct InfluenceAt {
    const InfluenceCurve *curve = nullptr;
    double speed = 0;
    std::optional<std::complex<double>> value;
    std::optional<double> error;

    [[nodiscard]] bool force() const { return curve->of == "force"; }
    [[nodiscard]] std::optional<double> amplitude(bool of_force) const {
        return value && force() == of_force ? std::optional(std::abs(*value)) : std::nullopt;
    }
    [[nodiscard]] std::optional<double> phase() const {
        return value ? phase_of(*value) : std::nullopt;
    }
};

const Columns<InfluenceAt> influence_curve_columns{
    {InCsv("of"), [](const InfluenceAt &at) { return at.curve->of; }},
    {InCsv("name"), [](const InfluenceAt &at) { return at.curve->name; }},
    {InCsv("z"), Quantity::length, [](const InfluenceAt &at) { return at.curve->z; }},
    {InCsv("angle"), Quantity::angle, [](const InfluenceAt &at) { return at.curve->angle; }},
    {InCsv("plane"), [](const InfluenceAt &at) { return at.curve->plane; }},
    {InCsv("speed"), Quantity::speed, &InfluenceAt::speed},
    {InCsv("influence"), Quantity::influence,
     [](const InfluenceAt &at) { return at.amplitude(false); }},
    {InCsv("force"), Quantity::number, [](const InfluenceAt &at) { return at.amplitude(true); }},
    {InCsv("phase"), Quantity::angle, [](const InfluenceAt &at) { return at.phase(); }},
    {InCsv("error"), Quantity::number, &InfluenceAt::error}};

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
    {InFiles("hole"), ForReaders("Hole"), &WeightPiece::hole},
    {InFiles("angle"), ForReaders("Angle", "{:.2f}"), Quantity::angle, &WeightPiece::angle},
    {InFiles("mass"), ForReaders("Mass"), Quantity::mass, &WeightPiece::mass},
    {InFiles("mr"), ForReaders("Weight"), Quantity::imbalance, &WeightPiece::mr}};

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

std::vector<InfluenceAt> influence_rows(const WeightsResult &result) {
    std::vector<InfluenceAt> rows;
    for (const InfluenceCurve &curve : result.influence_curves)
        for (std::size_t k = 0; k < result.curve_speeds.size(); ++k)
            rows.push_back({&curve, result.curve_speeds[k], curve.values[k],
                            k < curve.errors.size() ? curve.errors[k] : std::nullopt});
    return rows;
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

Json influence_curves_json(const WeightsResult &result, const Units &units) {
    if (result.influence_curves.empty())
        return nullptr;
    return {{"speeds", written(units, Quantity::speed, result.curve_speeds)},
            {"places", json_list(result.influence_curves, [&units](const InfluenceCurve &curve) {
                 std::vector<std::optional<double>> amplitudes, phases;
                 for (const auto &value : curve.values) {
                     amplitudes.push_back(value ? std::optional(std::abs(*value)) : std::nullopt);
                     phases.push_back(value ? phase_of(*value) : std::nullopt);
                 }
                 const bool force = curve.of == "force";
                 const Json none;
                 return Json{
                     {"of", curve.of},
                     {"name", curve.name},
                     {"z", written(units, Quantity::length, curve.z)},
                     {"angle", written(units, Quantity::angle, curve.angle)},
                     {"plane", curve.plane},
                     {"amplitude", force ? none : written(units, Quantity::influence, amplitudes)},
                     {"force", force ? written(units, Quantity::number, amplitudes) : none},
                     {"phase", written(units, Quantity::angle, phases)},
                     {"error", written(units, Quantity::number, curve.errors)}};
             })}};
}

/// Names of the procedures of ISO 21940-12.
const char *procedure_name(const std::string &letter) {
    constexpr std::array names{"single-plane balancing",
                               "two-plane balancing",
                               "individual component balancing prior to assembly",
                               "balancing subsequent to controlling initial unbalance",
                               "balancing in stages during assembly",
                               "balancing in optimum planes",
                               "multiple speed balancing",
                               "service speed balancing",
                               "fixed speed balancing"};
    return names.at(static_cast<std::size_t>(letter.at(0) - 'A'));
}

Json procedure_json(const WeightsResult &result, const Units &units) {
    if (!result.procedure)
        return nullptr;
    const BalancingProcedure &of = *result.procedure;
    return {{"flexible", of.flexible},
            {"procedures", of.procedures},
            {"body", of.body},
            {"body_given", of.body_given},
            {"removable", of.removable},
            {"discs", of.discs},
            {"service_speed", written(units, Quantity::speed, of.service_speed)},
            {"critical_speeds_below", of.criticals},
            {"bending_below", of.bending},
            {"next_bending", written(units, Quantity::speed, of.next_bending)},
            {"why", of.why.text()},
            {"planes", of.planes.text()}};
}

/// In sentences, one a line of the terminal or a paragraph of the page.
std::vector<std::string> procedure_lines(const WeightsResult &result, const Units &units) {
    if (!result.procedure)
        return {};
    const BalancingProcedure &of = *result.procedure;
    std::string procedures;
    for (const std::string &letter : of.procedures)
        procedures += fmt::format("{}{} ({})", procedures.empty() ? "" : " or ", letter,
                                  procedure_name(letter));
    return {fmt::format("{}: {}.",
                        procedures.empty()
                            ? "How it is balanced"
                            : "ISO 21940-12, as commonly known, not by its text: procedure " +
                                  procedures,
                        units.text(of.why)),
            fmt::format("How many planes: {}.", units.text(of.planes))};
}

Json json_of(const WeightsResult &result, const Units &units) {
    const auto amplitude = [&units](std::optional<double> value) {
        return written(units, Quantity::amplitude, value);
    };
    return {{"method", result.method},
            {"phase", phase_word(result.lag)},
            {"vibration_from", result.measured ? "readings" : "model"},
            {"influence_from", results::enum_name(result.source, {"trials", "table", "model"})},
            {"weights", json_rows(weight_columns, result.weights, units)},
            {"residual", json_rows(reading_columns, result.residual, units)},
            {"rms", amplitude(result.rms)},
            {"max", amplitude(result.max)},
            {"rms_before", amplitude(result.rms_before)},
            {"max_before", amplitude(result.max_before)},
            {"reached", amplitude(result.reached)},
            {"bound", amplitude(result.bound)},
            {"influence", json_rows(influence_columns, result.influence, units)},
            {"influence_over_speed", influence_curves_json(result, units)},
            {"procedure", procedure_json(result, units)},
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

std::vector<Section> sections_of(const WeightsResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Weights",
         element("p", summary_of(result, units)) +
             element("p", phase_convention(result.lag) + " Weights are to be added to what is on "
                                                         "the rotor.") +
             page_table(weight_columns, result.weights, units)},
        {"Readings before and after", page_table(reading_columns, result.residual, units)}};
    add_table(sections, "Weights as split", piece_columns, all_pieces(result), units);
    if (!result.choices.empty()) {
        std::string lines;
        for (const std::string &line : procedure_lines(result, units))
            lines += element("p", line);
        sections.push_back({"How many planes are needed",
                            page_table(choice_columns, result.choices, units) + lines});
    }
    add_table(sections, "Planes that nearly do the same", dependent_columns, result.dependent,
              units);
    add_table(sections, "Doubtful readings", doubtful_columns, result.outliers, units);
    sections.push_back(
        {"Influence coefficients", page_table(influence_columns, result.influence, units)});
    return sections;
}

std::string text_of(const model::Case &scene, const WeightsResult &result, const Units &units) {
    return heading(scene, "Correction weights") +
           text_table(weight_columns, result.weights, units) + "\n" +
           text_table(reading_columns, result.residual, units) + "\n" + summary_of(result, units) +
           "\n" + phase_convention(result.lag) + "\n" +
           text_table("\nWeights as split:\n", piece_columns, all_pieces(result), units) +
           text_table("\nHow many planes are needed:\n", choice_columns, result.choices, units) +
           joined(procedure_lines(result, units), "\n",
                  [](const std::string &line) { return line; }) +
           (result.procedure ? "\n" : "") +
           text_table("\nPlanes that nearly do the same:\n", dependent_columns, result.dependent,
                      units) +
           text_table("\nDoubtful readings:\n", doubtful_columns, result.outliers, units) +
           model_text(result.model, units);
}

} // namespace

Report describe(const model::Case &scene, const WeightsResult &result) {
    Report report =
        report_of<WeightsResult>("weights", "Correction weights", scene, result,
                                 {json_of, csv_of, sections_of, text_of, weights_chart});
    if (result.influence_curves.empty())
        return report;
    report.pictures = [&](const Units &units) {
        return std::vector<Picture>{{"influence", influence_chart(scene, result, units), {}}};
    };
    report.pictures_heading = "Influence over speed";
    report.tables = [&result] {
        return std::vector<TableFile>{{"weights_influence", [&result](const Units &units) {
                                           return csv_table(influence_curve_columns,
                                                            influence_rows(result), units);
                                       }}};
    };
    return report;
}

} // namespace whirl::report

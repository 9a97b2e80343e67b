// Report of the command response.

#include "results/response.h"

#include "report/common/error_parts.h"
#include "report/common/margins.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/response/gravity.h"
#include "report/response/marks.h"
#include "report/response/orbits.h"
#include "report/response/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace whirl::report {

using results::ResponseBearing;
using results::ResponseNode;
using results::ResponsePeak;
using results::ResponseProbe;
using results::ResponseResult;

namespace {

const Kind<ResponseNode> node_kind{
    "node",
    {series("amplitude", "amplitude", Quantity::amplitude, &ResponseNode::amplitude),
     series("phase", "phase", Quantity::angle, &ResponseNode::phase),
     series("major", "major", Quantity::amplitude, &ResponseNode::major),
     series("minor", "minor", Quantity::amplitude, &ResponseNode::minor),
     series("x", "x", Quantity::amplitude, &ResponseNode::x),
     series("x_phase", "x_phase", Quantity::angle, &ResponseNode::x_phase),
     series("y", "y", Quantity::amplitude, &ResponseNode::y),
     series("y_phase", "y_phase", Quantity::angle, &ResponseNode::y_phase),
     series("inclination", "inclination", Quantity::angle, &ResponseNode::inclination),
     series("error", "error", Quantity::number, &ResponseNode::error)}};

const Kind<ResponseBearing> bearing_kind{
    "bearing",
    {series("force", "force", Quantity::force, &ResponseBearing::force),
     series("error", "error", Quantity::number, &ResponseBearing::error)}};

const Kind<ResponseProbe> probe_kind{
    "probe",
    {series("amplitude", "amplitude", Quantity::amplitude, &ResponseProbe::amplitude),
     series("phase", "phase", Quantity::angle, &ResponseProbe::phase),
     series("error", "error", Quantity::number, &ResponseProbe::error)},
    {{"angle", InCsv("angle"), Quantity::angle, [](const auto &at) { return at.of->angle; }}}};

const std::vector<CsvHeading> csv_headings{{"speed", Quantity::speed},
                                           {"kind"},
                                           {"name"},
                                           {"z", Quantity::length},
                                           {"amplitude", Quantity::amplitude},
                                           {"phase", Quantity::angle},
                                           {"major", Quantity::amplitude},
                                           {"minor", Quantity::amplitude},
                                           {"force", Quantity::force},
                                           {"x", Quantity::amplitude},
                                           {"x_phase", Quantity::angle},
                                           {"y", Quantity::amplitude},
                                           {"y_phase", Quantity::angle},
                                           {"inclination", Quantity::angle},
                                           {"error"},
                                           {"angle", Quantity::angle}};

/// What the value of a peak is.
const OfEach peak_value{[](const ResponsePeak &peak) {
    return peak.of == "bearing" ? Quantity::force : Quantity::amplitude;
}};

/// The half-power points.
std::string half_power(const ResponsePeak &peak, const Units &units) {
    const auto end = [&units](const std::optional<double> &speed) {
        return speed ? fmt::format("{:.6g}", units(Quantity::speed, *speed)) : "-";
    };
    return peak.lower || peak.upper ? end(peak.lower) + " … " + end(peak.upper) : "";
}

const Columns<ResponsePeak> peaks_found = with_error_parts<ResponsePeak>(
    {{"of", &ResponsePeak::of},
     {"angle", Quantity::angle, &ResponsePeak::angle},
     {"z", OnPage("z", "{:.5g}"), Quantity::length, &ResponsePeak::z},
     {"name", OnPage("Place"), &ResponsePeak::name},
     {InText("peak at"), place_of},
     {ForReaders("of"),
      [](const ResponsePeak &peak, const Units &units) {
          return units.label(peak.of == "probe"
                                 ? "reading at " +
                                       units.text(Quantity::angle, peak.angle.value_or(0), 4)
                             : peak.of == "bearing" ? "force"
                                                    : "amplitude",
                             peak_value.quantity(peak));
      }},
     {"speed", OnPage("at", "{:.8g}"), InText("", "{:.8g}"), Quantity::speed, &ResponsePeak::speed},
     {"mode", OnPage("Mode", "{}", ""), InText("mode", "{}", ""),
      [](const ResponsePeak &peak) { return known_name(peak.mode); }},
     {"value", OnPage("Peak", "{:.6g}", "no limit"), InText("value", "{:.6g}", "no limit"),
      peak_value, &ResponsePeak::value},
     {"phase", OnPage("Phase", "{:.1f}", ""), InText("phase", "{:.1f}", ""), Quantity::angle,
      &ResponsePeak::phase},
     {"amplification", OnPage("Amplification factor", "{:.4g}", ""), InText("AF", "{:.4g}", ""),
      Quantity::number, &ResponsePeak::amplification},
     {"half_power", Quantity::speed,
      [](const ResponsePeak &peak) {
          return Json{Json(peak.lower), Json(peak.upper)};
      }},
     {OnPage("Half-power points"), InText("half power"), Quantity::speed, half_power},
     {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), Quantity::number,
      &ResponsePeak::error},
     {"speed_error", Quantity::number, &ResponsePeak::speed_error}},
    error_part);

} // namespace

const Columns<ResponsePeak> &curve_peaks() { return peaks_found; }

Json curves_of_kind(const results::ResponseCurves &curves, std::size_t from, std::size_t to,
                    const char *key, Quantity quantity, const Units &units) {
    Json list = Json::array();
    for (std::size_t i = from; i < to && i < curves.values.size(); ++i)
        list.push_back({{key, written(units, quantity, curves.values[i])},
                        {"phase", written(units, Quantity::angle, curves.phases[i])}});
    return list;
}

namespace {

constexpr std::size_t amplitude_column = 3; ///< of peak_columns

/// @param what  the amplitude on the terminal
Columns<LargestValue> peak_columns(const char *on_page, const char *on_terminal, const char *what) {
    return {{OnPage(on_page), &LargestValue::name},
            {OnPage("z", "{:.5g}"), Quantity::length, &LargestValue::z},
            {InText(on_terminal), place_of},
            {OnPage("Amplitude", "{:.6g}", "no limit"), InText(what, "{:.6g}", "no limit"),
             Quantity::amplitude, &LargestValue::value},
            {ForReaders("at"), Quantity::speed, &LargestValue::speed},
            {OnPage("Relative error", "{:.2g}"), InText("error", rough), Quantity::number,
             &LargestValue::error}};
}

const Columns<LargestValue> station_columns = peak_columns("Place", "station", "largest amplitude");

Columns<LargestValue> force_columns() {
    Columns<LargestValue> columns = peak_columns("", "bearing", "");
    columns[amplitude_column] = {InText("largest force", "{:.6g}", "no limit"), Quantity::force,
                                 &LargestValue::value};
    return columns;
}

Columns<LargestValue> probe_peak_columns() {
    Columns<LargestValue> columns = peak_columns("Probe", "probe", "largest reading");
    columns.insert(columns.begin() + amplitude_column, {OnPage("Direction"), InText("looks along"),
                                                        Quantity::angle, &LargestValue::angle});
    return columns;
}

std::vector<LargestValue> largest_amplitudes(const ResponseResult &result) {
    return peaks_of(result.speeds, result.peaks, result.nodes, &ResponseNode::amplitude, "station");
}
std::vector<LargestValue> largest_readings(const ResponseResult &result) {
    return peaks_of(result.speeds, result.peaks, result.probes, &ResponseProbe::amplitude, "probe");
}
std::vector<LargestValue> largest_forces(const ResponseResult &result) {
    return peaks_of(result.speeds, result.peaks, result.bearings, &ResponseBearing::force,
                    "bearing");
}

Json curves_json(const ResponseResult &result, const Units &units) {
    const results::ResponseCurves &curves = result.curves;
    const std::size_t nodes = result.nodes.size();
    const std::size_t probes = nodes + result.bearings.size();
    const auto kind = [&](std::size_t from, std::size_t to, const char *key, Quantity quantity) {
        return curves_of_kind(curves, from, to, key, quantity, units);
    };
    return {{"speeds", written(units, Quantity::speed, curves.speeds)},
            {"nodes", kind(0, nodes, "amplitude", Quantity::amplitude)},
            {"bearings", kind(nodes, probes, "force", Quantity::force)},
            {"probes", kind(probes, curves.values.size(), "amplitude", Quantity::amplitude)}};
}

Json json_of(const ResponseResult &result, const Units &units) {
    Json json{{"speeds", written(units, Quantity::speed, result.speeds)},
              {"peaks", json_rows(curve_peaks(), result.peaks, units)},
              {"nodes", node_kind.json(result.speeds, result.nodes, units)},
              {"bearings", bearing_kind.json(result.speeds, result.bearings, units)},
              {"probes", probe_kind.json(result.speeds, result.probes, units)},
              {"curves", curves_json(result, units)}};
    add_orbits(json, result, units);
    add_margins(json, result.margins, units);
    if (result.gravity)
        json["gravity"] = gravity_json(*result.gravity, result.speeds, units);
    return json;
}

/// The weight is all that drives the rotor.
bool weight_alone(const ResponseResult &result) { return result.gravity && result.nodes.empty(); }

std::string csv_of(const ResponseResult &result, const Units &units) {
    if (weight_alone(result))
        return gravity_csv(*result.gravity, result.speeds, units);
    std::string csv = csv_head_line(csv_headings, units);
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        csv += node_kind.csv(csv_headings, result.speeds[i], i, result.nodes, units) +
               bearing_kind.csv(csv_headings, result.speeds[i], i, result.bearings, units) +
               probe_kind.csv(csv_headings, result.speeds[i], i, result.probes, units);
    return csv;
}

std::vector<Section> sections_of(const ResponseResult &result, const Units &units) {
    std::vector<Section> of_weight;
    if (result.gravity)
        of_weight = gravity_sections(*result.gravity, result.speeds, units);
    if (weight_alone(result))
        return of_weight;
    std::vector<Section> sections{{"Peaks", result.peaks.empty()
                                                ? "<p>None inside the range.</p>"
                                                : page_table(curve_peaks(), result.peaks, units)},
                                  {"Largest amplitudes in the range",
                                   page_table(station_columns, largest_amplitudes(result), units)}};
    if (result.margins)
        sections.insert(sections.begin() + 1,
                        {margins_heading, margins_page(*result.margins, units)});
    if (!result.probes.empty())
        sections.push_back({"Largest readings of the probes",
                            page_table(probe_peak_columns(), largest_readings(result), units)});
    const std::vector<Section> of_orbits = orbit_sections(result, units);
    sections.insert(sections.end(), of_orbits.begin(), of_orbits.end());
    sections.insert(sections.end(), of_weight.begin(), of_weight.end());
    return sections;
}

std::string imbalance_text(const ResponseResult &result, const Units &units) {
    return (result.peaks.empty() ? "No peak inside the range.\n"
                                 : text_table(curve_peaks(), result.peaks, units)) +
           margins_text(result.margins, units) + "\n" +
           text_table(station_columns, largest_amplitudes(result), units) +
           text_table("\n", probe_peak_columns(), largest_readings(result), units) +
           text_table("\n", force_columns(), largest_forces(result), units) +
           orbit_text(result, units);
}

std::string text_of(const model::Case &scene, const ResponseResult &result, const Units &units) {
    std::string text = heading(
        scene, (weight_alone(result) ? "Response to the weight, " : "Unbalance response, ") +
                   range_text(result.speeds, units));
    if (!weight_alone(result))
        text += imbalance_text(result, units) + (result.gravity ? "\n" : "");
    if (result.gravity)
        text += gravity_text(*result.gravity, result.speeds, units);
    return text + model_text(result.model, units);
}

/// The polar plot, orbits and shapes, and the picture of the weight beside that of the imbalances.
std::vector<Picture> pictures_of(const model::Case &scene, const ResponseResult &result,
                                 const Units &units) {
    std::vector<Picture> pictures;
    if (has_polar(result))
        pictures.push_back({"response_polar", polar_figure(scene, result, units), {}});
    for (Picture &picture : orbit_pictures(scene, result, units))
        pictures.push_back(std::move(picture));
    if (result.gravity && !weight_alone(result))
        pictures.push_back({"response_gravity", gravity_figure(scene, result, units),
                            [&result](const Units &units) {
                                return gravity_csv(*result.gravity, result.speeds, units);
                            }});
    return pictures;
}

/// "Polar plot, orbits, deflected shapes"
std::string pictures_heading(const ResponseResult &result) {
    std::vector<std::string> words;
    if (has_polar(result))
        words.emplace_back("polar plot");
    if (!result.orbits.empty())
        words.emplace_back("orbits");
    if (!result.shapes.empty())
        words.emplace_back("deflected shapes");
    if (result.gravity && !weight_alone(result))
        words.emplace_back("motion under the weight");
    std::string heading = words.empty() ? "pictures" : joined(words, ", ");
    heading.front() = static_cast<char>(std::toupper(heading.front()));
    return heading;
}

Figure main_figure(const model::Case &scene, const ResponseResult &result, const Units &units) {
    return weight_alone(result) ? gravity_figure(scene, result, units)
                                : response_figure(scene, result, units);
}

} // namespace

Report describe(const model::Case &scene, const ResponseResult &result) {
    Report report = report_of<ResponseResult>(
        "response", weight_alone(result) ? "Response to the weight" : "Unbalance response", scene,
        result, {json_of, csv_of, sections_of, text_of, main_figure});
    report.pictures = [&scene, &result](const Units &units) {
        return pictures_of(scene, result, units);
    };
    report.pictures_heading = pictures_heading(result);
    report.pictures_after = weight_alone(result) ? 0 : 2;
    return report;
}

} // namespace whirl::report

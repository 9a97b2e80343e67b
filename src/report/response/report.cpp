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
    {series("amplitude", "amplitude [m]", &ResponseNode::amplitude),
     series("phase", "phase [rad]", &ResponseNode::phase),
     series("major", "major [m]", &ResponseNode::major),
     series("minor", "minor [m]", &ResponseNode::minor), series("x", "x [m]", &ResponseNode::x),
     series("x_phase", "x_phase [rad]", &ResponseNode::x_phase),
     series("y", "y [m]", &ResponseNode::y),
     series("y_phase", "y_phase [rad]", &ResponseNode::y_phase),
     series("inclination", "inclination [rad]", &ResponseNode::inclination),
     series("error", "error", &ResponseNode::error)}};

const Kind<ResponseBearing> bearing_kind{"bearing",
                                         {series("force", "force [N]", &ResponseBearing::force),
                                          series("error", "error", &ResponseBearing::error)}};

const Kind<ResponseProbe> probe_kind{
    "probe",
    {series("amplitude", "amplitude [m]", &ResponseProbe::amplitude),
     series("phase", "phase [rad]", &ResponseProbe::phase),
     series("error", "error", &ResponseProbe::error)},
    {{"angle", InCsv("angle [rad]"), [](const auto &at) { return at.of->angle; }}}};

const std::vector<std::string> csv_headings{"speed [rad/s]", "kind",
                                            "name",          "z [m]",
                                            "amplitude [m]", "phase [rad]",
                                            "major [m]",     "minor [m]",
                                            "force [N]",     "x [m]",
                                            "x_phase [rad]", "y [m]",
                                            "y_phase [rad]", "inclination [rad]",
                                            "error",         "angle [rad]"};

/// A half-power point, rpm.
std::string half_power(const ResponsePeak &peak) {
    const auto end = [](const std::optional<double> &speed) {
        return speed ? fmt::format("{:.6g}", *speed * rpm) : "-";
    };
    return peak.lower || peak.upper ? end(peak.lower) + " … " + end(peak.upper) : "";
}

const Columns<ResponsePeak> peaks_found = with_error_parts<ResponsePeak>(
    {{"of", &ResponsePeak::of},
     {"angle", &ResponsePeak::angle},
     {"z", OnPage("z (m)", "{:.5g}"), &ResponsePeak::z},
     {"name", OnPage("Place"), &ResponsePeak::name},
     {InText("peak at"), place_of},
     {ForReaders("of"),
      [](const ResponsePeak &peak) -> std::string {
          if (peak.of == "probe")
              return fmt::format("reading at {:.4g}° ({})", peak.angle.value_or(0) * degrees,
                                 unit_name("amplitude", "µm"));
          return peak.of == "bearing" ? fmt::format("force ({})", unit_name("force", "N"))
                                      : fmt::format("amplitude ({})", unit_name("amplitude", "µm"));
      }},
     {"speed", &ResponsePeak::speed},
     {OnPage("at (rpm)", "{:.8g}"), InText("rpm", "{:.8g}"), in(rpm, &ResponsePeak::speed)},
     {"mode", OnPage("Mode", "{}", ""), InText("mode", "{}", ""),
      [](const ResponsePeak &peak) { return known_name(peak.mode); }},
     {"value", &ResponsePeak::value},
     {OnPage("Peak", "{:.6g}", "no limit"), InText("value", "{:.6g}", "no limit"),
      [](const ResponsePeak &peak) {
          return peak.value * (peak.of == "bearing" ? newtons : micrometres);
      }},
     {"phase", &ResponsePeak::phase},
     {OnPage("Phase (deg)", "{:.1f}", ""), InText("phase deg", "{:.1f}", ""),
      [](const ResponsePeak &peak) {
          return std::isfinite(peak.phase) ? std::optional(peak.phase * degrees) : std::nullopt;
      }},
     {"amplification", OnPage("Amplification factor", "{:.4g}", ""), InText("AF", "{:.4g}", ""),
      &ResponsePeak::amplification},
     {"half_power",
      [](const ResponsePeak &peak) {
          return Json{Json(peak.lower), Json(peak.upper)};
      }},
     {OnPage("Half-power points (rpm)"), InText("half power rpm"), half_power},
     {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &ResponsePeak::error},
     {"speed_error", &ResponsePeak::speed_error}},
    error_part);

} // namespace

const Columns<ResponsePeak> &curve_peaks() { return peaks_found; }

Json curves_of_kind(const results::ResponseCurves &curves, std::size_t from, std::size_t to,
                    const char *key) {
    Json list = Json::array();
    for (std::size_t i = from; i < to && i < curves.values.size(); ++i)
        list.push_back({{key, curves.values[i]}, {"phase", curves.phases[i]}});
    return list;
}

namespace {

constexpr std::size_t amplitude_column = 3; ///< of peak_columns

/// @param what  the amplitude on the terminal
Columns<LargestValue> peak_columns(const char *on_page, const char *on_terminal, const char *what) {
    return {{OnPage(on_page), &LargestValue::name},
            {OnPage("z (m)", "{:.5g}"), &LargestValue::z},
            {InText(on_terminal), place_of},
            {OnPage("Amplitude (µm)", "{:.6g}", "no limit"), InText(what, "{:.6g}", "no limit"),
             in(micrometres, &LargestValue::value)},
            {OnPage("at (rpm)"), InText("at rpm"), in(rpm, &LargestValue::speed)},
            {OnPage("Relative error", "{:.2g}"), InText("error", rough), &LargestValue::error}};
}

const Columns<LargestValue> station_columns =
    peak_columns("Place", "station", "largest amplitude µm");

Columns<LargestValue> force_columns() {
    Columns<LargestValue> columns = peak_columns("", "bearing", "");
    columns[amplitude_column] = {InText("largest force N", "{:.6g}", "no limit"),
                                 &LargestValue::value};
    return columns;
}

Columns<LargestValue> probe_peak_columns() {
    Columns<LargestValue> columns = peak_columns("Probe", "probe", "largest reading µm");
    columns.insert(
        columns.begin() + amplitude_column,
        {OnPage("Direction (deg)"), InText("looks along deg"), in(degrees, &LargestValue::angle)});
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

Json curves_json(const ResponseResult &result) {
    const results::ResponseCurves &curves = result.curves;
    const std::size_t nodes = result.nodes.size();
    const std::size_t probes = nodes + result.bearings.size();
    return {{"speeds", curves.speeds},
            {"nodes", curves_of_kind(curves, 0, nodes, "amplitude")},
            {"bearings", curves_of_kind(curves, nodes, probes, "force")},
            {"probes", curves_of_kind(curves, probes, curves.values.size(), "amplitude")}};
}

Json json_of(const ResponseResult &result, const Units &) {
    Json json{{"speeds", result.speeds},
              {"peaks", json_rows(curve_peaks(), result.peaks)},
              {"nodes", node_kind.json(result.speeds, result.nodes)},
              {"bearings", bearing_kind.json(result.speeds, result.bearings)},
              {"probes", probe_kind.json(result.speeds, result.probes)},
              {"curves", curves_json(result)}};
    add_orbits(json, result);
    add_margins(json, result.margins);
    if (result.gravity)
        json["gravity"] = gravity_json(*result.gravity, result.speeds);
    return json;
}

/// The weight is all that drives the rotor.
bool weight_alone(const ResponseResult &result) { return result.gravity && result.nodes.empty(); }

std::string csv_of(const ResponseResult &result, const Units &) {
    if (weight_alone(result))
        return gravity_csv(*result.gravity, result.speeds);
    std::string csv = csv_head_line(csv_headings);
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        csv += node_kind.csv(csv_headings, result.speeds[i], i, result.nodes) +
               bearing_kind.csv(csv_headings, result.speeds[i], i, result.bearings) +
               probe_kind.csv(csv_headings, result.speeds[i], i, result.probes);
    return csv;
}

std::vector<Section> sections_of(const ResponseResult &result, const Units &) {
    std::vector<Section> of_weight;
    if (result.gravity)
        of_weight = gravity_sections(*result.gravity, result.speeds);
    if (weight_alone(result))
        return of_weight;
    std::vector<Section> sections{{"Peaks", result.peaks.empty()
                                                ? "<p>None inside the range.</p>"
                                                : page_table(curve_peaks(), result.peaks)},
                                  {"Largest amplitudes in the range",
                                   page_table(station_columns, largest_amplitudes(result))}};
    if (result.margins)
        sections.insert(sections.begin() + 1, {margins_heading, margins_page(*result.margins)});
    if (!result.probes.empty())
        sections.push_back({"Largest readings of the probes",
                            page_table(probe_peak_columns(), largest_readings(result))});
    const std::vector<Section> of_orbits = orbit_sections(result);
    sections.insert(sections.end(), of_orbits.begin(), of_orbits.end());
    sections.insert(sections.end(), of_weight.begin(), of_weight.end());
    return sections;
}

std::string imbalance_text(const ResponseResult &result) {
    return (result.peaks.empty() ? "No peak inside the range.\n"
                                 : text_table(curve_peaks(), result.peaks)) +
           margins_text(result.margins) + "\n" +
           text_table(station_columns, largest_amplitudes(result)) +
           text_table("\n", probe_peak_columns(), largest_readings(result)) +
           text_table("\n", force_columns(), largest_forces(result)) + orbit_text(result);
}

std::string text_of(const model::Case &scene, const ResponseResult &result, const Units &) {
    std::string text = heading(
        scene, (weight_alone(result) ? "Response to the weight, " : "Unbalance response, ") +
                   range_text(result.speeds));
    if (!weight_alone(result))
        text += imbalance_text(result) + (result.gravity ? "\n" : "");
    if (result.gravity)
        text += gravity_text(*result.gravity, result.speeds);
    return text + model_text(result.model);
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
        pictures.push_back(
            {"response_gravity", gravity_figure(scene, result, units),
             [&result](const Units &) { return gravity_csv(*result.gravity, result.speeds); }});
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

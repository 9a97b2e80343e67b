// Report of the command response.

#include "results/response.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::ResponseBearing;
using results::ResponseNode;
using results::ResponsePeak;
using results::ResponseProbe;
using results::ResponseResult;

namespace {

/// A station, a bearing or a probe at one speed.
template <class Of> struct At {
    double speed; ///< rad/s
    const Of *of;
    std::size_t index; ///< of the speed
};

template <class Of> Column<At<Of>> series(std::string key, std::string csv, auto Of::*list) {
    return {std::move(key), std::move(csv), {}, {}, [list](const At<Of> &at) {
                const auto &values = at.of->*list;
                return at.index < values.size() ? Json(values[at.index]) : Json();
            }};
}

/// What does not depend on the speed.
template <class Of> Columns<At<Of>> place_columns(const char *kind) {
    return {{"", "speed [rad/s]", {}, {}, &At<Of>::speed},
            {"", "kind", {}, {}, [kind](const At<Of> &) { return kind; }},
            {"z", "z [m]", {}, {}, [](const At<Of> &at) { return at.of->z; }},
            {"name", "name", {}, {}, [](const At<Of> &at) { return at.of->name; }}};
}

const Columns<At<ResponseNode>> node_series{
    series("amplitude", "amplitude [m]", &ResponseNode::amplitude),
    series("phase", "phase [rad]", &ResponseNode::phase),
    series("major", "major [m]", &ResponseNode::major),
    series("minor", "minor [m]", &ResponseNode::minor),
    series("x", "x [m]", &ResponseNode::x),
    series("x_phase", "x_phase [rad]", &ResponseNode::x_phase),
    series("y", "y [m]", &ResponseNode::y),
    series("y_phase", "y_phase [rad]", &ResponseNode::y_phase),
    series("inclination", "inclination [rad]", &ResponseNode::inclination),
    series("error", "error", &ResponseNode::error)};

const Columns<At<ResponseBearing>> bearing_series{
    series("force", "force [N]", &ResponseBearing::force),
    series("error", "error", &ResponseBearing::error)};

const Columns<At<ResponseProbe>> probe_series{
    series("amplitude", "amplitude [m]", &ResponseProbe::amplitude),
    series("phase", "phase [rad]", &ResponseProbe::phase),
    series("error", "error", &ResponseProbe::error)};

Columns<At<ResponseProbe>> probe_places() {
    auto columns = place_columns<ResponseProbe>("probe");
    columns.push_back(
        {"angle", "angle [rad]", {}, {}, [](const auto &at) { return at.of->angle; }});
    return columns;
}

const std::vector<std::string> csv_headings{"speed [rad/s]", "kind",
                                            "name",          "z [m]",
                                            "amplitude [m]", "phase [rad]",
                                            "major [m]",     "minor [m]",
                                            "force [N]",     "x [m]",
                                            "x_phase [rad]", "y [m]",
                                            "y_phase [rad]", "inclination [rad]",
                                            "error",         "angle [rad]"};

/// Everything of a kind in JSON: what stands once, and lists over the speeds.
template <class Of>
Json json_of_kind(const ResponseResult &result, const std::vector<Of> &all,
                  const Columns<At<Of>> &once, const Columns<At<Of>> &over_speeds) {
    return json_list(all, [&](const Of &of) {
        std::vector<At<Of>> rows;
        for (std::size_t i = 0; i < result.speeds.size(); ++i)
            rows.push_back({result.speeds[i], &of, i});
        Json json = json_row(once, At<Of>{0, &of, 0});
        json.update(json_lists(over_speeds, rows));
        return json;
    });
}

template <class Of>
std::string csv_of_kind(const ResponseResult &result, std::size_t index, const std::vector<Of> &all,
                        Columns<At<Of>> columns, const Columns<At<Of>> &more) {
    columns.insert(columns.end(), more.begin(), more.end());
    std::vector<At<Of>> rows;
    for (const Of &of : all)
        rows.push_back({result.speeds[index], &of, index});
    return csv_rows(csv_headings, columns, rows);
}

/// A half-power point, rpm.
std::string half_power(const ResponsePeak &peak) {
    const auto end = [](const std::optional<double> &speed) {
        return speed ? fmt::format("{:.6g}", *speed * rpm) : "-";
    };
    return peak.lower || peak.upper ? end(peak.lower) + " … " + end(peak.upper) : "";
}

const Columns<ResponsePeak> curve_peaks{
    {"of", "", {}, {}, &ResponsePeak::of},
    {"angle", "", {}, {}, &ResponsePeak::angle},
    {"z", "", {"z (m)", "{:.5g}"}, {}, &ResponsePeak::z},
    {"name", "", {"Place"}, {}, &ResponsePeak::name},
    {"", "", {}, {"peak at"}, [](const ResponsePeak &peak) { return place(peak.name, peak.z); }},
    {"",
     "",
     {"of"},
     {"of"},
     [](const ResponsePeak &peak) -> std::string {
         if (peak.of == "probe")
             return fmt::format("reading at {:.4g}° (m)", peak.angle.value_or(0) * degrees);
         return peak.of == "bearing" ? "force (N)" : "amplitude (m)";
     }},
    {"speed", "", {}, {}, &ResponsePeak::speed},
    {"",
     "",
     {"at (rpm)", "{:.8g}"},
     {"rpm", "{:.8g}"},
     [](const ResponsePeak &peak) { return peak.speed * rpm; }},
    {"value",
     "",
     {"Peak", "{:.6g}", "no limit"},
     {"value", "{:.6g}", "no limit"},
     &ResponsePeak::value},
    {"phase", "", {}, {}, &ResponsePeak::phase},
    {"",
     "",
     {"Phase (deg)", "{:.1f}", ""},
     {"phase deg", "{:.1f}", ""},
     [](const ResponsePeak &peak) {
         return std::isfinite(peak.phase) ? std::optional(peak.phase * degrees) : std::nullopt;
     }},
    {"amplification",
     "",
     {"Amplification factor", "{:.4g}", ""},
     {"AF", "{:.4g}", ""},
     &ResponsePeak::amplification},
    {"half_power",
     "",
     {},
     {},
     [](const ResponsePeak &peak) {
         return Json{Json(peak.lower), Json(peak.upper)};
     }},
    {"", "", {"Half-power points (rpm)"}, {"half power rpm"}, half_power},
    {"error", "", {"Relative error", "{:.2g}"}, {"error", rough}, &ResponsePeak::error},
    {"speed_error", "", {}, {}, &ResponsePeak::speed_error}};

template <class Of> bool is_of(const ResponsePeak &peak, const Of &of, const char *kind) {
    if constexpr (std::is_same_v<Of, ResponseProbe>)
        if (peak.angle != of.angle)
            return false;
    return peak.of == kind && peak.z == of.z;
}

/// The largest value in the range: a peak, or at one of its ends.
struct Peak {
    std::string name;
    double z = 0;                ///< m
    double angle = 0;            ///< of a probe, rad
    std::optional<double> value; ///< infinite: no limit
    double speed = 0;            ///< rad/s
    std::optional<double> error; ///< relative
};

template <class Of>
std::vector<Peak> peaks_of(const ResponseResult &result, const std::vector<Of> &all,
                           std::vector<double> Of::*list, const char *kind) {
    std::vector<Peak> peaks;
    for (const Of &of : all) {
        Peak peak{of.name, of.z, 0, {}, 0, {}};
        if constexpr (std::is_same_v<Of, ResponseProbe>)
            peak.angle = of.angle;
        const std::vector<double> &values = of.*list;
        const auto end = values.begin() +
                         static_cast<std::ptrdiff_t>(std::min(values.size(), result.speeds.size()));
        const auto at =
            static_cast<std::size_t>(std::max_element(values.begin(), end) - values.begin());
        if (values.begin() != end) {
            peak.value = values[at];
            peak.speed = result.speeds[at];
            if (at < of.error.size())
                peak.error = of.error[at];
        }
        for (const ResponsePeak &found : result.peaks)
            if (is_of(found, of, kind) && (!peak.value || found.value > *peak.value)) {
                peak.value = found.value;
                peak.speed = found.speed;
                peak.error = found.error;
            }
        peaks.push_back(peak);
    }
    return peaks;
}

/// @param what  the quantity on the terminal; the page has amplitudes alone
Columns<Peak> peak_columns(const char *on_page, const char *on_terminal, const char *what) {
    return {{"", "", {on_page}, {}, &Peak::name},
            {"", "", {"z (m)", "{:.5g}"}, {}, &Peak::z},
            {"", "", {}, {on_terminal}, [](const Peak &peak) { return place(peak.name, peak.z); }},
            {"",
             "",
             {"Amplitude (µm)", "{:.6g}", "no limit"},
             {},
             [](const Peak &peak) {
                 return peak.value ? std::optional(*peak.value * 1e6) : std::nullopt;
             }},
            {"", "", {}, {what, "{:.6g}", "no limit"}, &Peak::value},
            {"", "", {"at (rpm)"}, {"at rpm"}, [](const Peak &peak) { return peak.speed * rpm; }},
            {"", "", {"Relative error", "{:.2g}"}, {"error", rough}, &Peak::error}};
}

Columns<Peak> probe_peak_columns() {
    Columns<Peak> columns = peak_columns("Probe", "probe", "largest reading m");
    columns.insert(columns.begin() + 3,
                   {"", "", {"Direction (deg)"}, {"looks along deg"}, [](const Peak &peak) {
                        return peak.angle * degrees;
                    }});
    return columns;
}

Json curves_json(const ResponseResult &result) {
    const results::ResponseCurves &curves = result.curves;
    const auto of_places = [&](std::size_t from, std::size_t to, const char *key) {
        Json list = Json::array();
        for (std::size_t i = from; i < to && i < curves.values.size(); ++i)
            list.push_back({{key, curves.values[i]}, {"phase", curves.phases[i]}});
        return list;
    };
    const std::size_t nodes = result.nodes.size();
    const std::size_t probes = nodes + result.bearings.size();
    return {{"speeds", curves.speeds},
            {"nodes", of_places(0, nodes, "amplitude")},
            {"bearings", of_places(nodes, probes, "force")},
            {"probes", of_places(probes, curves.values.size(), "amplitude")}};
}

Json json_of(const ResponseResult &result) {
    return {{"speeds", result.speeds},
            {"peaks", json_rows(curve_peaks, result.peaks)},
            {"nodes",
             json_of_kind(result, result.nodes, place_columns<ResponseNode>("node"), node_series)},
            {"bearings", json_of_kind(result, result.bearings,
                                      place_columns<ResponseBearing>("bearing"), bearing_series)},
            {"probes", json_of_kind(result, result.probes, probe_places(), probe_series)},
            {"curves", curves_json(result)}};
}

std::string csv_of(const ResponseResult &result) {
    std::string csv = csv_line(csv_headings);
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        csv +=
            csv_of_kind(result, i, result.nodes, place_columns<ResponseNode>("node"), node_series) +
            csv_of_kind(result, i, result.bearings, place_columns<ResponseBearing>("bearing"),
                        bearing_series) +
            csv_of_kind(result, i, result.probes, probe_places(), probe_series);
    return csv;
}

std::vector<Section> sections_of(const ResponseResult &result) {
    std::vector<Section> sections{
        {"Peaks", result.peaks.empty() ? "<p>None inside the range.</p>"
                                       : page_table(curve_peaks, result.peaks)},
        {"Largest amplitudes in the range",
         page_table(peak_columns("Place", "", ""),
                    peaks_of(result, result.nodes, &ResponseNode::amplitude, "station"))}};
    if (!result.probes.empty())
        sections.push_back(
            {"Largest readings of the probes",
             page_table(probe_peak_columns(),
                        peaks_of(result, result.probes, &ResponseProbe::amplitude, "probe"))});
    return sections;
}

std::string text_of(const model::Case &scene, const ResponseResult &result) {
    std::string text =
        heading(scene, "Unbalance response, " + range_text(result.speeds)) +
        (result.peaks.empty() ? "No peak inside the range.\n"
                              : text_table(curve_peaks, result.peaks)) +
        "\n" +
        text_table(peak_columns("", "station", "largest amplitude m"),
                   peaks_of(result, result.nodes, &ResponseNode::amplitude, "station"));
    if (!result.probes.empty())
        text +=
            "\n" + text_table(probe_peak_columns(),
                              peaks_of(result, result.probes, &ResponseProbe::amplitude, "probe"));
    if (!result.bearings.empty())
        text += "\n" +
                text_table(peak_columns("", "bearing", "largest force N"),
                           peaks_of(result, result.bearings, &ResponseBearing::force, "bearing"));
    return text + model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const ResponseResult &result) {
    return report_of<ResponseResult>("response", "Unbalance response", scene, result,
                                     {json_of, csv_of, sections_of, text_of, response_figure});
}

} // namespace whirl::report

#include "report/response/gravity.h"

#include "report/common/units.h"
#include "report/common/words.h"
#include "report/response/tables.h"

#include <fmt/format.h>

namespace whirl::report {

using results::GravityBearing;
using results::GravityResponse;
using results::GravityStation;

namespace {

const Kind<GravityStation> station_kind{
    "station",
    {series("static", "static [m]", &GravityStation::sag),
     series("static_x", "static_x [m]", &GravityStation::sag_x),
     series("static_y", "static_y [m]", &GravityStation::sag_y),
     series("twice", "twice [m]", &GravityStation::twice),
     series("phase", "phase [rad]", &GravityStation::phase),
     series("error", "error", &GravityStation::error),
     series("static_error", "static_error", &GravityStation::sag_error)}};

const Kind<GravityBearing> gravity_bearing_kind{
    "bearing",
    {series("static", "static force [N]", &GravityBearing::carried),
     series("twice", "twice force [N]", &GravityBearing::twice),
     series("error", "error", &GravityBearing::error),
     series("static_error", "static_error", &GravityBearing::carried_error)}};

const std::vector<std::string> gravity_headings{
    "speed [rad/s]",   "kind",         "name",        "z [m]",       "static [m]",
    "static_x [m]",    "static_y [m]", "twice [m]",   "phase [rad]", "static force [N]",
    "twice force [N]", "error",        "static_error"};

Json curves_json(const GravityResponse &response) {
    const results::ResponseCurves &curves = response.curves;
    const std::size_t stations = response.stations.size();
    return {{"speeds", curves.speeds},
            {"stations", curves_of_kind(curves, 0, stations, "twice")},
            {"bearings",
             curves_of_kind(curves, stations, stations + response.bearings.size(), "twice")}};
}

/// Largest circle of a place beside what stands still there at the first speed.
struct Summary : LargestValue {
    double still = 0; ///< m or N
};

template <class Of>
std::vector<Summary> summaries(const GravityResponse &response, const std::vector<double> &speeds,
                               const std::vector<Of> &all, std::vector<double> Of::*still,
                               const char *kind) {
    std::vector<Summary> out;
    for (const LargestValue &largest : peaks_of(speeds, response.peaks, all, &Of::twice, kind))
        out.push_back({largest, (all[out.size()].*still).front()});
    return out;
}

/// @param still, circle  factors of what stands still and of what vibrates, for readers
Columns<Summary> summary_columns(const char *on_page, const char *on_terminal, const char *unit,
                                 auto still, auto circle) {
    const std::string of_still = fmt::format("static {}", unit);
    const std::string of_circle = fmt::format("largest at twice the spin speed {}", unit);
    return {{OnPage(on_page), InText(on_terminal), place_of},
            {OnPage(of_still), InText(of_still, "{:.6g}", "no limit"), in(still, &Summary::still)},
            {ForReaders(of_circle, "{:.6g}", "no limit"), in(circle, &Summary::value)},
            {OnPage("at (rpm)"), InText("at rpm"), in(rpm, &Summary::speed)},
            {OnPage("Relative error", "{:.2g}"), InText("error", rough), &Summary::error}};
}
const Columns<Summary> deflection_columns =
    summary_columns("Place", "station", "µm", still_micrometres, micrometres);
// A table converts newtons itself.
const Columns<Summary> carried_columns = summary_columns("Bearing", "bearing", "N", 1.0, 1.0);

std::vector<Summary> of_stations(const GravityResponse &response,
                                 const std::vector<double> &speeds) {
    return summaries(response, speeds, response.stations, &GravityStation::sag, "station");
}
std::vector<Summary> of_bearings(const GravityResponse &response,
                                 const std::vector<double> &speeds) {
    return summaries(response, speeds, response.bearings, &GravityBearing::carried, "bearing");
}

} // namespace

Json gravity_json(const GravityResponse &response, const std::vector<double> &speeds) {
    return {{"gravity", response.gravity},
            {"stations", station_kind.json(speeds, response.stations)},
            {"bearings", gravity_bearing_kind.json(speeds, response.bearings)},
            {"peaks", json_rows(curve_peaks(), response.peaks)},
            {"curves", curves_json(response)}};
}

std::string gravity_csv(const GravityResponse &response, const std::vector<double> &speeds) {
    std::string csv = csv_head_line(gravity_headings);
    for (std::size_t i = 0; i < speeds.size(); ++i)
        csv += station_kind.csv(gravity_headings, speeds[i], i, response.stations) +
               gravity_bearing_kind.csv(gravity_headings, speeds[i], i, response.bearings);
    return csv;
}

std::vector<Section> gravity_sections(const GravityResponse &response,
                                      const std::vector<double> &speeds) {
    std::vector<Section> out{
        {"Weight: peaks of the motion at twice the spin speed",
         response.peaks.empty() ? "<p>None inside the range.</p>"
                                : page_table(curve_peaks(), response.peaks)},
        {"Weight: static deflection at the first speed, largest circle in the range",
         page_table(deflection_columns, of_stations(response, speeds))}};
    if (!response.bearings.empty())
        out.push_back({"Weight: forces in the bearings",
                       page_table(carried_columns, of_bearings(response, speeds))});
    return out;
}

std::string gravity_text(const GravityResponse &response, const std::vector<double> &speeds) {
    return fmt::format("Under the weight, {:.6g} m/s2 towards -y: peaks of the motion at twice the "
                       "spin speed\n",
                       response.gravity) +
           (response.peaks.empty() ? "\n  none inside the range\n"
                                   : text_table(curve_peaks(), response.peaks)) +
           "\n" + text_table(deflection_columns, of_stations(response, speeds)) +
           text_table("\n", carried_columns, of_bearings(response, speeds));
}

} // namespace whirl::report

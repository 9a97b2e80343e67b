#include "report/response/parts.h"

#include "report/common/units.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/response/tables.h"
#include "report/sections.h"

#include <fmt/format.h>

namespace whirl::report {

using results::GravityBearing;
using results::GravityResponse;
using results::GravityStation;

namespace {

const Kind<GravityStation> station_kind{
    "station",
    {series("static", Quantity::deflection, &GravityStation::sag),
     series("static_x", Quantity::deflection, &GravityStation::sag_x),
     series("static_y", Quantity::deflection, &GravityStation::sag_y),
     series("twice", Quantity::amplitude, &GravityStation::twice),
     series("phase", Quantity::angle, &GravityStation::phase),
     series("error", Quantity::number, &GravityStation::error),
     series("static_error", Quantity::number, &GravityStation::sag_error)}};

const Kind<GravityBearing> gravity_bearing_kind{
    "bearing",
    {series("static", Quantity::force, &GravityBearing::carried, "static force"),
     series("twice", Quantity::force, &GravityBearing::twice, "twice force"),
     series("error", Quantity::number, &GravityBearing::error),
     series("static_error", Quantity::number, &GravityBearing::carried_error)}};

const std::vector<CsvHeading> gravity_headings{{"speed", Quantity::speed},
                                               {"kind"},
                                               {"name"},
                                               {"z", Quantity::length},
                                               {"static", Quantity::deflection},
                                               {"static_x", Quantity::deflection},
                                               {"static_y", Quantity::deflection},
                                               {"twice", Quantity::amplitude},
                                               {"phase", Quantity::angle},
                                               {"static force", Quantity::force},
                                               {"twice force", Quantity::force},
                                               {"error"},
                                               {"static_error"}};

Json curves_json(const GravityResponse &response, const Units &units) {
    const results::ResponseCurves &curves = response.curves;
    const std::size_t stations = response.stations.size();
    return {{"speeds", written(units, Quantity::speed, curves.speeds)},
            {"stations", curves_of_kind(curves, 0, stations, "twice", Quantity::amplitude, units)},
            {"bearings", curves_of_kind(curves, stations, stations + response.bearings.size(),
                                        "twice", Quantity::force, units)}};
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

/// @param still, circle  what stands still and what vibrates
Columns<Summary> summary_columns(const char *on_page, const char *on_terminal, Quantity still,
                                 Quantity circle) {
    return {{OnPage(on_page), InText(on_terminal), place_of},
            {OnPage("static"), InText("static", "{:.6g}", "no limit"), still, &Summary::still},
            {ForReaders("largest at twice the spin speed", "{:.6g}", "no limit"), circle,
             &Summary::value},
            {ForReaders("at"), Quantity::speed, &Summary::speed},
            {RelativeError(), &Summary::error}};
}
const Columns<Summary> deflection_columns =
    summary_columns("Place", "station", Quantity::deflection, Quantity::amplitude);
const Columns<Summary> carried_columns =
    summary_columns("Bearing", "bearing", Quantity::force, Quantity::force);

std::vector<Summary> of_stations(const GravityResponse &response,
                                 const std::vector<double> &speeds) {
    return summaries(response, speeds, response.stations, &GravityStation::sag, "station");
}
std::vector<Summary> of_bearings(const GravityResponse &response,
                                 const std::vector<double> &speeds) {
    return summaries(response, speeds, response.bearings, &GravityBearing::carried, "bearing");
}

Json gravity_json(const GravityResponse &response, const std::vector<double> &speeds,
                  const Units &units) {
    return {{"gravity", written(units, Quantity::acceleration, response.gravity)},
            {"stations", station_kind.json(speeds, response.stations, units)},
            {"bearings", gravity_bearing_kind.json(speeds, response.bearings, units)},
            {"resonances", resonances_json(response.resonances, units)},
            {"peaks", json_rows(curve_peaks(), response.peaks, units)},
            {"curves", curves_json(response, units)}};
}

std::string gravity_csv(const GravityResponse &response, const std::vector<double> &speeds,
                        const Units &units) {
    std::string csv = csv_head_line(gravity_headings, units);
    for (std::size_t i = 0; i < speeds.size(); ++i)
        csv += station_kind.csv(gravity_headings, speeds[i], i, response.stations, units) +
               gravity_bearing_kind.csv(gravity_headings, speeds[i], i, response.bearings, units);
    return csv;
}

std::vector<Section> gravity_sections(const GravityResponse &response,
                                      const std::vector<double> &speeds, const Units &units) {
    std::vector<Section> out{
        {"Weight: peaks of the motion at twice the spin speed",
         peaks_page(response.resonances, response.peaks, units)},
        {"Weight: static deflection at the first speed, largest circle in the range",
         page_table(deflection_columns, of_stations(response, speeds), units)}};
    add_table(out, "Weight: forces in the bearings", carried_columns, of_bearings(response, speeds),
              units);
    return out;
}

std::string gravity_text(const GravityResponse &response, const std::vector<double> &speeds,
                         const Units &units) {
    return fmt::format("Under the weight, {} towards -y: peaks of the motion at twice the spin "
                       "speed\n",
                       units.text(Quantity::acceleration, response.gravity)) +
           (response.peaks.empty() ? "\n  none inside the range\n"
                                   : peaks_text(response.resonances, response.peaks, units)) +
           "\n" + text_table(deflection_columns, of_stations(response, speeds), units) +
           text_table("\n", carried_columns, of_bearings(response, speeds), units);
}

} // namespace

Part weight_part(const model::Case &scene, const results::ResponseResult &result) {
    const GravityResponse &of = *result.gravity;
    const std::vector<double> &speeds = result.speeds;
    return {.file = "response_gravity",
            .title = "Response to the weight",
            .picture = "motion under the weight",
            .chart = [&](const Units &units) { return gravity_chart(scene, result, units); },
            .csv = [&](const Units &units) { return gravity_csv(of, speeds, units); },
            .sections = [&](const Units &units) { return gravity_sections(of, speeds, units); },
            .text = [&](const Units &units) { return gravity_text(of, speeds, units); },
            .key = "gravity",
            .json = [&](const Units &units) { return gravity_json(of, speeds, units); }};
}

} // namespace whirl::report

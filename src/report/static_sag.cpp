#include "report/static_sag.h"

#include "report/common/table.h"
#include "report/common/units.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

using results::SagBearing;
using results::SagStation;
using results::StaticSag;

namespace {

const Columns<SagStation> sag_columns{
    {"z", OnPage("z (m)"), InText("z m"), &SagStation::z},
    {"name", OnPage("Station"), InText("station"), &SagStation::name},
    {"x", &SagStation::x},
    {"y", &SagStation::y},
    {OnPage("Static deflection x (µm)", "{:.5g}"), InText("static x µm", "{:.4g}"),
     in(still_micrometres, &SagStation::x)},
    {OnPage("Static deflection y (µm)", "{:.5g}"), InText("static y µm", "{:.4g}"),
     in(still_micrometres, &SagStation::y)},
    {"slope_x", OnPage("Slope x (rad)", "{:.5g}"), &SagStation::slope_x},
    {"slope_y", OnPage("Slope y (rad)", "{:.5g}"), InText("slope y rad", "{:.4g}"),
     &SagStation::slope_y},
    {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &SagStation::error},
    {"slope_error", &SagStation::slope_error}};

const Columns<SagBearing> bearing_columns{
    {"z", OnPage("z (m)"), InText("z m"), &SagBearing::z},
    {"name", OnPage("Bearing"), InText("bearing"), &SagBearing::name},
    {"load", OnPage("Load downwards (N)", "{:.7g}"), InText("load downwards N", "{:.6g}"),
     &SagBearing::load},
    {"side", OnPage("Load along x (N)", "{:.5g}"), &SagBearing::side},
    {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &SagBearing::error}};

} // namespace

std::string sag_heading(const StaticSag &sag) {
    return fmt::format("At rest under its weight ({:.6g} m/s²)", sag.gravity);
}

Json sag_json(const StaticSag &sag) {
    return {{"gravity", sag.gravity},
            {"stations", json_rows(sag_columns, sag.stations)},
            {"bearings", json_rows(bearing_columns, sag.bearings)}};
}

std::string sag_page(const StaticSag &sag) {
    return page_table(bearing_columns, sag.bearings) + page_table(sag_columns, sag.stations);
}

std::string sag_text(const StaticSag &sag) {
    return sag_heading(sag) + "\n" + text_table(bearing_columns, sag.bearings) + "\n" +
           text_table(sag_columns, sag.stations) + "\n";
}

} // namespace whirl::report

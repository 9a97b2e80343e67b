#include "report/simulate_stations.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"

#include <fmt/format.h>

namespace whirl::report {

using results::StationMotion;
using results::Waterfall;

namespace {

std::optional<double> over_steady(const StationMotion &station) {
    if (!station.steady_peak || *station.steady_peak == 0)
        return std::nullopt;
    return station.peak.value / *station.steady_peak;
}

const Columns<StationMotion> station_columns{
    {OnPage("Station"), InText("station"),
     [](const auto &s) { return s.name.empty() ? place("", s.z) : s.name; }},
    {"name", &StationMotion::name},
    {"z", OnPage("z (m)", "{:.5g}"), &StationMotion::z},
    {"peak", [](const auto &s) { return s.peak.value; }},
    {OnPage("Peak (µm)", "{:.5g}"), InText("peak µm", "{:.5g}"),
     [](const auto &s) { return s.peak.value * micrometres; }},
    {"peak_time", OnPage("at (s)", "{:.6g}"), InText("at s", "{:.6g}"),
     [](const auto &s) { return s.peak.time; }},
    {"peak_speed", [](const auto &s) { return s.peak.speed; }},
    {OnPage("at (rpm)", "{:.6g}"), InText("at rpm", "{:.6g}"),
     [](const auto &s) { return s.peak.speed * rpm; }},
    {"at_end", [](const auto &s) { return s.peak.at_end; }},
    {"amplitude", &StationMotion::amplitude},
    {OnPage("At the end (µm)", "{:.5g}"), InText("at the end µm", "{:.4g}"),
     in(micrometres, &StationMotion::amplitude)},
    {"steady", &StationMotion::steady},
    {OnPage("Steady at that speed (µm)", "{:.5g}"), InText("steady µm", "{:.4g}"),
     in(micrometres, &StationMotion::steady)},
    {"steady_peak", &StationMotion::steady_peak},
    {OnPage("Steady peak (µm)", "{:.5g}"), InText("steady peak µm", "{:.5g}"),
     in(micrometres, &StationMotion::steady_peak)},
    {"steady_peak_speed", &StationMotion::steady_peak_speed},
    {OnPage("at (rpm)", "{:.6g}"), InText("at rpm", "{:.6g}"),
     in(rpm, &StationMotion::steady_peak_speed)},
    {"over_steady_peak", OnPage("Peak over steady peak", "{:.4g}"), InText("ratio", "{:.4g}"),
     over_steady}};

} // namespace

Json stations_json(const results::SimulateResult &result) {
    return json_rows(station_columns, result.stations);
}

Json waterfall_json(const results::SimulateResult &result) {
    if (!result.waterfall)
        return nullptr;
    const Waterfall &w = *result.waterfall;
    return {{"z", w.z},
            {"name", w.name},
            {"window", w.window},
            {"times", w.times},
            {"speeds", w.speeds},
            {"frequencies", w.frequencies},
            {"amplitude", w.amplitude}};
}

std::string stations_page(const results::SimulateResult &result) {
    return page_table(station_columns, result.stations);
}

std::string stations_text(const results::SimulateResult &result) {
    return text_table(station_columns, result.stations);
}

std::string waterfall_csv(const Waterfall &waterfall) {
    const std::size_t width = waterfall.frequencies.size();
    const auto column = [width](const std::string &name, const auto &value) {
        return Column<std::size_t>(InCsv(name), [=](const std::size_t &, std::size_t i) {
            return value(i / width, i % width);
        });
    };
    const Columns<std::size_t> all{
        column("time [s]", [&](std::size_t k, std::size_t) { return waterfall.times[k]; }),
        column("speed [rad/s]", [&](std::size_t k, std::size_t) { return waterfall.speeds[k]; }),
        column("frequency [rad/s]",
               [&](std::size_t, std::size_t i) { return waterfall.frequencies[i]; }),
        column("amplitude [m]",
               [&](std::size_t k, std::size_t i) { return waterfall.amplitude[k][i]; })};
    return csv_table(all, std::vector<std::size_t>(waterfall.times.size() * width));
}

} // namespace whirl::report

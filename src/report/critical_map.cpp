#include "report/critical_map.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

namespace whirl::report {

using results::CriticalMap;
using results::CriticalMapBearing;
using results::CriticalMapCrossing;
using results::CriticalMapCurve;

namespace {

/// A crossing with the words for its bearing.
struct Crossing : CriticalMapCrossing {
    std::vector<std::size_t> across;
    std::string bearings;
};

std::vector<Crossing> crossings_of(const model::Case &scene, const CriticalMap &map) {
    std::vector<Crossing> rows;
    for (const CriticalMapCrossing &found : map.crossings)
        rows.push_back({found, map.bearings[found.bearing].bearings,
                        bearings_text(scene, map.bearings[found.bearing].bearings)});
    return rows;
}

const Columns<Crossing> map_crossing_columns{
    {OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
    {"bearings", &Crossing::across},
    {InCsv("bearings"), OnPage("Bearing"), InText("bearing"), &Crossing::bearings},
    {"of", InCsv("of"), OnPage("Coefficient"), InText("of"), &Crossing::of},
    {"stiffness", InCsv("stiffness [N/m]"), OnPage("Stiffness (N/m)", "{:.10g}"),
     InText("N/m", precise), &Crossing::stiffness},
    {OnPage("rpm", "{:.10g}"), InText("rpm"), in(rpm, &Crossing::speed)},
    {"speed", InCsv("speed [rad/s]"), OnPage("rad/s", "{:.10g}"), InText("rad/s", precise),
     &Crossing::speed},
    {"whirl", InCsv("whirl"), OnPage("Whirl"), InText("whirl"), &Crossing::whirl},
    {"number", InCsv("number"), OnPage("Curve"), InText("curve"), &Crossing::number},
    {"error", InCsv("error"), OnPage("Relative error", "{:.2g}"), InText("error", rough),
     &Crossing::error}};

/// A curve as a list, and at its ends.
const Columns<CriticalMapCurve> map_curve_columns{
    {"whirl", OnPage("Whirl"), InText("whirl"), &CriticalMapCurve::whirl},
    {"number", OnPage("Curve"), InText("curve"), &CriticalMapCurve::number},
    {OnPage("Soft end (rpm)", "{:.10g}"), InText("soft end (rpm)"),
     [](const auto &of) { return of.speed.front() * rpm; }},
    {OnPage("Soft end (rad/s)", "{:.10g}"), InText("soft end (rad/s)", precise),
     [](const auto &of) { return of.speed.front(); }},
    {OnPage("Stiff end (rpm)", "{:.10g}"), InText("stiff end (rpm)"),
     [](const auto &of) { return of.speed.back() * rpm; }},
    {OnPage("Stiff end (rad/s)", "{:.10g}"), InText("stiff end (rad/s)", precise),
     [](const auto &of) { return of.speed.back(); }},
    {"speed", &CriticalMapCurve::speed},
    {"error", &CriticalMapCurve::error},
    {"soft_shape", &CriticalMapCurve::soft},
    {"stiff_shape", &CriticalMapCurve::stiff}};

/// A line of the file: a point of a curve, of a bearing, or a deflection.
struct MapLine {
    std::string kind;
    std::string bearings{}, of{};
    std::optional<double> stiffness, speed;
    std::optional<results::Whirl> whirl{};
    std::optional<int> number{};
    std::optional<double> error{}, z{}, deflection{};
};

const Columns<MapLine> map_line_columns{{InCsv("kind"), &MapLine::kind},
                                        {InCsv("bearings"), &MapLine::bearings},
                                        {InCsv("of"), &MapLine::of},
                                        {InCsv("stiffness [N/m]"), &MapLine::stiffness},
                                        {InCsv("speed [rad/s]"), &MapLine::speed},
                                        {InCsv("whirl"), &MapLine::whirl},
                                        {InCsv("number"), &MapLine::number},
                                        {InCsv("error"), &MapLine::error},
                                        {InCsv("z [m]"), &MapLine::z},
                                        {InCsv("deflection"), &MapLine::deflection}};

std::string csv_of(const model::Case &scene, const CriticalMap &map, const Units &) {
    std::vector<MapLine> lines;
    for (const CriticalMapCurve &curve : map.curves)
        for (std::size_t i = 0; i < map.stiffness.size(); ++i)
            if (!std::isnan(curve.speed[i]))
                lines.push_back({"curve", "", "", map.stiffness[i], curve.speed[i], curve.whirl,
                                 curve.number, curve.error[i]});
    for (const CriticalMapBearing &across : map.bearings) {
        const std::string bearings = bearings_text(scene, across.bearings);
        for (const bool x : {true, false})
            for (std::size_t i = 0; i < across.speeds.size() && (x || !across.isotropic); ++i)
                lines.push_back({"bearing", bearings, coefficient_name(across, x),
                                 (x ? across.kxx : across.kyy)[i], across.speeds[i]});
    }
    for (const Crossing &at : crossings_of(scene, map))
        lines.push_back({"crossing", at.bearings, at.of, at.stiffness, at.speed, at.whirl,
                         at.number, at.error});
    for (const CriticalMapCurve &curve : map.curves)
        for (const auto &[shape, stiffness, speed] :
             {std::tuple(&curve.soft, map.stiffness.front(), curve.speed.front()),
              std::tuple(&curve.stiff, map.stiffness.back(), curve.speed.back())})
            for (std::size_t i = 0; i < shape->size() && i < map.z.size(); ++i)
                lines.push_back({"shape", "", "", stiffness, speed, curve.whirl, curve.number,
                                 std::nullopt, map.z[i], (*shape)[i]});
    return csv_table(map_line_columns, lines);
}

std::string varied_text(const model::Case &scene, const CriticalMap &map) {
    return map.bearing ? "stiffness of " + bearings_text(scene, {*map.bearing})
                       : std::string("stiffness of all bearings together");
}

std::string range_of_map(const CriticalMap &map) {
    return fmt::format("{:.6g} to {:.6g} N/m, {} points", map.stiffness.front(),
                       map.stiffness.back(), map.stiffness.size());
}

} // namespace

std::string bearings_text(const model::Case &scene, const std::vector<std::size_t> &bearings) {
    return joined(bearings, ", ", [&](std::size_t i) {
        const model::Bearing &bearing = scene.rotor.bearings[i];
        return bearing.name.empty() ? fmt::format("bearing at {:.6g} {}", bearing.z * metres,
                                                  unit_name("length", "m"))
                                    : bearing.name;
    });
}

std::string coefficient_name(const CriticalMapBearing &across, bool x) {
    return across.isotropic ? "k" : x ? "kxx" : "kyy";
}

std::string curve_name(results::Whirl whirl, int number) {
    return fmt::format("{}{}", number, whirl == results::Whirl::forward ? "F" : "B");
}

Json critical_map_json(const model::Case &scene, const CriticalMap &map) {
    Json bearings = Json::array();
    for (const CriticalMapBearing &across : map.bearings)
        bearings.push_back({{"bearings", across.bearings},
                            {"speeds", across.speeds},
                            {"kxx", across.kxx},
                            {"kyy", across.kyy}});
    return {{"bearing", map.bearing},
            {"stiffness", map.stiffness},
            {"curves", json_rows(map_curve_columns, map.curves)},
            {"z", map.z},
            {"bearings", bearings},
            {"crossings", json_rows(map_crossing_columns, crossings_of(scene, map))}};
}

std::vector<Section> critical_map_sections(const model::Case &scene, const CriticalMap &map) {
    return {{"Critical speed map: crossings with the stiffness of the bearings",
             page_table(map_crossing_columns, crossings_of(scene, map))},
            {fmt::format("Critical speed map: ends, {}, {}", varied_text(scene, map),
                         range_of_map(map)),
             page_table(map_curve_columns, map.curves)}};
}

std::string critical_map_text(const model::Case &scene, const CriticalMap &map) {
    const auto crossings = crossings_of(scene, map);
    return fmt::format("\nCritical speed map: {}, {}:\n", varied_text(scene, map),
                       range_of_map(map)) +
           text_table(map_curve_columns, map.curves) +
           "\nCrossings with the stiffness of the bearings:\n" +
           (crossings.empty() ? "  none on the map\n"
                              : text_table(map_crossing_columns, crossings));
}

Picture critical_map_picture(const model::Case &scene, const CriticalMap &map, const Units &units) {
    return {"critical_map", critical_map_figure(scene, map, units),
            [&scene, &map](const Units &files) { return csv_of(scene, map, files); }};
}

} // namespace whirl::report

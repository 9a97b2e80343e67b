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

std::vector<Crossing> crossings_of(const model::Case &scene, const CriticalMap &map,
                                   const Units &units) {
    std::vector<Crossing> rows;
    for (const CriticalMapCrossing &found : map.crossings)
        rows.push_back({found, map.bearings[found.bearing].bearings,
                        bearings_text(scene, map.bearings[found.bearing].bearings, units)});
    return rows;
}

const Columns<Crossing> map_crossing_columns{
    {OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
    {"bearings", &Crossing::across},
    {InCsv("bearings"), Titled("Bearing"), &Crossing::bearings},
    {InFiles("of"), OnPage("Coefficient"), InText("of"), &Crossing::of},
    {InFiles("stiffness"), OnPage("Stiffness", "{:.10g}"), InText("", precise), Quantity::stiffness,
     &Crossing::stiffness},
    {InFiles("speed"), AllDigits(""), Quantity::speed, &Crossing::speed},
    {InFiles("whirl"), Titled("Whirl"), &Crossing::whirl},
    {InFiles("number"), Titled("Curve"), &Crossing::number},
    {InFiles("error"), RelativeError(), &Crossing::error}};

/// A curve as a list, and at its ends.
const Columns<CriticalMapCurve> map_curve_columns{
    {"whirl", Titled("Whirl"), &CriticalMapCurve::whirl},
    {"number", Titled("Curve"), &CriticalMapCurve::number},
    {AllDigits("Soft end"), Quantity::speed, [](const auto &of) { return of.speed.front(); }},
    {AllDigits("Stiff end"), Quantity::speed, [](const auto &of) { return of.speed.back(); }},
    {"speed", Quantity::speed, &CriticalMapCurve::speed},
    {"error", Quantity::number, &CriticalMapCurve::error},
    {"soft_shape", Quantity::number, &CriticalMapCurve::soft},
    {"stiff_shape", Quantity::number, &CriticalMapCurve::stiff}};

/// A line of the file: a point of a curve, of a bearing, or a deflection.
struct MapLine {
    std::string kind;
    std::string bearings{}, of{};
    std::optional<double> stiffness, speed;
    std::optional<results::Whirl> whirl{};
    std::optional<int> number{};
    std::optional<double> error{}, z{}, deflection{};
};

const Columns<MapLine> map_line_columns{
    {InCsv("kind"), &MapLine::kind},
    {InCsv("bearings"), &MapLine::bearings},
    {InCsv("of"), &MapLine::of},
    {InCsv("stiffness"), Quantity::stiffness, &MapLine::stiffness},
    {InCsv("speed"), Quantity::speed, &MapLine::speed},
    {InCsv("whirl"), &MapLine::whirl},
    {InCsv("number"), &MapLine::number},
    {InCsv("error"), Quantity::number, &MapLine::error},
    {InCsv("z"), Quantity::length, &MapLine::z},
    {InCsv("deflection"), Quantity::number, &MapLine::deflection}};

std::string csv_of(const model::Case &scene, const CriticalMap &map, const Units &units) {
    std::vector<MapLine> lines;
    for (const CriticalMapCurve &curve : map.curves)
        for (std::size_t i = 0; i < map.stiffness.size(); ++i)
            if (!std::isnan(curve.speed[i]))
                lines.push_back({"curve", "", "", map.stiffness[i], curve.speed[i], curve.whirl,
                                 curve.number, curve.error[i]});
    for (const CriticalMapBearing &across : map.bearings) {
        const std::string bearings = bearings_text(scene, across.bearings, units);
        for (const bool x : {true, false})
            for (std::size_t i = 0; i < across.speeds.size() && (x || !across.isotropic); ++i)
                lines.push_back({"bearing", bearings, coefficient_name(across, x),
                                 (x ? across.kxx : across.kyy)[i], across.speeds[i]});
    }
    for (const Crossing &at : crossings_of(scene, map, units))
        lines.push_back({"crossing", at.bearings, at.of, at.stiffness, at.speed, at.whirl,
                         at.number, at.error});
    for (const CriticalMapCurve &curve : map.curves)
        for (const auto &[shape, stiffness, speed] :
             {std::tuple(&curve.soft, map.stiffness.front(), curve.speed.front()),
              std::tuple(&curve.stiff, map.stiffness.back(), curve.speed.back())})
            for (std::size_t i = 0; i < shape->size() && i < map.z.size(); ++i)
                lines.push_back({"shape", "", "", stiffness, speed, curve.whirl, curve.number,
                                 std::nullopt, map.z[i], (*shape)[i]});
    return csv_table(map_line_columns, lines, units);
}

std::string varied_text(const model::Case &scene, const CriticalMap &map, const Units &units) {
    return map.bearing ? "stiffness of " + bearings_text(scene, {*map.bearing}, units)
                       : std::string("stiffness of all bearings together");
}

std::string range_of_map(const CriticalMap &map, const Units &units) {
    return units.text(model::Sentence(
        "{}, {} points", model::as::stiffness.range(map.stiffness.front(), map.stiffness.back()),
        map.stiffness.size()));
}

} // namespace

std::string bearings_text(const model::Case &scene, const std::vector<std::size_t> &bearings,
                          const Units &units) {
    return joined(bearings, ", ", [&](std::size_t i) {
        const model::Bearing &bearing = scene.rotor.bearings[i];
        return bearing.name.empty() ? "bearing at " + units.text(Quantity::length, bearing.z)
                                    : bearing.name;
    });
}

std::string coefficient_name(const CriticalMapBearing &across, bool x) {
    return across.isotropic ? "k" : x ? "kxx" : "kyy";
}

std::string curve_name(results::Whirl whirl, int number) {
    return fmt::format("{}{}", number, whirl == results::Whirl::forward ? "F" : "B");
}

Json critical_map_json(const model::Case &scene, const CriticalMap &map, const Units &units) {
    Json bearings = Json::array();
    for (const CriticalMapBearing &across : map.bearings)
        bearings.push_back({{"bearings", across.bearings},
                            {"speeds", written(units, Quantity::speed, across.speeds)},
                            {"kxx", written(units, Quantity::stiffness, across.kxx)},
                            {"kyy", written(units, Quantity::stiffness, across.kyy)}});
    return {{"bearing", map.bearing},
            {"stiffness", written(units, Quantity::stiffness, map.stiffness)},
            {"curves", json_rows(map_curve_columns, map.curves, units)},
            {"z", written(units, Quantity::length, map.z)},
            {"bearings", bearings},
            {"crossings", json_rows(map_crossing_columns, crossings_of(scene, map, units), units)}};
}

std::vector<Section> critical_map_sections(const model::Case &scene, const CriticalMap &map,
                                           const Units &units) {
    return {{"Critical speed map: crossings with the stiffness of the bearings",
             page_table(map_crossing_columns, crossings_of(scene, map, units), units)},
            {fmt::format("Critical speed map: ends, {}, {}", varied_text(scene, map, units),
                         range_of_map(map, units)),
             page_table(map_curve_columns, map.curves, units)}};
}

std::string critical_map_text(const model::Case &scene, const CriticalMap &map,
                              const Units &units) {
    const auto crossings = crossings_of(scene, map, units);
    return fmt::format("\nCritical speed map: {}, {}:\n", varied_text(scene, map, units),
                       range_of_map(map, units)) +
           text_table(map_curve_columns, map.curves, units) +
           "\nCrossings with the stiffness of the bearings:\n" +
           (crossings.empty() ? "  none on the map\n"
                              : text_table(map_crossing_columns, crossings, units));
}

Picture critical_map_picture(const model::Case &scene, const CriticalMap &map, const Units &units) {
    return {"critical_map", critical_map_chart(scene, map, units),
            [&scene, &map](const Units &files) { return csv_of(scene, map, files); }};
}

} // namespace whirl::report

#include "report/response/parts.h"

#include "report/common/csv.h"
#include "report/common/words.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

using results::ClearanceUse;
using results::DeflectedShape;
using results::Orbit;
using results::Orbits;
using results::ResponseResult;

namespace {

/// An orbit with its speed.
struct OrbitRow : Orbit {
    double speed; ///< rad/s
};

/// Narrower than this share of its length an orbit is a line.
constexpr double narrowest = 1e-6;

std::string sense(const OrbitRow &row) {
    const double minor = row.minor * (row.speed < 0 ? -1 : 1);
    if (std::abs(minor) <= narrowest * row.major)
        return "line";
    return minor > 0 ? "forward" : "backward";
}

const Columns<OrbitRow> orbit_columns{
    {InCsv("speed"), ForReaders(""), Quantity::speed, &OrbitRow::speed},
    {InFiles("of"), OnPage("Orbit in"), InText("of"), &OrbitRow::of},
    {InFiles("z"), OnPage("z", "{:.5g}"), Quantity::length, &OrbitRow::z},
    {InFiles("name"), OnPage("Place"), &OrbitRow::name},
    {InText("orbit at"), place_of},
    {InFiles("x"), Quantity::amplitude, &OrbitRow::x},
    {InFiles("x_phase"), Quantity::angle, &OrbitRow::x_phase},
    {InFiles("y"), Quantity::amplitude, &OrbitRow::y},
    {InFiles("y_phase"), Quantity::angle, &OrbitRow::y_phase},
    {InFiles("major"), Titled("Amplitude"), Quantity::amplitude, &OrbitRow::major},
    {InFiles("minor"), Quantity::amplitude, &OrbitRow::minor},
    {OnPage("Smaller amplitude"), Quantity::amplitude,
     [](const OrbitRow &row) { return std::abs(row.minor); }},
    {Titled("Sense"), sense},
    {InFiles("clearance"), OnPage("Radial clearance"), Quantity::deflection, &OrbitRow::clearance},
    {InFiles("share"), Quantity::number, &OrbitRow::share},
    {OnPage("Share of it (%)", "{:.4g}"), InText("% of clearance", "{:.4g}"), Quantity::number,
     in(100, &OrbitRow::share)},
    {InFiles("error"), RelativeError(), &OrbitRow::error}};

const Columns<ClearanceUse> use_columns{
    {"of", OnPage("Largest orbit in"), InText("of"), &ClearanceUse::of},
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &ClearanceUse::z},
    {"name", OnPage("Place"), &ClearanceUse::name},
    {InText("clearance at"), place_of},
    {"clearance", Titled("Radial clearance"), Quantity::deflection, &ClearanceUse::clearance},
    {"share", Quantity::number, &ClearanceUse::share},
    {OnPage("Share of it (%)", "{:.4g}", "no limit"),
     InText("largest orbit %", "{:.4g}", "no limit"), Quantity::number,
     in(100, &ClearanceUse::share)},
    {"speed", ForReaders("at", "{:.8g}"), Quantity::speed, &ClearanceUse::speed},
    {"error", RelativeError(), &ClearanceUse::error}};

const Columns<DeflectedShape> shape_columns{
    {"speed", OnPage(""), InText("shape at"), Quantity::speed, &DeflectedShape::speed},
    {"largest", Titled("Largest amplitude"), Quantity::amplitude, &DeflectedShape::largest},
    {"largest_z", ForReaders("at z", "{:.5g}"), Quantity::length, &DeflectedShape::largest_z},
    {"instant", OnPage("Rotor angle then", "{:.1f}"), InText("rotor angle", "{:.1f}"),
     Quantity::angle, &DeflectedShape::instant},
    {"z", Quantity::length, &DeflectedShape::z},
    {"x", Quantity::deflection, &DeflectedShape::x},
    {"y", Quantity::deflection, &DeflectedShape::y},
    {"envelope", Quantity::amplitude, &DeflectedShape::envelope}};

std::vector<OrbitRow> rows_of(const std::vector<Orbits> &all, bool in_supports) {
    std::vector<OrbitRow> rows;
    for (const Orbits &orbits : all)
        for (const Orbit &orbit : orbits.stations)
            if (!in_supports || orbit.of != "station")
                rows.push_back({orbit, orbits.speed});
    return rows;
}

/// A point of a deflected shape.
struct ShapePoint {
    double speed, z, x, y, major;
};
const Columns<ShapePoint> point_columns{{InCsv("speed"), Quantity::speed, &ShapePoint::speed},
                                        {InCsv("z"), Quantity::length, &ShapePoint::z},
                                        {InCsv("x_instant"), Quantity::deflection, &ShapePoint::x},
                                        {InCsv("y_instant"), Quantity::deflection, &ShapePoint::y},
                                        {InCsv("major"), Quantity::amplitude, &ShapePoint::major}};

std::string shapes_csv(const std::vector<DeflectedShape> &shapes, const Units &units) {
    std::vector<ShapePoint> points;
    for (const DeflectedShape &shape : shapes)
        for (std::size_t i = 0; i < shape.z.size(); ++i)
            points.push_back({shape.speed, shape.z[i], shape.x[i], shape.y[i], shape.envelope[i]});
    return csv_table(point_columns, points, units);
}

} // namespace

void add_orbits(Json &json, const ResponseResult &result, const Units &units) {
    json["orbits"] = json_list(result.orbits, [&units](const Orbits &orbits) {
        return Json{{"speed", written(units, Quantity::speed, orbits.speed)},
                    {"stations", json_rows(orbit_columns, rows_of({orbits}, false), units)}};
    });
    json["clearances"] = json_rows(use_columns, result.clearances, units);
    json["shapes"] = json_rows(shape_columns, result.shapes, units);
}

std::vector<Section> orbit_sections(const ResponseResult &result, const Units &units) {
    std::vector<Section> sections;
    add_table(sections, "Largest orbits in the clearances", use_columns, result.clearances, units);
    add_table(sections, "Orbits", orbit_columns, rows_of(result.orbits, false), units);
    add_table(sections, "Deflected shapes", shape_columns, result.shapes, units);
    return sections;
}

std::string orbit_text(const ResponseResult &result, const Units &units) {
    return text_table("\n", use_columns, result.clearances, units) +
           text_table("\n", orbit_columns, rows_of(result.orbits, true), units) +
           text_table("\n", shape_columns, result.shapes, units);
}

std::vector<Picture> orbit_pictures(const model::Case &scene, const ResponseResult &result,
                                    const Units &units) {
    std::vector<Picture> pictures;
    if (!result.orbits.empty())
        pictures.push_back({"response_orbits", orbits_chart(scene, result.orbits, units),
                            [&result](const Units &units) {
                                return csv_table(orbit_columns, rows_of(result.orbits, false),
                                                 units);
                            }});
    if (!result.shapes.empty())
        pictures.push_back(
            {"response_shapes", shapes_chart(scene, result.shapes, units),
             [&result](const Units &units) { return shapes_csv(result.shapes, units); }});
    return pictures;
}

} // namespace whirl::report

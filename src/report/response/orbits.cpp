#include "report/response/orbits.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"

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
    {InCsv("speed [rad/s]"), &OrbitRow::speed},
    {ForReaders("rpm"), in(rpm, &OrbitRow::speed)},
    {"of", InCsv("of"), OnPage("Orbit in"), InText("of"), &OrbitRow::of},
    {"z", InCsv("z [m]"), OnPage("z (m)", "{:.5g}"), &OrbitRow::z},
    {"name", InCsv("name"), OnPage("Place"), &OrbitRow::name},
    {InText("orbit at"), place_of},
    {"x", InCsv("x [m]"), &OrbitRow::x},
    {"x_phase", InCsv("x_phase [rad]"), &OrbitRow::x_phase},
    {"y", InCsv("y [m]"), &OrbitRow::y},
    {"y_phase", InCsv("y_phase [rad]"), &OrbitRow::y_phase},
    {"major", InCsv("major [m]"), &OrbitRow::major},
    {"minor", InCsv("minor [m]"), &OrbitRow::minor},
    {OnPage("Amplitude (µm)"), InText("amplitude µm"), in(micrometres, &OrbitRow::major)},
    {OnPage("Smaller amplitude (µm)"),
     [](const OrbitRow &row) { return std::abs(row.minor) * micrometres; }},
    {OnPage("Sense"), InText("sense"), sense},
    {"clearance", InCsv("clearance [m]"), &OrbitRow::clearance},
    {OnPage("Radial clearance (µm)"), in(still_micrometres, &OrbitRow::clearance)},
    {"share", InCsv("share"), &OrbitRow::share},
    {OnPage("Share of it (%)", "{:.4g}"), InText("% of clearance", "{:.4g}"),
     in(100, &OrbitRow::share)},
    {"error", InCsv("error"), OnPage("Relative error", "{:.2g}"), InText("error", rough),
     &OrbitRow::error}};

const Columns<ClearanceUse> use_columns{
    {"of", OnPage("Largest orbit in"), InText("of"), &ClearanceUse::of},
    {"z", OnPage("z (m)", "{:.5g}"), &ClearanceUse::z},
    {"name", OnPage("Place"), &ClearanceUse::name},
    {InText("clearance at"), place_of},
    {"clearance", &ClearanceUse::clearance},
    {OnPage("Radial clearance (µm)"), InText("radial clearance µm"),
     in(still_micrometres, &ClearanceUse::clearance)},
    {"share", &ClearanceUse::share},
    {OnPage("Share of it (%)", "{:.4g}", "no limit"),
     InText("largest orbit %", "{:.4g}", "no limit"), in(100, &ClearanceUse::share)},
    {"speed", &ClearanceUse::speed},
    {OnPage("at (rpm)", "{:.8g}"), InText("at rpm", "{:.8g}"), in(rpm, &ClearanceUse::speed)},
    {"error", OnPage("Relative error", "{:.2g}"), InText("error", rough), &ClearanceUse::error}};

const Columns<DeflectedShape> shape_columns{
    {"speed", &DeflectedShape::speed},
    {OnPage("rpm"), InText("shape at rpm"), in(rpm, &DeflectedShape::speed)},
    {"instant", &DeflectedShape::instant},
    {"largest", &DeflectedShape::largest},
    {OnPage("Largest amplitude (µm)"), InText("largest amplitude µm"),
     in(micrometres, &DeflectedShape::largest)},
    {"largest_z", OnPage("at z (m)", "{:.5g}"), InText("at z m", "{:.5g}"),
     &DeflectedShape::largest_z},
    {OnPage("Rotor angle then (deg)", "{:.1f}"), InText("rotor angle deg", "{:.1f}"),
     in(degrees, &DeflectedShape::instant)},
    {"z", &DeflectedShape::z},
    {"x", &DeflectedShape::x},
    {"y", &DeflectedShape::y},
    {"envelope", &DeflectedShape::envelope}};

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
const Columns<ShapePoint> point_columns{{InCsv("speed [rad/s]"), &ShapePoint::speed},
                                        {InCsv("z [m]"), &ShapePoint::z},
                                        {InCsv("x_instant [m]"), &ShapePoint::x},
                                        {InCsv("y_instant [m]"), &ShapePoint::y},
                                        {InCsv("major [m]"), &ShapePoint::major}};

std::string shapes_csv(const std::vector<DeflectedShape> &shapes) {
    std::vector<ShapePoint> points;
    for (const DeflectedShape &shape : shapes)
        for (std::size_t i = 0; i < shape.z.size(); ++i)
            points.push_back({shape.speed, shape.z[i], shape.x[i], shape.y[i], shape.envelope[i]});
    return csv_table(point_columns, points);
}

} // namespace

void add_orbits(Json &json, const ResponseResult &result) {
    json["orbits"] = json_list(result.orbits, [](const Orbits &orbits) {
        return Json{{"speed", orbits.speed},
                    {"stations", json_rows(orbit_columns, rows_of({orbits}, false))}};
    });
    json["clearances"] = json_rows(use_columns, result.clearances);
    json["shapes"] = json_rows(shape_columns, result.shapes);
}

std::vector<Section> orbit_sections(const ResponseResult &result) {
    std::vector<Section> sections;
    if (!result.clearances.empty())
        sections.push_back(
            {"Largest orbits in the clearances", page_table(use_columns, result.clearances)});
    if (!result.orbits.empty())
        sections.push_back({"Orbits", page_table(orbit_columns, rows_of(result.orbits, false))});
    if (!result.shapes.empty())
        sections.push_back({"Deflected shapes", page_table(shape_columns, result.shapes)});
    return sections;
}

std::string orbit_text(const ResponseResult &result) {
    return text_table("\n", use_columns, result.clearances) +
           text_table("\n", orbit_columns, rows_of(result.orbits, true)) +
           text_table("\n", shape_columns, result.shapes);
}

std::vector<Picture> orbit_pictures(const model::Case &scene, const ResponseResult &result,
                                    const Units &units) {
    std::vector<Picture> pictures;
    if (!result.orbits.empty())
        pictures.push_back({"response_orbits", orbits_figure(scene, result.orbits, units),
                            [&result](const Units &) {
                                return csv_table(orbit_columns, rows_of(result.orbits, false));
                            }});
    if (!result.shapes.empty())
        pictures.push_back({"response_shapes", shapes_figure(scene, result.shapes, units),
                            [&result](const Units &) { return shapes_csv(result.shapes); }});
    return pictures;
}

} // namespace whirl::report

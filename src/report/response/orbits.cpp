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
struct OrbitRow {
    double speed; ///< rad/s
    const Orbit &orbit;
};

auto of_orbit(double Orbit::*member) {
    return [member](const OrbitRow &row) { return row.orbit.*member; };
}

std::optional<double> percent(const std::optional<double> &share) {
    return share ? std::optional(*share * 100) : std::nullopt;
}

/// Narrower than this share of its length an orbit is a line.
constexpr double narrowest = 1e-6;

std::string sense(const OrbitRow &row) {
    const double minor = row.orbit.minor * (row.speed < 0 ? -1 : 1);
    if (std::abs(minor) <= narrowest * row.orbit.major)
        return "line";
    return minor > 0 ? "forward" : "backward";
}

const Columns<OrbitRow> orbit_columns{
    {"", "speed [rad/s]", {}, {}, &OrbitRow::speed},
    {"", "", {"rpm"}, {"rpm"}, [](const OrbitRow &row) { return row.speed * rpm; }},
    {"of", "of", {"Orbit in"}, {"of"}, [](const OrbitRow &row) { return row.orbit.of; }},
    {"z", "z [m]", {"z (m)", "{:.5g}"}, {}, of_orbit(&Orbit::z)},
    {"name", "name", {"Place"}, {}, [](const OrbitRow &row) { return row.orbit.name; }},
    {"",
     "",
     {},
     {"orbit at"},
     [](const OrbitRow &row) { return place(row.orbit.name, row.orbit.z); }},
    {"x", "x [m]", {}, {}, of_orbit(&Orbit::x)},
    {"x_phase", "x_phase [rad]", {}, {}, of_orbit(&Orbit::x_phase)},
    {"y", "y [m]", {}, {}, of_orbit(&Orbit::y)},
    {"y_phase", "y_phase [rad]", {}, {}, of_orbit(&Orbit::y_phase)},
    {"major", "major [m]", {}, {}, of_orbit(&Orbit::major)},
    {"minor", "minor [m]", {}, {}, of_orbit(&Orbit::minor)},
    {"",
     "",
     {"Amplitude (µm)"},
     {"amplitude µm"},
     [](const OrbitRow &row) { return row.orbit.major * micrometres; }},
    {"",
     "",
     {"Smaller amplitude (µm)"},
     {},
     [](const OrbitRow &row) { return std::abs(row.orbit.minor) * micrometres; }},
    {"", "", {"Sense"}, {"sense"}, sense},
    {"clearance", "clearance [m]", {}, {}, [](const OrbitRow &row) { return row.orbit.clearance; }},
    {"",
     "",
     {"Radial clearance (µm)"},
     {},
     [](const OrbitRow &row) {
         return row.orbit.clearance ? std::optional(*row.orbit.clearance * still_micrometres)
                                    : std::nullopt;
     }},
    {"share", "share", {}, {}, [](const OrbitRow &row) { return row.orbit.share(); }},
    {"",
     "",
     {"Share of it (%)", "{:.4g}"},
     {"% of clearance", "{:.4g}"},
     [](const OrbitRow &row) { return percent(row.orbit.share()); }},
    {"error", "error", {"Relative error", "{:.2g}"}, {"error", rough}, of_orbit(&Orbit::error)}};

const Columns<ClearanceUse> use_columns{
    {"of", "", {"Largest orbit in"}, {"of"}, &ClearanceUse::of},
    {"z", "", {"z (m)", "{:.5g}"}, {}, &ClearanceUse::z},
    {"name", "", {"Place"}, {}, &ClearanceUse::name},
    {"", "", {}, {"clearance at"}, [](const ClearanceUse &use) { return place(use.name, use.z); }},
    {"clearance", "", {}, {}, &ClearanceUse::clearance},
    {"",
     "",
     {"Radial clearance (µm)"},
     {"radial clearance µm"},
     [](const ClearanceUse &use) { return use.clearance * still_micrometres; }},
    {"share", "", {}, {}, &ClearanceUse::share},
    {"",
     "",
     {"Share of it (%)", "{:.4g}", "no limit"},
     {"largest orbit %", "{:.4g}", "no limit"},
     [](const ClearanceUse &use) { return use.share * 100; }},
    {"speed", "", {}, {}, &ClearanceUse::speed},
    {"",
     "",
     {"at (rpm)", "{:.8g}"},
     {"at rpm", "{:.8g}"},
     [](const ClearanceUse &use) { return use.speed * rpm; }},
    {"error", "", {"Relative error", "{:.2g}"}, {"error", rough}, &ClearanceUse::error}};

const Columns<DeflectedShape> shape_columns{
    {"speed", "", {}, {}, &DeflectedShape::speed},
    {"", "", {"rpm"}, {"shape at rpm"}, [](const auto &shape) { return shape.speed * rpm; }},
    {"instant", "", {}, {}, &DeflectedShape::instant},
    {"largest", "", {}, {}, &DeflectedShape::largest},
    {"",
     "",
     {"Largest amplitude (µm)"},
     {"largest amplitude µm"},
     [](const auto &shape) { return shape.largest * micrometres; }},
    {"largest_z", "", {"at z (m)", "{:.5g}"}, {"at z m", "{:.5g}"}, &DeflectedShape::largest_z},
    {"",
     "",
     {"Rotor angle then (deg)", "{:.1f}"},
     {"rotor angle deg", "{:.1f}"},
     [](const auto &shape) { return shape.instant * degrees; }},
    {"z", "", {}, {}, &DeflectedShape::z},
    {"x", "", {}, {}, &DeflectedShape::x},
    {"y", "", {}, {}, &DeflectedShape::y},
    {"envelope", "", {}, {}, &DeflectedShape::envelope}};

std::vector<OrbitRow> rows_of(const std::vector<Orbits> &all, bool in_supports) {
    std::vector<OrbitRow> rows;
    for (const Orbits &orbits : all)
        for (const Orbit &orbit : orbits.stations)
            if (!in_supports || orbit.of != "station")
                rows.push_back({orbits.speed, orbit});
    return rows;
}

/// A point of a deflected shape.
struct ShapePoint {
    const DeflectedShape &shape;
    std::size_t index;
};
auto at_point(std::vector<double> DeflectedShape::*list) {
    return [list](const ShapePoint &point) { return (point.shape.*list)[point.index]; };
}
const Columns<ShapePoint> point_columns{
    {"", "speed [rad/s]", {}, {}, [](const auto &point) { return point.shape.speed; }},
    {"", "z [m]", {}, {}, at_point(&DeflectedShape::z)},
    {"", "x_instant [m]", {}, {}, at_point(&DeflectedShape::x)},
    {"", "y_instant [m]", {}, {}, at_point(&DeflectedShape::y)},
    {"", "major [m]", {}, {}, at_point(&DeflectedShape::envelope)}};

std::string shapes_csv(const std::vector<DeflectedShape> &shapes) {
    std::vector<ShapePoint> points;
    for (const DeflectedShape &shape : shapes)
        for (std::size_t i = 0; i < shape.z.size(); ++i)
            points.push_back({shape, i});
    return csv_table(point_columns, points);
}

} // namespace

void add_orbits(Json &json, const ResponseResult &result) {
    json["orbits"] = json_list(result.orbits, [](const Orbits &orbits) {
        std::vector<OrbitRow> rows;
        for (const Orbit &orbit : orbits.stations)
            rows.push_back({orbits.speed, orbit});
        return Json{{"speed", orbits.speed}, {"stations", json_rows(orbit_columns, rows)}};
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
    std::string text;
    if (!result.clearances.empty())
        text += "\n" + text_table(use_columns, result.clearances);
    const std::vector<OrbitRow> rows = rows_of(result.orbits, true);
    if (!rows.empty())
        text += "\n" + text_table(orbit_columns, rows);
    if (!result.shapes.empty())
        text += "\n" + text_table(shape_columns, result.shapes);
    return text;
}

std::vector<Picture> orbit_pictures(const model::Case &scene, const ResponseResult &result) {
    std::vector<Picture> pictures;
    if (!result.orbits.empty())
        pictures.push_back({"response_orbits", orbits_figure(scene, result.orbits),
                            csv_table(orbit_columns, rows_of(result.orbits, false))});
    if (!result.shapes.empty())
        pictures.push_back(
            {"response_shapes", shapes_figure(scene, result.shapes), shapes_csv(result.shapes)});
    return pictures;
}

} // namespace whirl::report

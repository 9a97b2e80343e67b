#include "report/vtk.h"

#include "report/common/words.h"
#include "report/pictures/shaft_outline.h"
#include "results/modes.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace whirl::report {

namespace {

constexpr int around = 16; ///< points of the surface at each station

/// Points come station by station: first the centre line, then the rings of the surface.
struct Grid {
    std::size_t stations = 0;
    [[nodiscard]] std::size_t points() const { return stations * (1 + around); }
    [[nodiscard]] std::size_t ring(std::size_t station, int k) const {
        return stations + station * around + static_cast<std::size_t>(k % around);
    }
};

pugi::xml_node add_array(pugi::xml_node parent, const std::string &name, const char *type,
                         int components, const std::string &values) {
    pugi::xml_node array = parent.append_child("DataArray");
    array.append_attribute("type") = type;
    if (!name.empty())
        array.append_attribute("Name") = name.c_str();
    if (components > 1)
        array.append_attribute("NumberOfComponents") = components;
    array.append_attribute("format") = "ascii";
    array.append_child(pugi::node_pcdata).set_value(values.c_str());
    return array;
}

std::string coordinates(const model::Case &scene, const std::vector<double> &z) {
    std::string text;
    for (const double place : z)
        text += fmt::format("0 0 {}\n", place);
    for (const double place : z) {
        const double radius = shaft_radius(scene.rotor.shaft, place);
        for (int k = 0; k < around; ++k)
            text += fmt::format("{:.9g} {:.9g} {}\n", radius * std::cos(2 * pi * k / around),
                                radius * std::sin(2 * pi * k / around), place);
    }
    return text;
}

/// Displacements of the sections, the same for all points of a station; sections do not tilt here.
std::string vectors(const Grid &grid, const results::ModeShape &mode, bool real) {
    const auto part = [real](std::complex<double> value) {
        const double number = real ? value.real() : value.imag();
        return std::isfinite(number) ? number : 0;
    };
    std::string text;
    const auto add = [&](std::size_t i) {
        text += fmt::format("{} {} 0\n", part(mode.x[i]), part(mode.y[i]));
    };
    for (std::size_t i = 0; i < grid.stations; ++i)
        add(i);
    for (std::size_t i = 0; i < grid.stations; ++i)
        for (int k = 0; k < around; ++k)
            add(i);
    return text;
}

void add_cells(pugi::xml_node piece, const Grid &grid) {
    std::string line;
    for (std::size_t i = 0; i < grid.stations; ++i)
        line += fmt::format("{} ", i);
    pugi::xml_node lines = piece.append_child("Lines");
    add_array(lines, "connectivity", "Int64", 1, line);
    add_array(lines, "offsets", "Int64", 1, std::to_string(grid.stations));
    std::string quads;
    std::string offsets;
    int count = 0;
    for (std::size_t i = 0; i + 1 < grid.stations; ++i)
        for (int k = 0; k < around; ++k) {
            quads += fmt::format("{} {} {} {}\n", grid.ring(i, k), grid.ring(i, k + 1),
                                 grid.ring(i + 1, k + 1), grid.ring(i + 1, k));
            offsets += fmt::format("{} ", 4 * ++count);
        }
    pugi::xml_node polygons = piece.append_child("Polys");
    add_array(polygons, "connectivity", "Int64", 1, quads);
    add_array(polygons, "offsets", "Int64", 1, offsets);
}

} // namespace

std::string to_vtp(const model::Case &scene, const results::ModesResult &result) {
    Grid surface{result.z.size()};
    for (const auto *list : {&result.modes, &result.critical})
        for (const auto &mode : *list)
            surface.stations = std::min({surface.stations, mode.x.size(), mode.y.size()});
    const std::vector<double> z(result.z.begin(),
                                result.z.begin() + static_cast<std::ptrdiff_t>(surface.stations));
    pugi::xml_document document;
    pugi::xml_node file = document.append_child("VTKFile");
    file.append_attribute("type") = "PolyData";
    file.append_attribute("version") = "1.0";
    file.append_attribute("byte_order") = "LittleEndian";
    pugi::xml_node piece = file.append_child("PolyData").append_child("Piece");
    piece.append_attribute("NumberOfPoints") = surface.points();
    piece.append_attribute("NumberOfVerts") = 0;
    piece.append_attribute("NumberOfLines") = 1;
    piece.append_attribute("NumberOfStrips") = 0;
    piece.append_attribute("NumberOfPolys") =
        surface.stations > 0 ? (surface.stations - 1) * static_cast<std::size_t>(around) : 0;
    pugi::xml_node data = piece.append_child("PointData");
    const auto add = [&](const std::string &name, const results::ModeShape &mode) {
        add_array(data, name + " real", "Float64", 3, vectors(surface, mode, true));
        add_array(data, name + " imag", "Float64", 3, vectors(surface, mode, false));
    };
    int place = 0;
    for (const auto &mode : result.modes) {
        ++place;
        add(mode.label.empty() ? "mode " + std::to_string(place) : mode.label, mode);
    }
    place = 0;
    for (const auto &mode : result.critical)
        add(fmt::format("critical {}{} at {:.6g} rad/s", ++place,
                        mode.label.empty() ? "" : " " + mode.label, mode.at),
            mode);
    add_array(piece.append_child("Points"), "Points", "Float64", 3, coordinates(scene, z));
    add_cells(piece, surface);
    std::ostringstream text;
    document.save(text, " ", pugi::format_default, pugi::encoding_utf8);
    return text.str();
}

} // namespace whirl::report

#include "report/pictures/figures.h"

#include "balancers/kind.h"
#include "report/common/text_width.h"
#include "report/pictures/scene_parts.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

constexpr double text_size = 13;   ///< pixels
constexpr double line_height = 17; ///< from text line_height to text line_height, pixels

/// A name with the place it points to.
struct Callout {
    double x, y;
    std::string text;
};

double largest_radius(const model::Rotor &rotor) {
    double radius = 0;
    for (const auto &segment : rotor.shaft.segments) {
        radius = std::max({radius, segment.outer_start / 2, segment.outer_end / 2});
        for (const model::Layer &layer : segment.layers)
            radius = std::max(radius, layer.outer / 2);
    }
    for (const auto &disc : rotor.discs)
        radius = std::max(radius, disc_radius(disc));
    for (const auto &balancer : rotor.balancers)
        radius = std::max(radius, balancers::kind_of(balancer)->outline().radius());
    return radius;
}

/// Where the name of a callout stands.
struct PlacedName {
    double x, half, baseline;
    [[nodiscard]] double top() const { return baseline - text_size; }
    [[nodiscard]] double bottom() const { return baseline + 4; }
};

/// From a name to its part, with gaps where other names stand in the way.
void draw_leader(Drawing &drawing, const Callout &callout, double name_end,
                 const std::vector<PlacedName> &names) {
    std::vector<std::pair<double, double>> in_the_way;
    for (const PlacedName &name : names)
        if (std::abs(name.x - callout.x) < name.half + 2)
            in_the_way.emplace_back(name.top(), name.bottom());
    std::sort(in_the_way.begin(), in_the_way.end());
    double from = std::min(name_end, callout.y);
    const double to = std::max(name_end, callout.y);
    const auto piece = [&](double end) {
        if (end - from > 0.5)
            drawing.shapes.push_back(stroke({{callout.x, from}, {callout.x, end}}, "#AAAAAA", 0.8));
    };
    for (const auto &[above, below] : in_the_way) {
        if (below <= from || above >= to)
            continue;
        piece(above);
        from = std::max(from, below);
    }
    piece(to);
}

/// Callouts in as few rows as keep them apart, with a thin line to their parts. Rows grow away
/// from the rotor: upwards for `direction` -1. @returns the number of rows.
int draw_callouts(Drawing &drawing, std::vector<Callout> callouts, double start, double direction) {
    std::stable_sort(callouts.begin(), callouts.end(),
                     [](const Callout &a, const Callout &b) { return a.x < b.x; });
    std::vector<PlacedName> names;
    std::vector<double> row_ends;
    for (const Callout &callout : callouts) {
        const double half = text_width(callout.text, text_size) / 2;
        const double x =
            std::clamp(callout.x, half + 4, std::max(half + 4, sheet_width - half - 4));
        std::size_t row = 0;
        while (row < row_ends.size() && row_ends[row] > x - half)
            ++row;
        if (row == row_ends.size())
            row_ends.push_back(0);
        row_ends[row] = x + half + 12;
        names.push_back({x, half, start + direction * line_height * static_cast<double>(row)});
        drawing.texts.push_back({{x, names.back().baseline}, callout.text, text_size});
    }
    for (std::size_t i = 0; i < callouts.size(); ++i)
        draw_leader(drawing, callouts[i], direction < 0 ? names[i].bottom() : names[i].top(),
                    names);
    return static_cast<int>(row_ends.size());
}

std::string name_or(const std::string &name, const char *kind, std::size_t index,
                    std::size_t count) {
    if (!name.empty())
        return name;
    return count == 1 ? kind : fmt::format("{} {}", kind, index + 1);
}

std::string stiffness_text(const Units &units, const model::Bearing &bearing) {
    if (bearing.depends_on_speed())
        return "speed table";
    if (bearing.rows.empty())
        return "";
    const auto &k = bearing.rows[0].k;
    const std::string both = drawn_value(units, Quantity::stiffness, k(1, 1), 3);
    return k(0, 0) == k(1, 1) ? both
                              : drawn_number(units(Quantity::stiffness, k(0, 0)), 3) + " | " + both;
}

/// A callout for each of a kind: its place and its name, or its number among them.
/// @param height  of the end of its line
void add_callouts(std::vector<Callout> &callouts, const Sheet &sheet, const auto &parts,
                  const char *kind, const auto &height) {
    for (std::size_t i = 0; i < parts.size(); ++i)
        callouts.push_back({sheet.across(parts[i].z), height(parts[i]),
                            name_or(parts[i].name, kind, i, parts.size())});
}

std::vector<Callout> upper_callouts(const Units &units, const model::Rotor &rotor,
                                    const Sheet &sheet) {
    std::vector<Callout> callouts;
    const auto top = [&](double radius) { return sheet.axis - sheet.pixels(radius) - 2; };
    const auto above = [&](const auto &) { return sheet.axis - sheet.radius - 10; };
    add_callouts(callouts, sheet, rotor.discs, "disc",
                 [&](const model::Disc &disc) { return top(disc_radius(disc)); });
    for (std::size_t i = 0; i < rotor.discs.size(); ++i)
        callouts[i].text += ": " + drawn_value(units, Quantity::mass, rotor.discs[i].mass, 4);
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const auto &balancer = rotor.balancers[i];
        const balancers::Outline outline = balancers::kind_of(balancer)->outline();
        const std::string name =
            name_or(balancer.name, outline.label.c_str(), i, rotor.balancers.size());
        callouts.push_back({sheet.across(balancer.z), top(outline.radius()) - 5,
                            name + (balancer.held ? " (held)" : "")});
    }
    add_callouts(callouts, sheet, rotor.anisotropies, "anisotropy",
                 [&](const auto &) { return sheet.axis - 21; });
    add_callouts(callouts, sheet, rotor.planes, "plane", above);
    add_callouts(callouts, sheet, rotor.seals(), "seal", [&](const model::Bearing &seal) {
        return top(shaft_radius(rotor.shaft, seal.z)) - 9;
    });
    for (std::size_t i = 0; i < rotor.imbalances.size(); ++i) {
        const auto &imbalance = rotor.imbalances[i];
        if (imbalance.mr != 0)
            callouts.push_back(
                {sheet.across(imbalance.z),
                 std::min(sheet.axis, imbalance_place(sheet, rotor.shaft, imbalance).y) - 5,
                 name_or(imbalance.name, "imbalance", i, rotor.imbalances.size()) + ": " +
                     drawn_value(units, Quantity::imbalance, std::abs(imbalance.mr), 4)});
    }
    add_callouts(callouts, sheet, rotor.probes, "probe", above);
    add_callouts(callouts, sheet, rotor.forces, "force", above);
    return callouts;
}

/// Ticks of 1, 2 or 5 times a power of ten along the shaft, in m, or mm for short rotors.
void draw_ruler(Drawing &drawing, const Units &units, const Sheet &sheet, double length, double y) {
    if (!(length > 0)) // a scene without a shaft has nothing to measure
        return;
    const bool millimetres = length < 1 && !units.asked(Quantity::length);
    const double factor = millimetres ? 1000 : units.factor(Quantity::length);
    // Numbers need some 60 pixels each.
    const double raw =
        factor * length / std::clamp((sheet.across(length) - sheet.across(0)) / 60, 1.0, 6.0);
    const double power = std::pow(10, std::floor(std::log10(raw)));
    const double step = raw / power < 1.5 ? power : raw / power < 3.5 ? 2 * power : 5 * power;
    drawing.shapes.push_back(
        stroke({{sheet.across(0), y}, {sheet.across(length), y}}, "#333333", 1));
    for (int i = 0; i * step <= factor * length * (1 + 1e-9); ++i) {
        const double x = sheet.across(i * step / factor);
        drawing.shapes.push_back(stroke({{x, y}, {x, y + 6}}, "#333333", 1));
        drawing.texts.push_back({{x, y + 20}, fmt::format("{:.6g}", i * step), 12});
    }
    std::string label = millimetres ? "z (mm)" : units.label("z", Quantity::length);
    if (sheet.enlarged() > 1)
        label += fmt::format(", diameters drawn {:.0f} times larger", sheet.enlarged());
    drawing.texts.push_back({{sheet_width / 2, y + 40}, label, text_size});
}

std::vector<Callout> bearing_callouts(const Units &units, const model::Rotor &rotor,
                                      const Sheet &sheet, double ground) {
    std::vector<Callout> callouts;
    const auto bearings = rotor.supports();
    add_callouts(callouts, sheet, bearings, "bearing", [&](const auto &) { return ground + 7; });
    for (std::size_t i = 0; i < bearings.size(); ++i)
        callouts[i].text += ": " + stiffness_text(units, bearings[i]);
    return callouts;
}

/// Everything of the rotor; `top` pixels stay free above.
Drawing draw_rotor(const model::Rotor &rotor, const Units &units, const Sheet &sheet) {
    Drawing drawing;
    drawing.width = sheet_width;
    const double reach = sheet.radius + 12;
    for (const auto &plane : rotor.planes)
        drawing.shapes.push_back(stroke({{sheet.across(plane.z), sheet.axis - reach},
                                         {sheet.across(plane.z), sheet.axis + reach}},
                                        "#007D5A", 1.4, true));
    draw_shaft(drawing, sheet, rotor.shaft);
    for (const auto &probe : rotor.probes)
        draw_probe(drawing, sheet, rotor.shaft, probe);
    for (const auto &force : rotor.forces)
        draw_force(drawing, sheet, rotor.shaft, force);
    for (const auto &disc : rotor.discs)
        draw_disc(drawing, sheet, rotor.shaft, disc);
    for (const auto &balancer : rotor.balancers)
        draw_balancer(drawing, sheet, balancer);
    for (const auto &anisotropy : rotor.anisotropies)
        draw_anisotropy(drawing, sheet, anisotropy);
    for (const auto &imbalance : rotor.imbalances)
        if (imbalance.mr != 0)
            draw_imbalance(drawing, sheet, rotor.shaft, imbalance);
    drawing.shapes.push_back(stroke(
        {{sheet.across(0) - 18, sheet.axis}, {sheet.across(rotor.shaft.length()) + 18, sheet.axis}},
        "#6B7885", 0.8, true));
    const double ground = sheet.axis + sheet.radius + 62;
    for (const auto &seal : rotor.seals())
        draw_seal(drawing, sheet, rotor.shaft, seal);
    for (const auto &bearing : rotor.supports())
        draw_bearing(drawing, sheet, rotor.shaft, bearing, ground);
    const int rows =
        draw_callouts(drawing, bearing_callouts(units, rotor, sheet, ground), ground + 28, 1);
    const double ruler = ground + 34 + line_height * rows;
    draw_ruler(drawing, units, sheet, rotor.shaft.length(), ruler);
    drawing.height = ruler + 52;
    return drawing;
}

/// With room above the rotor for its rows of names: these are drawn once on a scrap sheet.
Sheet sheet_of(const model::Case &scene, const Units &units) {
    const model::Rotor rotor = scene.rotor.with_held_among_balancers();
    Sheet sheet(scene, largest_radius(rotor));
    Drawing scrap;
    const int rows = draw_callouts(scrap, upper_callouts(units, rotor, sheet), 0, -1);
    sheet.axis = 20 + line_height * rows + 16 + sheet.radius;
    return sheet;
}

} // namespace

Drawing scene_drawing(const model::Case &scene, const Units &units) {
    const Sheet sheet = sheet_of(scene, units);
    const model::Rotor rotor = scene.rotor.with_held_among_balancers();
    Drawing drawing = draw_rotor(rotor, units, sheet);
    draw_callouts(drawing, upper_callouts(units, rotor, sheet), sheet.axis - sheet.radius - 18, -1);
    return drawing;
}

namespace {

/// "shaft 12 kg", and of one that only connects, so light that it counts as none, no number.
std::string shaft_mass_text(const Units &units, const results::ShowResult &result) {
    return result.shaft_mass < 1e-6 * result.mass
               ? "massless shaft"
               : "shaft " + drawn_value(units, Quantity::mass, result.shaft_mass);
}

} // namespace

Drawing show_drawing(const model::Case &scene, const results::ShowResult &result,
                     const Units &units) {
    Drawing drawing = scene_drawing(scene, units);
    const double head = 68;
    for (DrawShape &shape : drawing.shapes)
        for (DrawPoint &point : shape.points)
            point.y += head;
    for (DrawText &text : drawing.texts)
        text.at.y += head;
    drawing.height += head;
    drawing.texts.push_back({{sheet_width / 2, 28}, title_of(scene), 20});
    drawing.texts.push_back(
        {{sheet_width / 2, 52},
         fmt::format("mass {} ({}) · centre of mass z = {} · Id = {} · Ip = {} · {} rotor",
                     drawn_value(units, Quantity::mass, result.mass),
                     shaft_mass_text(units, result),
                     drawn_value(units, Quantity::length, result.center_of_mass),
                     drawn_value(units, Quantity::inertia, result.Id),
                     drawn_value(units, Quantity::inertia, result.Ip), result.type),
         14,
         "#555555"});
    const Sheet sheet = sheet_of(scene, units);
    const double x = sheet.across(result.center_of_mass);
    const double y = head + sheet.axis;
    drawing.shapes.push_back(circle(x, y, 7, "#FFFFFF", "#B00020"));
    for (const double side : {7.0, -7.0})
        drawing.shapes.push_back(area({{x, y}, {x + side, y}, {x, y - side}}, "#B00020", ""));
    return drawing;
}

} // namespace whirl::report

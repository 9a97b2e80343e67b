#include "report/pictures/figures.h"

#include "balancers/kind.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

constexpr double sheet_width = 1080;
constexpr double side = 70;      ///< free space left and right, pixels
constexpr double text_size = 13; ///< pixels
constexpr double letter = 7.3;   ///< mean width of a letter at that size, pixels
constexpr double line = 17;      ///< from text line to text line, pixels

/// A name with the place it points to.
struct Callout {
    double x, y;
    std::string text;
};

/// Places of the sheet for z and radii.
class Sheet {
  public:
    Sheet(const model::Case &scene, double largest_radius) {
        const double length = std::max(scene.rotor.shaft.length(), 1e-12);
        _z_scale = (sheet_width - 2 * side) / length;
        const double wanted = 130; // pixels for the largest radius, at most
        _r_scale = std::min(_z_scale, wanted / std::max(largest_radius, 1e-12));
        if (_r_scale < _z_scale) { // a thick rotor: shrink both
            _z_scale = _r_scale;
        } else if (largest_radius * _r_scale < 18) { // a slender one: enlarge the radii
            _enlarged = std::ceil(24 / std::max(largest_radius * _r_scale, 1e-9));
            _r_scale *= _enlarged;
        }
        _left = (sheet_width - length * _z_scale) / 2;
        radius = largest_radius * _r_scale;
    }
    [[nodiscard]] double across(double z) const { return _left + z * _z_scale; }
    [[nodiscard]] double pixels(double r) const { return r * _r_scale; }
    [[nodiscard]] double enlarged() const { return _enlarged; }

    double axis = 0;   ///< of the rotor, pixels from the top
    double radius = 0; ///< largest, pixels

  private:
    double _left = 0, _z_scale = 1, _r_scale = 1, _enlarged = 1;
};

double disc_radius(const model::Disc &disc) {
    if (disc.outer > 0)
        return disc.outer / 2;
    return disc.mass > 0 ? std::sqrt(2 * std::max(disc.Ip, 0.0) / disc.mass) : 0; // Ip = m r^2/2
}

double largest_radius(const model::Rotor &rotor) {
    double radius = 0;
    for (const auto &segment : rotor.shaft.segments)
        radius = std::max({radius, segment.outer_start / 2, segment.outer_end / 2});
    for (const auto &disc : rotor.discs)
        radius = std::max(radius, disc_radius(disc));
    for (const auto &balancer : rotor.balancers)
        radius = std::max(radius, balancers::kind_of(balancer)->outline().radius());
    return radius;
}

DrawShape area(std::vector<DrawPoint> points, std::string fill, std::string stroke) {
    return {std::move(points), std::move(fill), std::move(stroke), 1, false, true};
}

DrawShape stroke(std::vector<DrawPoint> points, std::string colour, double width, bool dashed) {
    return {std::move(points), "", std::move(colour), width, dashed, false};
}

DrawShape circle(double x, double y, double radius, std::string fill, std::string colour) {
    std::vector<DrawPoint> points;
    for (int i = 0; i < 24; ++i)
        points.push_back({x + radius * std::cos(i * pi / 12), y + radius * std::sin(i * pi / 12)});
    return area(std::move(points), std::move(fill), std::move(colour));
}

void draw_shaft(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft) {
    double z = 0;
    for (const auto &segment : shaft.segments) {
        const double a = sheet.across(z);
        const double b = sheet.across(z + segment.length);
        const auto section = [&](double start, double end) {
            const double r = sheet.pixels(start / 2);
            const double s = sheet.pixels(end / 2);
            return std::vector<DrawPoint>{
                {a, sheet.axis - r}, {b, sheet.axis - s}, {b, sheet.axis + s}, {a, sheet.axis + r}};
        };
        drawing.shapes.push_back(
            area(section(segment.outer_start, segment.outer_end), "#C9D3DC", "#33404C"));
        if (segment.inner_start > 0 || segment.inner_end > 0) {
            DrawShape bore =
                area(section(segment.inner_start, segment.inner_end), "#FFFFFF", "#33404C");
            bore.dashed = true;
            drawing.shapes.push_back(bore);
        }
        z += segment.length;
    }
}

void draw_disc(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
               const model::Disc &disc) {
    const double x = sheet.across(disc.z);
    const double outer = sheet.pixels(disc_radius(disc));
    const bool known = disc.outer > 0;
    const double half =
        std::max(disc.width > 0 ? (sheet.across(disc.z + disc.width) - x) / 2 : 3.0, 2.0);
    const double inner = sheet.pixels(shaft_radius(shaft, disc.z));
    for (const double up : {-1.0, 1.0}) {
        DrawShape half_disc = area({{x - half, sheet.axis + up * inner},
                                    {x + half, sheet.axis + up * inner},
                                    {x + half, sheet.axis + up * std::max(outer, inner + 4)},
                                    {x - half, sheet.axis + up * std::max(outer, inner + 4)}},
                                   known ? "#8FB3CF" : "#DCE7F0", "#1F4E79");
        half_disc.dashed = !known; // a disc by mass and inertia: drawn at its equivalent radius
        drawing.shapes.push_back(half_disc);
    }
}

void draw_spring(Drawing &drawing, double x, double top, double bottom) {
    std::vector<DrawPoint> points{{x, top}};
    const int turns = std::clamp(static_cast<int>((bottom - top) / 8), 4, 40);
    for (int i = 0; i < turns; ++i)
        points.push_back({x + (i % 2 == 0 ? 5 : -5), top + (bottom - top) * (i + 0.5) / turns});
    points.push_back({x, bottom});
    drawing.shapes.push_back(stroke(std::move(points), "#333333", 1.4, false));
}

/// Triangle below the shaft on a spring, on its pedestal where there is one, on hatched ground.
void draw_bearing(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                  const model::Bearing &bearing, double ground) {
    const double x = sheet.across(bearing.z);
    const double top = sheet.axis + sheet.pixels(shaft_radius(shaft, bearing.z));
    drawing.shapes.push_back(
        area({{x, top}, {x + 10, top + 15}, {x - 10, top + 15}}, "#FFFFFF", "#333333"));
    double from = top + 15;
    if (bearing.pedestal) {
        const double middle = (from + ground) / 2;
        draw_spring(drawing, x, from, middle - 6);
        drawing.shapes.push_back(area({{x - 14, middle - 6},
                                       {x + 14, middle - 6},
                                       {x + 14, middle + 6},
                                       {x - 14, middle + 6}},
                                      "#BBBBBB", "#333333"));
        from = middle + 6;
    }
    draw_spring(drawing, x, from, ground);
    drawing.shapes.push_back(stroke({{x - 17, ground}, {x + 17, ground}}, "#333333", 1.6, false));
    for (int i = -3; i <= 3; ++i)
        drawing.shapes.push_back(
            stroke({{x + i * 5, ground}, {x + i * 5 - 5, ground + 6}}, "#333333", 0.8, false));
}

/// A box around all its parts, and these above and below the axis.
void draw_balancer(Drawing &drawing, const Sheet &sheet, const model::Balancer &balancer) {
    const balancers::Outline outline = balancers::kind_of(balancer)->outline();
    const double x = sheet.across(balancer.z);
    const auto box = [x](double half, double from, double to, const char *fill) {
        return area({{x - half, from}, {x + half, from}, {x + half, to}, {x - half, to}}, fill,
                    "#8A5A00");
    };
    const double reach = sheet.pixels(outline.radius()) + 6;
    drawing.shapes.push_back(box(7, sheet.axis - reach, sheet.axis + reach, ""));
    drawing.shapes.back().width = 1.6;
    for (const double up : {-1.0, 1.0}) {
        const auto height = [&](double r) { return sheet.axis + up * sheet.pixels(r); };
        for (const auto &[from, to] : outline.sections)
            drawing.shapes.push_back(box(4.5, height(from), height(to), "#F0B429"));
        for (const auto &[from, to] : outline.arms)
            drawing.shapes.push_back(
                stroke({{x, height(from)}, {x, height(to)}}, "#8A5A00", 1.6, false));
        for (const double point : outline.points)
            drawing.shapes.push_back(circle(x, height(point), 4.5, "#F0B429", "#8A5A00"));
    }
}

/// A lens across the shaft: the section's inertias differ between its two axes.
void draw_anisotropy(Drawing &drawing, const Sheet &sheet, const model::Anisotropy &anisotropy) {
    const double x = sheet.across(anisotropy.z);
    std::vector<DrawPoint> lens;
    for (int i = 0; i < 32; ++i)
        lens.push_back({x + 5 * std::cos(i * pi / 16), sheet.axis + 20 * std::sin(i * pi / 16)});
    drawing.shapes.push_back(area(std::move(lens), "#E7C6DA", "#8B3A6B"));
}

/// An arrow from above that ends at the surface of the shaft, whatever its direction.
void draw_probe(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                const model::Probe &probe) {
    const double x = sheet.across(probe.z);
    const double tip = sheet.axis - sheet.pixels(shaft_radius(shaft, probe.z));
    drawing.shapes.push_back(
        area({{x, tip}, {x - 4, tip - 9}, {x + 4, tip - 9}}, "#5B3A8B", "#5B3A8B"));
    drawing.shapes.push_back(
        stroke({{x, tip - 9}, {x, sheet.axis - sheet.radius - 10}}, "#5B3A8B", 1.4, false));
}

/// Callouts in as few rows as keep them apart, with a thin line to their parts. Rows grow away
/// from the rotor: upwards for `direction` -1. @returns the number of rows.
int draw_callouts(Drawing &drawing, std::vector<Callout> callouts, double start, double direction) {
    std::stable_sort(callouts.begin(), callouts.end(),
                     [](const Callout &a, const Callout &b) { return a.x < b.x; });
    std::vector<double> row_ends;
    for (const Callout &callout : callouts) {
        const double half = letter * static_cast<double>(callout.text.size()) / 2;
        const double x =
            std::clamp(callout.x, half + 4, std::max(half + 4, sheet_width - half - 4));
        std::size_t row = 0;
        while (row < row_ends.size() && row_ends[row] > x - half)
            ++row;
        if (row == row_ends.size())
            row_ends.push_back(0);
        row_ends[row] = x + half + 12;
        const double y = start + direction * line * static_cast<double>(row);
        drawing.shapes.push_back(
            stroke({{callout.x, callout.y}, {callout.x, direction < 0 ? y + 4 : y - text_size}},
                   "#AAAAAA", 0.8, false));
        drawing.texts.push_back({{x, y}, callout.text, text_size, Anchor::middle, "#222222"});
    }
    return static_cast<int>(row_ends.size());
}

std::string name_or(const std::string &name, const char *kind, std::size_t index,
                    std::size_t count) {
    if (!name.empty())
        return name;
    return count == 1 ? kind : fmt::format("{} {}", kind, index + 1);
}

std::string stiffness_text(const model::Bearing &bearing) {
    if (bearing.depends_on_speed())
        return "speed table";
    if (bearing.rows.empty())
        return "";
    const auto &k = bearing.rows[0].k;
    return k(0, 0) == k(1, 1)
               ? readable(k(0, 0), 3) + " N/m"
               : fmt::format("{} | {} N/m", readable(k(0, 0), 3), readable(k(1, 1), 3));
}

std::vector<Callout> upper_callouts(const model::Rotor &rotor, const Sheet &sheet) {
    std::vector<Callout> callouts;
    const auto top = [&](double radius) { return sheet.axis - sheet.pixels(radius) - 2; };
    for (std::size_t i = 0; i < rotor.discs.size(); ++i) {
        const auto &disc = rotor.discs[i];
        callouts.push_back(
            {sheet.across(disc.z), top(disc_radius(disc)),
             fmt::format("{}: {} kg", name_or(disc.name, "disc", i, rotor.discs.size()),
                         readable(disc.mass, 4))});
    }
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const auto &balancer = rotor.balancers[i];
        const balancers::Outline outline = balancers::kind_of(balancer)->outline();
        callouts.push_back(
            {sheet.across(balancer.z), top(outline.radius()) - 5,
             name_or(balancer.name, outline.label.c_str(), i, rotor.balancers.size())});
    }
    for (std::size_t i = 0; i < rotor.anisotropies.size(); ++i)
        callouts.push_back(
            {sheet.across(rotor.anisotropies[i].z), sheet.axis - 21,
             name_or(rotor.anisotropies[i].name, "anisotropy", i, rotor.anisotropies.size())});
    for (std::size_t i = 0; i < rotor.planes.size(); ++i)
        callouts.push_back({sheet.across(rotor.planes[i].z), sheet.axis - sheet.radius - 10,
                            name_or(rotor.planes[i].name, "plane", i, rotor.planes.size())});
    for (std::size_t i = 0; i < rotor.probes.size(); ++i)
        callouts.push_back({sheet.across(rotor.probes[i].z), sheet.axis - sheet.radius - 10,
                            name_or(rotor.probes[i].name, "probe", i, rotor.probes.size())});
    return callouts;
}

/// Ticks of 1, 2 or 5 times a power of ten along the shaft, in m, or mm for short rotors.
void draw_ruler(Drawing &drawing, const Sheet &sheet, double length, double y) {
    if (!(length > 0)) // a scene without a shaft has nothing to measure
        return;
    const bool millimetres = length < 1;
    // Numbers need some 60 pixels each.
    const double raw = length / std::clamp((sheet.across(length) - sheet.across(0)) / 60, 1.0, 6.0);
    const double power = std::pow(10, std::floor(std::log10(raw)));
    const double step = raw / power < 1.5 ? power : raw / power < 3.5 ? 2 * power : 5 * power;
    drawing.shapes.push_back(
        stroke({{sheet.across(0), y}, {sheet.across(length), y}}, "#333333", 1, false));
    for (int i = 0; i * step <= length * (1 + 1e-9); ++i) {
        const double x = sheet.across(i * step);
        drawing.shapes.push_back(stroke({{x, y}, {x, y + 6}}, "#333333", 1, false));
        drawing.texts.push_back({{x, y + 20},
                                 fmt::format("{:.6g}", i * step * (millimetres ? 1000 : 1)),
                                 12,
                                 Anchor::middle,
                                 "#222222"});
    }
    std::string label = millimetres ? "z (mm)" : "z (m)";
    if (sheet.enlarged() > 1)
        label += fmt::format(", diameters drawn {:.0f} times larger", sheet.enlarged());
    drawing.texts.push_back(
        {{sheet_width / 2, y + 40}, label, text_size, Anchor::middle, "#222222"});
}

std::vector<Callout> bearing_callouts(const model::Rotor &rotor, const Sheet &sheet,
                                      double ground) {
    std::vector<Callout> callouts;
    for (std::size_t i = 0; i < rotor.bearings.size(); ++i)
        callouts.push_back(
            {sheet.across(rotor.bearings[i].z), ground + 7,
             fmt::format("{}: {}",
                         name_or(rotor.bearings[i].name, "bearing", i, rotor.bearings.size()),
                         stiffness_text(rotor.bearings[i]))});
    return callouts;
}

/// Everything of the rotor; `top` pixels stay free above.
Drawing draw_rotor(const model::Case &scene, const Sheet &sheet) {
    const model::Rotor &rotor = scene.rotor;
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
    for (const auto &disc : rotor.discs)
        draw_disc(drawing, sheet, rotor.shaft, disc);
    for (const auto &balancer : rotor.balancers)
        draw_balancer(drawing, sheet, balancer);
    for (const auto &anisotropy : rotor.anisotropies)
        draw_anisotropy(drawing, sheet, anisotropy);
    drawing.shapes.push_back(stroke(
        {{sheet.across(0) - 18, sheet.axis}, {sheet.across(rotor.shaft.length()) + 18, sheet.axis}},
        "#6B7885", 0.8, true));
    const double ground = sheet.axis + sheet.radius + 62;
    for (const auto &bearing : rotor.bearings)
        draw_bearing(drawing, sheet, rotor.shaft, bearing, ground);
    const int rows = draw_callouts(drawing, bearing_callouts(rotor, sheet, ground), ground + 28, 1);
    const double ruler = ground + 34 + line * rows;
    draw_ruler(drawing, sheet, rotor.shaft.length(), ruler);
    drawing.height = ruler + 52;
    return drawing;
}

/// Rows of names needed above the rotor: drawn once on a scrap sheet.
int upper_rows(const model::Rotor &rotor, const Sheet &sheet) {
    Drawing scrap;
    return draw_callouts(scrap, upper_callouts(rotor, sheet), 0, -1);
}

} // namespace

Drawing scene_drawing(const model::Case &scene) {
    Sheet sheet(scene, largest_radius(scene.rotor));
    const int rows = upper_rows(scene.rotor, sheet);
    sheet.axis = 20 + line * rows + 16 + sheet.radius;
    Drawing drawing = draw_rotor(scene, sheet);
    draw_callouts(drawing, upper_callouts(scene.rotor, sheet), sheet.axis - sheet.radius - 18, -1);
    return drawing;
}

Drawing show_drawing(const model::Case &scene, const results::ShowResult &result) {
    Drawing drawing = scene_drawing(scene);
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
         fmt::format("mass {} kg (shaft {} kg)    centre of mass z = {} m    Id = {} kg m²    "
                     "Ip = {} kg m²    {} rotor",
                     readable(result.mass), readable(result.shaft_mass),
                     readable(result.center_of_mass), readable(result.Id), readable(result.Ip),
                     result.type),
         14,
         Anchor::middle,
         "#555555"});
    Sheet sheet(scene, largest_radius(scene.rotor));
    sheet.axis = head + 20 + line * upper_rows(scene.rotor, sheet) + 16 + sheet.radius;
    const double x = sheet.across(result.center_of_mass);
    drawing.shapes.push_back(circle(x, sheet.axis, 7, "#FFFFFF", "#B00020"));
    drawing.shapes.push_back(
        area({{x, sheet.axis}, {x + 7, sheet.axis}, {x, sheet.axis - 7}}, "#B00020", ""));
    drawing.shapes.push_back(
        area({{x, sheet.axis}, {x - 7, sheet.axis}, {x, sheet.axis + 7}}, "#B00020", ""));
    return drawing;
}

} // namespace whirl::report

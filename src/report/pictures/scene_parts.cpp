#include "report/pictures/scene_parts.h"

#include "balancers/kind.h"
#include "report/common/words.h"
#include "report/pictures/shaft_outline.h"

namespace whirl::report {

namespace {

void draw_spring(Drawing &drawing, double x, double top, double bottom) {
    std::vector<DrawPoint> points{{x, top}};
    const int turns = std::clamp(static_cast<int>((bottom - top) / 8), 4, 40);
    for (int i = 0; i < turns; ++i)
        points.push_back({x + (i % 2 == 0 ? 5 : -5), top + (bottom - top) * (i + 0.5) / turns});
    points.push_back({x, bottom});
    drawing.shapes.push_back(stroke(std::move(points), "#333333", 1.4));
}

/// A rectangle about x between two heights.
DrawShape box(double x, double half, double from, double to, std::string fill, std::string colour) {
    return area({{x - half, from}, {x + half, from}, {x + half, to}, {x - half, to}},
                std::move(fill), std::move(colour));
}

} // namespace

double disc_radius(const model::Disc &disc) {
    if (disc.outer > 0)
        return disc.outer / 2;
    return disc.mass > 0 ? std::sqrt(2 * std::max(disc.Ip, 0.0) / disc.mass) : 0; // Ip = m r^2/2
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
        for (auto layer = segment.layers.rbegin(); layer != segment.layers.rend(); ++layer)
            drawing.shapes.push_back(
                area(section(layer->outer, layer->outer), "#E4EAEF", "#33404C"));
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
        DrawShape half_disc =
            box(x, half, sheet.axis + up * inner, sheet.axis + up * std::max(outer, inner + 4),
                known ? "#8FB3CF" : "#DCE7F0", "#1F4E79");
        half_disc.dashed = !known; // a disc by mass and inertia: drawn at its equivalent radius
        drawing.shapes.push_back(half_disc);
    }
}

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
        drawing.shapes.push_back(box(x, 14, middle - 6, middle + 6, "#BBBBBB", "#333333"));
        from = middle + 6;
    }
    draw_spring(drawing, x, from, ground);
    drawing.shapes.push_back(stroke({{x - 17, ground}, {x + 17, ground}}, "#333333", 1.6));
    for (int i = -3; i <= 3; ++i)
        drawing.shapes.push_back(
            stroke({{x + i * 5, ground}, {x + i * 5 - 5, ground + 6}}, "#333333", 0.8));
}

void draw_seal(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
               const model::Bearing &seal) {
    constexpr double half_width = 9; // pixels, like the heights
    constexpr double tooth = 4;
    constexpr double body = 5;
    const double x = sheet.across(seal.z);
    const double radius = sheet.pixels(shaft_radius(shaft, seal.z)) + 1;
    for (const double up : {-1.0, 1.0}) {
        const auto height = [&](double above) { return sheet.axis + up * (radius + above); };
        std::vector<DrawPoint> outline{{x - half_width, height(tooth + body)},
                                       {x - half_width, height(0)}};
        for (int i = 0; i < 3; ++i) {
            const double end = x - half_width + 2 * half_width * (i + 1) / 3;
            outline.push_back({end, height(tooth)});
            outline.push_back({end, height(i < 2 ? 0 : tooth + body)});
        }
        drawing.shapes.push_back(area(std::move(outline), "#D9E8C8", "#4C6B2F"));
    }
}

void draw_balancer(Drawing &drawing, const Sheet &sheet, const model::Balancer &balancer) {
    const balancers::Outline outline = balancers::kind_of(balancer)->outline();
    const double x = sheet.across(balancer.z);
    constexpr const char *ink = "#8A5A00";
    const double reach = sheet.pixels(outline.radius()) + 6;
    drawing.shapes.push_back(box(x, 7, sheet.axis - reach, sheet.axis + reach, "", ink));
    drawing.shapes.back().width = 1.6;
    for (const double up : {-1.0, 1.0}) {
        const auto height = [&](double r) { return sheet.axis + up * sheet.pixels(r); };
        for (const auto &[from, to] : outline.sections)
            drawing.shapes.push_back(box(x, 4.5, height(from), height(to), "#F0B429", ink));
        for (const auto &[from, to] : outline.arms)
            drawing.shapes.push_back(stroke({{x, height(from)}, {x, height(to)}}, ink, 1.6));
        for (const double point : outline.points)
            drawing.shapes.push_back(circle(x, height(point), 4.5, "#F0B429", ink));
    }
}

void draw_anisotropy(Drawing &drawing, const Sheet &sheet, const model::Anisotropy &anisotropy) {
    const double x = sheet.across(anisotropy.z);
    std::vector<DrawPoint> lens;
    for (int i = 0; i < 32; ++i)
        lens.push_back({x + 5 * std::cos(i * pi / 16), sheet.axis + 20 * std::sin(i * pi / 16)});
    drawing.shapes.push_back(area(std::move(lens), "#E7C6DA", "#8B3A6B"));
}

namespace {

/// From above to the surface of the shaft.
void draw_arrow(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft, double z,
                const char *colour) {
    const double x = sheet.across(z);
    const double tip = sheet.axis - sheet.pixels(shaft_radius(shaft, z));
    drawing.shapes.push_back(area({{x, tip}, {x - 4, tip - 9}, {x + 4, tip - 9}}, colour, colour));
    drawing.shapes.push_back(
        stroke({{x, tip - 9}, {x, sheet.axis - sheet.radius - 10}}, colour, 1.4));
}

} // namespace

void draw_probe(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                const model::Probe &probe) {
    draw_arrow(drawing, sheet, shaft, probe.z, "#5B3A8B");
}

void draw_force(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                const model::HarmonicForce &force) {
    draw_arrow(drawing, sheet, shaft, force.z, "#C0152F");
}

DrawPoint imbalance_place(const Sheet &sheet, const model::Shaft &shaft,
                          const model::Imbalance &imbalance) {
    constexpr double outwards = 8; // from the surface
    const double up =
        imbalance.mr * std::cos(imbalance.phase) < -1e-9 * std::abs(imbalance.mr) ? 1 : -1;
    return {sheet.across(imbalance.z),
            sheet.axis + up * (sheet.pixels(shaft_radius(shaft, imbalance.z)) + outwards)};
}

void draw_imbalance(Drawing &drawing, const Sheet &sheet, const model::Shaft &shaft,
                    const model::Imbalance &imbalance) {
    const DrawPoint at = imbalance_place(sheet, shaft, imbalance);
    drawing.shapes.push_back(stroke({{at.x, sheet.axis}, at}, "#C0152F", 1.4));
    drawing.shapes.push_back(circle(at.x, at.y, 4, "#C0152F", "#C0152F"));
}

} // namespace whirl::report

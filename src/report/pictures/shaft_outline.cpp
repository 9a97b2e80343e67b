#include "report/pictures/shaft_outline.h"

#include "report/pictures/style.h"

#include <algorithm>

namespace whirl::report {

double shaft_radius(const model::Shaft &shaft, double z) {
    double start = 0;
    double radius = 0;
    for (const auto &segment : shaft.segments) {
        const double share = segment.length > 0 ? (z - start) / segment.length : 0;
        if (share >= -1e-9 && share <= 1 + 1e-9)
            radius = std::max(
                radius,
                (segment.outer_start + share * (segment.outer_end - segment.outer_start)) / 2);
        start += segment.length;
    }
    return radius;
}

ChartCurve bearings_below(const Units &units, const model::Rotor &rotor, const std::string &name,
                          double size) {
    ChartCurve bearings{name, {}, {"", "#555555", "1", 9}, 0, 1.4};
    for (const auto &bearing : rotor.supports())
        bearings.points.push_back({units(Quantity::length, bearing.z), -1.12 * size});
    return bearings;
}

std::vector<ChartCurve> rotor_outline(const Units &units, const model::Rotor &rotor, double size) {
    double thickest = 1e-12;
    for (const auto &segment : rotor.shaft.segments)
        thickest = std::max({thickest, segment.outer_start / 2, segment.outer_end / 2});
    for (const auto &disc : rotor.discs)
        thickest = std::max(thickest, disc.outer / 2);
    const double scale = 0.5 * size / thickest;
    std::vector<ChartCurve> areas;
    // Above the axis, and back below it.
    const auto add = [&](std::vector<PlotPoint> above) {
        const std::size_t count = above.size();
        for (std::size_t i = count; i-- > 0;)
            above.push_back({above[i].x, -*above[i].y});
        above.push_back(above.front());
        areas.push_back(chart_area({"", "#E6E9EC"}, std::move(above)));
    };
    std::vector<PlotPoint> shaft;
    double z = 0;
    for (const auto &segment : rotor.shaft.segments) {
        shaft.push_back({units(Quantity::length, z), scale * segment.outer_start / 2});
        z += segment.length;
        shaft.push_back({units(Quantity::length, z), scale * segment.outer_end / 2});
    }
    if (!shaft.empty())
        add(shaft);
    for (const auto &disc : rotor.discs) {
        const double half = std::max(disc.width / 2, 0.004 * z);
        const double radius = scale * (disc.outer > 0 ? disc.outer / 2 : 0.7 * thickest);
        add({{units(Quantity::length, disc.z - half), radius},
             {units(Quantity::length, disc.z + half), radius}});
    }
    areas.push_back(bearings_below(units, rotor, "bearing", size));
    return areas;
}

std::vector<ChartCurve>
curves_over_outline(const Units &units, const model::Rotor &rotor, const std::vector<double> &z,
                    const std::vector<double> &x, const std::vector<double> &y,
                    const std::vector<double> &envelope, double factor, double largest) {
    std::vector<ChartCurve> curves = rotor_outline(units, rotor, largest);
    const auto add = [&](const char *name, const std::vector<double> &values, double times,
                         const LineStyle &style, double width) {
        curves.push_back(
            {name, points_over(z, units.factor(Quantity::length), values, times), style, width});
    };
    for (const double sign : {1, -1})
        add("envelope", envelope, sign * factor, {"", "#888888", "1"}, 1);
    add("x", x, factor, series_style(0), 2.2);
    add("y", y, factor, series_style(1), 2.2);
    return curves;
}

ChartAxis along_shaft(const Units &units, const model::Rotor &rotor) {
    const double length = std::max(rotor.shaft.length(), 1e-9);
    return chart_axis(units, "z", Quantity::length, -0.03 * length, 1.03 * length);
}

} // namespace whirl::report

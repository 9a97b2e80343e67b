#include "report/pictures/style.h"

#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::report {

LineStyle whirl_style(results::Whirl whirl) {
    switch (whirl) {
    case results::Whirl::forward:
        return {"forward", "#0072B2", "1", 7};
    case results::Whirl::backward:
        return {"backward", "#D55E00", "(12,6)", 6};
    case results::Whirl::mixed:
        break;
    }
    return {"mixed", "#007D5A", "(14,5,3,5)", 8};
}

LineStyle series_style(std::size_t index) {
    static const std::array<LineStyle, 8> styles{{{"", "#0072B2", "1", 7},
                                                  {"", "#D55E00", "(12,5)", 6},
                                                  {"", "#007D5A", "(3,4)", 9},
                                                  {"", "#A8527F", "(14,5,3,5)", 4},
                                                  {"", "#B77F00", "1", 5},
                                                  {"", "#3C97CF", "(12,5)", 8},
                                                  {"", "#000000", "(3,4)", 11},
                                                  {"", "#7A7A7A", "(14,5,3,5)", 12}}};
    // A second round differs from the first in dashes and markers.
    LineStyle style = styles[index % styles.size()];
    const LineStyle &further = styles[(index + 5 * (index / styles.size())) % styles.size()];
    style.dash = further.dash;
    style.point = further.point;
    return style;
}

std::string drawn_number(double value, int digits) { return with_powers(readable(value, digits)); }

std::string drawn_value(const Units &units, Quantity quantity, double si, int digits) {
    return drawn_number(units(quantity, si), digits) + " " + units.name(quantity);
}

std::string degrees_text(double angle) { return drawn_number(angle * degrees, 4) + "°"; }

std::string drawn_speed(const Units &units, double speed) {
    const double value = units(Quantity::speed, speed);
    return std::abs(value) < 1000 || std::abs(value) >= 1e6 ? drawn_number(value, 4)
                                                            : fmt::format("{:.0f}", value);
}

std::string place_text(const Units &units, const std::string &name, double z) {
    return (name.empty() ? "" : name + ", ") + "z = " + drawn_value(units, Quantity::length, z, 4);
}

std::string data_block(const std::string &name, const std::vector<PlotPoint> &line) {
    std::string block = "$" + name + " << EOD\n";
    for (const PlotPoint &point : line)
        // In full: rounded, the first and the last could lie outside of the axis.
        block += point.y && std::isfinite(*point.y) ? fmt::format("{} {}\n", point.x, *point.y)
                                                    : fmt::format("{} NaN\n", point.x);
    // gnuplot refuses an empty block; a point without a value draws nothing.
    return block + "\nNaN NaN\nEOD\n";
}

std::vector<PlotPoint> points_over(const std::vector<double> &x, double x_factor,
                                   const std::vector<double> &y, double y_factor) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < x.size() && i < y.size(); ++i)
        points.push_back({x[i] * x_factor, y[i] * y_factor});
    return points;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double &value : values)
        value *= factor;
    return values;
}

std::vector<PlotPoint> angles_over(const std::vector<double> &x, double x_factor,
                                   const std::vector<double> &angles) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < x.size() && i < angles.size(); ++i) {
        const double place = x[i] * x_factor;
        if (!std::isfinite(angles[i])) {
            points.push_back({place, std::nullopt});
            continue;
        }
        const double degrees = std::remainder(angles[i], 2 * pi) * 180 / pi;
        if (!points.empty() && points.back().y && std::abs(degrees - *points.back().y) > 180)
            points.push_back({place, std::nullopt});
        points.push_back({place, degrees});
    }
    return points;
}

std::vector<PlotPoint> circle_points(double radius) {
    std::vector<PlotPoint> points;
    for (int k = 0; k <= 120; ++k)
        points.push_back({radius * std::cos(k * pi / 60), radius * std::sin(k * pi / 60)});
    return points;
}

Range range_of(const std::vector<double> &values) {
    if (values.empty())
        return {0, 1};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    constexpr double rounding = 1e-9;
    if (*high - *low > rounding * std::max(std::abs(*low), std::abs(*high)))
        return {*low, *high};
    const double half = *low == 0 ? 1 : 0.1 * std::abs(*low);
    return {*low - half, *high + half};
}

} // namespace whirl::report

#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::MotionSeries;
using results::SimulateResult;

namespace {

constexpr std::size_t most_motions = 16;

std::vector<NamedCurve> amplitude_curves(const Units &units, const SimulateResult &result) {
    std::vector<NamedCurve> curves;
    const std::vector<double> &time = result.series.time;
    const double factor = units.factor(Quantity::amplitude);
    const auto after_rest = [&](const std::vector<double> &amplitude) {
        std::vector<PlotPoint> points = points_over(time, 1, amplitude, factor);
        points.erase(points.begin(), points.begin() + (points.empty() ? 0 : 1));
        return points; // at rest there is nothing to draw
    };
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        curves.push_back({place_text(units, result.balancers[i].name, result.balancers[i].z),
                          after_rest(result.series.amplitude[i])});
    for (std::size_t i = 0; i < result.other_starts.size(); ++i)
        curves.push_back({fmt::format("start {}: {}", i + 2,
                                      results::outcome_name(result.other_starts[i].outcome)),
                          after_rest(result.other_starts[i].amplitude)});
    for (const results::BalancerMotion &b : result.balancers)
        if (b.reference > 0 && !time.empty())
            curves.push_back(
                {result.balancers.size() > 1 ? "without balls, " + place_text(units, b.name, b.z)
                                             : "without balls",
                 {{time.front(), b.reference * factor}, {time.back(), b.reference * factor}}});
    return curves;
}

/// Mean speed between output times over that of the rotor.
std::vector<PlotPoint> relative_speed(const MotionSeries &series,
                                      const std::vector<double> &angles) {
    std::vector<PlotPoint> points;
    for (std::size_t k = 1; k < series.time.size(); ++k) {
        const double span = series.time[k] - series.time[k - 1];
        const double speed = series.speed[k];
        if (speed != 0)
            points.push_back({series.time[k], 1 + (angles[k] - angles[k - 1]) / (span * speed)});
    }
    return points;
}

std::string draw(const std::vector<NamedCurve> &curves, std::size_t solid) {
    Curves drawn;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        LineStyle style = series_style(i < solid ? i : i - solid);
        style.dash = i < solid ? "1" : "(3,4)";
        drawn.add(curves[i].points, line_look(style, i < solid ? 1.4 : 1),
                  plot_text(curves[i].name));
    }
    return drawn.script();
}

std::string decades_axis(const std::vector<NamedCurve> &curves) {
    double high = 0;
    double low = HUGE_VAL;
    for (const NamedCurve &curve : curves)
        for (const PlotPoint &point : curve.points)
            if (point.y && *point.y > 0) {
                high = std::max(high, *point.y);
                low = std::min(low, *point.y);
            }
    if (high <= 0)
        high = low = 1;
    low = std::max(low, 1e-6 * high);
    return logarithmic_y + fmt::format("set yrange [{}:{}]\n",
                                       std::pow(10, std::floor(std::log10(low))),
                                       std::pow(10, std::floor(std::log10(high)) + 1));
}

} // namespace

std::vector<NamedCurve> angle_curves(const SimulateResult &result, std::size_t most) {
    const bool lagging = result.outcome == results::Outcome::lagging;
    std::vector<NamedCurve> curves;
    std::size_t number = 0;
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        for (std::size_t j = 0; j < result.balancers[i].angles.size(); ++j, ++number) {
            const std::vector<double> &angles = result.series.angles[number];
            const results::BalancerMotion &balancer = result.balancers[i];
            const std::string of =
                balancer.name.empty() ? "balancer " + std::to_string(i + 1) : balancer.name;
            const std::string name =
                balancer.coordinates.at(j) + (result.balancers.size() > 1 ? ", " + of : "");
            if (curves.size() < most)
                curves.push_back({name, lagging ? relative_speed(result.series, angles)
                                                : angles_over(result.series.time, 1, angles)});
        }
    return curves;
}

Figure simulate_figure(const model::Case &scene, const SimulateResult &result, const Units &units) {
    const std::vector<NamedCurve> amplitude = amplitude_curves(units, result);
    const std::vector<double> &speed = result.series.speed;
    const bool constant = std::all_of(speed.begin(), speed.end(),
                                      [&](double value) { return value == speed.front(); });
    const bool lagging = result.outcome == results::Outcome::lagging;
    const std::vector<NamedCurve> angles = angle_curves(result, most_motions);
    std::vector<std::string> names;
    for (const std::vector<NamedCurve> *list : {&amplitude, &angles})
        for (const NamedCurve &curve : *list)
            names.push_back(curve.name);
    const LegendedFigure room = beside_legend(864, 1080, constant ? 780 : 960, names);
    std::string panels =
        grid + fmt::format("set xrange [0:{}]\n", result.time) + decades_axis(amplitude) +
        room.panel(75, 400) +
        axes_beside_legend(units.label("Amplitude", Quantity::amplitude), "") +
        draw(amplitude, result.balancers.size() + result.other_starts.size()) + "unset label\n" +
        linear_y + (lagging ? "set yrange [*:*]\n" : "set yrange [-190:190]\nset ytics 90\n") +
        room.panel(430, 715) +
        axes_beside_legend(lagging ? "Ball speed / rotor speed"
                                   : units.label("Angle in the rotor", Quantity::angle),
                           constant ? units.label("Time", Quantity::time) : "") +
        draw(angles, most_motions);
    if (!constant)
        panels += operation_band(scene, units, speed_range(units, speed), SpeedAxis::y) +
                  "set yrange [*:*]\nset ytics auto\n" + room.panel(745, 895) +
                  axes_beside_legend(units.label("Speed", Quantity::speed),
                                     units.label("Time", Quantity::time)) +
                  draw({{"rotor",
                         points_over(result.series.time, 1, speed, units.factor(Quantity::speed))}},
                       1);
    return figure_of(room.width, room.height, "Motion in time: " + title_of(scene),
                     fmt::format("outcome: {}, at the end {}",
                                 results::outcome_name(result.outcome),
                                 drawn_value(units, Quantity::speed, result.speed)),
                     panels);
}

} // namespace whirl::report

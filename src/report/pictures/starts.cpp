#include "report/held_motions.h"
#include "report/pictures/figures.h"
#include "report/pictures/style.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

using results::ManyStarts;

Chart starts_chart(const model::Case &scene, const ManyStarts &starts, const Units &units) {
    const model::StartsSettings &settings = *scene.simulate.starts;
    const bool grid = !starts.grid.empty();
    const std::size_t first = grid ? static_cast<std::size_t>(settings.angles[0]) : 0;
    const std::size_t second = grid ? static_cast<std::size_t>(settings.angles[1]) : 1;
    const auto shown = [&units](double angle) {
        return units(Quantity::angle, std::remainder(angle, 2 * pi));
    };
    const auto axis = [&units](std::size_t angle) {
        ChartAxis out =
            chart_axis(units, fmt::format("Angle {} at the start", angle), Quantity::angle);
        out.high = units(Quantity::angle, pi);
        out.low = -*out.high;
        out.step = *out.high / 2;
        return out;
    };
    ChartPanel panel{600, axis(first), axis(second)};
    const double half = grid ? *panel.x.high / static_cast<double>(starts.grid.size()) : 0;
    for (std::size_t i = 0; i < starts.ends.size(); ++i) {
        ChartCurve cells = chart_curve(
            fmt::format("{}: {:.3g}", end_name(starts, starts.ends[i]), starts.ends[i].share), {},
            i, 0);
        cells.filled = grid;
        cells.marker = 1;
        for (const results::StartedMotion &start : starts.motions) {
            if (start.end != i)
                continue;
            const double x = shown(start.start_angles[first]);
            const double y = start.start_angles.size() > 1 ? shown(start.start_angles[second]) : 0;
            if (grid)
                add_part(cells.points,
                         chart_bar({x - half, x + half}, {y - half, y + half}, {}).points);
            else
                cells.points.push_back({x, y});
        }
        panel.curves.push_back(cells);
    }
    // Where the states themselves are; two equal balls in either order.
    const auto *balls = std::get_if<model::Balls>(&scene.rotor.balancers.front().parts);
    const bool equal = balls && balls->rows.size() == 1;
    ChartCurve at{"angles of the states", {}, {"", "#000000", "1", 2}, 0, 1.6};
    for (const results::MotionEnd &end : starts.ends)
        if (end.state && scene.rotor.balancers.size() == 1 &&
            starts.states->states[*end.state].angles.front().size() == 2) {
            const std::vector<double> &angles = starts.states->states[*end.state].angles.front();
            at.points.push_back({shown(angles[0]), shown(angles[1])});
            if (equal)
                at.points.push_back({shown(angles[1]), shown(angles[0])});
        }
    if (!at.points.empty())
        panel.curves.push_back(at);
    return {"Where motions end: " + title_of(scene),
            fmt::format("{} starts; shares of the motions", starts.motions.size()),
            {panel}};
}

} // namespace whirl::report

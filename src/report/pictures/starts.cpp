#include "report/held_motions.h"
#include "report/pictures/figures.h"
#include "report/pictures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::ManyStarts;

Figure starts_figure(const model::Case &scene, const ManyStarts &starts, const Units &units) {
    constexpr int height = 760;
    const model::StartsSettings &settings = *scene.simulate.starts;
    const bool grid = !starts.grid.empty();
    const std::size_t first = grid ? static_cast<std::size_t>(settings.angles[0]) : 0;
    const std::size_t second = grid ? static_cast<std::size_t>(settings.angles[1]) : 1;
    const auto shown = [&units](double angle) {
        return units(Quantity::angle, std::remainder(angle, 2 * pi));
    };
    std::vector<std::vector<PlotPoint>> cells(starts.ends.size());
    for (const results::StartedMotion &start : starts.motions)
        if (start.end)
            cells[*start.end].push_back(
                {shown(start.start_angles[first]),
                 start.start_angles.size() > 1 ? shown(start.start_angles[second]) : 0});
    Curves curves;
    std::vector<std::string> names{"angles of that state"};
    const double half =
        grid ? units(Quantity::angle, pi) / static_cast<double>(starts.grid.size()) : 0;
    for (std::size_t i = 0; i < starts.ends.size(); ++i) {
        const LineStyle style = series_style(i);
        names.push_back(
            fmt::format("{}: {:.3g}", end_name(starts, starts.ends[i]), starts.ends[i].share));
        curves.add(
            cells[i],
            grid ? fmt::format("using 1:2:({0}):({0}) with boxxyerror fillstyle solid 0.75 "
                               "noborder lc rgb '{1}'",
                               half, style.colour)
                 : fmt::format("with points pt {} ps 1 lc rgb '{}'", style.point, style.colour),
            plot_text(names.back()));
    }
    // Where the states themselves are; two equal balls in either order.
    const auto *balls = std::get_if<model::Balls>(&scene.rotor.balancers.front().parts);
    const bool equal = balls && balls->rows.size() == 1;
    std::vector<PlotPoint> at;
    for (const results::MotionEnd &end : starts.ends)
        if (end.state && scene.rotor.balancers.size() == 1 &&
            starts.states->states[*end.state].angles.front().size() == 2) {
            const std::vector<double> &angles = starts.states->states[*end.state].angles.front();
            at.push_back({shown(angles[0]), shown(angles[1])});
            if (equal)
                at.push_back({shown(angles[1]), shown(angles[0])});
        }
    if (!at.empty())
        curves.add(at, "with points pt 2 ps 1.6 lw 2.4 lc rgb '#000000'", "'angles of the states'");
    const LegendedFigure figure = beside_legend(760, 1080, height, names);
    const double edge = units(Quantity::angle, pi);
    const std::string panel =
        figure.panel(100, height - 70) + linear_y +
        fmt::format("set xrange [{0}:{1}]\nset yrange [{0}:{1}]\nset xtics {2}\nset ytics {2}\n",
                    -edge, edge, edge / 2) +
        axes_beside_legend(
            units.label(fmt::format("Angle {} at the start", second), Quantity::angle),
            units.label(fmt::format("Angle {} at the start", first), Quantity::angle)) +
        curves.script();
    return figure_of(figure.width, height, "Where motions end: " + title_of(scene),
                     fmt::format("{} starts; shares of the motions", starts.motions.size()), panel);
}

} // namespace whirl::report

#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/limit_cycle.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::FoundCycle;
using results::LimitCycle;

namespace {

double largest_in(const LimitCycle &cycle) { return std::ranges::max(cycle.largest); }
double least_in(const LimitCycle &cycle) { return std::ranges::min(cycle.least); }

/// Pieces of a branch between changes of stability, of which the points belong to both sides.
/// @param stable  which are asked for
std::vector<std::vector<PlotPoint>> pieces_of(const std::vector<LimitCycle> &branch,
                                              std::optional<bool> stable,
                                              double (*amplitude)(const LimitCycle &),
                                              const Units &units) {
    // A fold or a border is neither: it is an end of the pieces beside it.
    const auto looks = [&branch](std::size_t i) {
        if (!branch[i].kind.empty())
            return branch[i - (i > 0 ? 1 : 0)].stable;
        return branch[i].stable;
    };
    std::vector<std::vector<PlotPoint>> out;
    for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
        const std::optional<bool> look = branch[i].kind.empty() ? looks(i) : branch[i + 1].stable;
        if (look != stable)
            continue;
        out.emplace_back();
        for (const std::size_t k : {i, i + 1})
            out.back().push_back({units(Quantity::speed, branch[k].speed),
                                  units(Quantity::amplitude, amplitude(branch[k]))});
    }
    return out;
}

} // namespace

Figure cycle_figure(const model::Case &scene, const FoundCycle &found, const Units &units) {
    constexpr int height = 560;
    constexpr const char *upper = "#0072B2";
    constexpr const char *lower = "#7A5200";
    Curves curves;
    std::vector<std::string> names;
    for (const std::optional<bool> stable :
         {std::optional(true), std::optional(false), std::optional<bool>()})
        for (const auto &[amplitude, colour, what] :
             {std::tuple(&largest_in, upper, "largest"), std::tuple(&least_in, lower, "least")}) {
            const auto pieces = pieces_of(found.branch, stable, amplitude, units);
            if (pieces.empty())
                continue;
            names.push_back(fmt::format("{} over a period, {}", what,
                                        !stable   ? "neither"
                                        : *stable ? "stable"
                                                  : "unstable"));
            curves.add_pieces(pieces, stability_look(stable, colour));
            curves.add(fmt::format("NaN {} title {}", stability_look(stable, colour),
                                   plot_text(names.back())));
        }
    const auto mark = [&](const auto &which, int point, const std::string &name) {
        std::vector<PlotPoint> at;
        for (const LimitCycle &cycle : found.branch)
            if (which(cycle))
                at.push_back({units(Quantity::speed, cycle.speed),
                              units(Quantity::amplitude, largest_in(cycle))});
        if (at.empty())
            return;
        names.push_back(name);
        curves.add(at, fmt::format("with points pt {} ps 1.4 lw 1.6 lc rgb '#222222'", point),
                   plot_text(name));
    };
    mark([](const LimitCycle &cycle) { return cycle.kind == "fold"; }, 8, "fold");
    mark([](const LimitCycle &cycle) { return cycle.kind == "border"; }, 12, "border of stability");
    mark(
        [&found](const LimitCycle &cycle) {
            return cycle.speed == found.cycle.speed && cycle.period == found.cycle.period;
        },
        7, "next to the motion in time");
    double top = 0;
    std::vector<double> speeds;
    for (const LimitCycle &cycle : found.branch) {
        top = std::max(top, units(Quantity::amplitude, largest_in(cycle)));
        speeds.push_back(cycle.speed);
    }
    std::ranges::sort(speeds);
    const LegendedFigure figure = beside_legend(900, 1200, height, names);
    const Range x = speed_range(units, speeds);
    curves.add(operation_key(scene, units, x));
    const std::string panel =
        figure.panel(100, height - 70) + operation_band(scene, units, x) + grid + linear_y +
        fmt::format("set xrange [{}:{}]\nset yrange [0:{}]\n", x.low, x.high, 1.06 * top) +
        axes_beside_legend(units.label("Amplitude of a plane", Quantity::amplitude),
                           units.label("Spin speed", Quantity::speed)) +
        curves.script() + "unset object\nunset arrow\n";
    return figure_of(figure.width, height, "Limit cycles: " + title_of(scene),
                     "largest and least amplitude over a period; solid: stable, dashed: unstable, "
                     "dotted: neither",
                     panel);
}

} // namespace whirl::report

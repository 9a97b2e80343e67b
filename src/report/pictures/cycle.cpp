#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/limit_cycle.h"

#include <algorithm>

namespace whirl::report {

using results::FoundCycle;
using results::LimitCycle;

namespace {

double largest_in(const LimitCycle &cycle) { return std::ranges::max(cycle.largest); }
double least_in(const LimitCycle &cycle) { return std::ranges::min(cycle.least); }

/// Between the i-th cycle of a branch and the next. A fold or a border is neither stable nor
/// unstable: it is an end of the pieces beside it.
std::optional<bool> stable_after(const std::vector<LimitCycle> &branch, std::size_t i) {
    return branch[!branch[i].kind.empty() ? i + 1 : i].stable;
}

} // namespace

Chart cycle_chart(const model::Case &scene, const FoundCycle &found, const Units &units) {
    const std::vector<LimitCycle> &branch = found.branch;
    std::vector<double> speeds;
    for (const LimitCycle &cycle : branch)
        speeds.push_back(cycle.speed);
    ChartPanel panel{390, along_speeds(units, speeds),
                     chart_axis(units, "Amplitude of a plane", Quantity::amplitude)};
    panel.y.low = 0;
    const auto at = [&units](const LimitCycle &cycle, const auto &amplitude) {
        return PlotPoint{units(Quantity::speed, cycle.speed),
                         units(Quantity::amplitude, amplitude(cycle))};
    };
    for (const std::optional<bool> stable : stabilities)
        for (const auto &[amplitude, colour, what] :
             {std::tuple(&largest_in, "#0072B2", "largest over a period"),
              std::tuple(&least_in, "#7A5200", "least over a period")}) {
            ChartCurve curve = branch_curve(what, stable, colour);
            for (std::size_t i = 0; i + 1 < branch.size(); ++i)
                if (stable_after(branch, i) == stable)
                    add_piece(curve.points, at(branch[i], amplitude), at(branch[i + 1], amplitude));
            if (!curve.points.empty())
                panel.curves.push_back(curve);
        }
    const auto mark = [&](const auto &which, int point, const std::string &name) {
        std::vector<PlotPoint> points;
        for (const LimitCycle &cycle : branch)
            if (which(cycle))
                points.push_back(at(cycle, largest_in));
        add_marks(panel, name, point, std::move(points));
    };
    mark([](const LimitCycle &cycle) { return cycle.kind == "fold"; }, 8, "fold");
    mark([](const LimitCycle &cycle) { return cycle.kind == "border"; }, 12, "border of stability");
    mark(
        [&found](const LimitCycle &cycle) {
            return cycle.speed == found.cycle.speed && cycle.period == found.cycle.period;
        },
        7, "next to the motion in time");
    double top = 0;
    for (const LimitCycle &cycle : branch)
        top = std::max(top, units(Quantity::amplitude, largest_in(cycle)));
    panel.y.high = 1.06 * top;
    return {"Limit cycles: " + title_of(scene),
            "largest and least amplitude over a period; solid: stable, dashed: unstable, dotted: "
            "neither",
            {panel}};
}

} // namespace whirl::report

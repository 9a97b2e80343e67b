#include "modes/following/winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::modes {

namespace {

struct Arc {
    double from, to, phase_from, phase_to;
};

std::vector<Arc> first_arcs(const Phases &phases, const CircleWay &way) {
    std::vector<double> ends;
    for (int k = 0; k < way.arcs + (way.closed ? 0 : 1); ++k)
        ends.push_back(way.start + way.length * k / way.arcs);
    std::vector<double> there = phases(ends);
    if (way.closed) {
        ends.push_back(way.start + way.length);
        there.push_back(there.front());
    }
    std::vector<Arc> out;
    for (std::size_t k = 1; k < ends.size(); ++k)
        out.push_back({ends[k - 1], ends[k], there[k - 1], there[k]});
    return out;
}

} // namespace

std::optional<double> winding(const Phases &phases, const CircleWay &way) {
    constexpr double slow = 0.9; // an arc over which the phase turns by more is halved
    constexpr double shortest = 1e-6;
    double sum = 0;
    std::vector<Arc> arcs = first_arcs(phases, way);
    for (;;) {
        std::vector<Arc> open;
        std::vector<double> middles;
        for (const Arc &arc : arcs) {
            const double change =
                std::remainder(arc.phase_to - arc.phase_from, 2 * std::numbers::pi);
            if (std::abs(change) <= slow) {
                sum += change;
                continue;
            }
            if (!(arc.to - arc.from >= shortest))
                return std::nullopt;
            open.push_back(arc);
            middles.push_back((arc.from + arc.to) / 2);
        }
        if (open.empty())
            return sum;
        const std::vector<double> there = phases(middles);
        arcs.clear();
        for (std::size_t k = 0; k < open.size(); ++k) {
            arcs.push_back({open[k].from, middles[k], open[k].phase_from, there[k]});
            arcs.push_back({middles[k], open[k].to, there[k], open[k].phase_to});
        }
    }
}

double circle_of_known(const std::vector<double> &sizes, double all_in, double near) {
    // Two zeros of the other that far out, of which one goes into the circle and the other one
    // outward, turn an arc of 2 pi / 24 by less than 2 pi - 1.
    constexpr double beyond = 1.15;
    constexpr double away = 1.005;
    double radius = std::min(near, all_in / beyond);
    for (bool moved = true; std::exchange(moved, false);)
        for (const double size : sizes)
            if (size < away * radius && radius < away * size) {
                radius = size / away / away;
                moved = true;
            }
    return radius;
}

} // namespace whirl::modes

#include "modes/following/winding.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::modes {

std::optional<double> winding(const std::function<double(double angle)> &phase,
                              const CircleWay &way) {
    constexpr double slow = 0.9; // an arc over which the phase turns by more is halved
    constexpr double shortest = 1e-6;
    struct Arc {
        double from, to, phase_from, phase_to;
    };
    std::vector<Arc> open;
    const double first = phase(way.start);
    double last = first;
    for (int arc = 0; arc < way.arcs; ++arc) {
        const double end = way.start + way.length * (arc + 1) / way.arcs;
        const double there = arc + 1 == way.arcs && way.closed ? first : phase(end);
        open.push_back({way.start + way.length * arc / way.arcs, end, last, there});
        last = there;
    }
    double sum = 0;
    while (!open.empty()) {
        const Arc arc = open.back();
        open.pop_back();
        const double change = std::remainder(arc.phase_to - arc.phase_from, 2 * std::numbers::pi);
        if (std::abs(change) <= slow) {
            sum += change;
            continue;
        }
        if (arc.to - arc.from < shortest)
            return std::nullopt;
        const double middle = (arc.from + arc.to) / 2;
        const double there = phase(middle);
        open.push_back({arc.from, middle, arc.phase_from, there});
        open.push_back({middle, arc.to, there, arc.phase_to});
    }
    return sum;
}

} // namespace whirl::modes

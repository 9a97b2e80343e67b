#include "tracking/followed_crossings.h"

#include "tracking/crossing_search.h"
#include "tracking/crossing_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::tracking {

namespace {

using Asked = modes::SpectrumSolver::MotionAt;
using Motion = modes::SpectrumSolver::Motion;

/// A crossing while it is looked for.
struct Search {
    FollowedCrossing found;
    int followed;
    double low, high; ///< the step, rad/s
    bool settled = false, lost = false;
};

/// Whether the distance changes its sign between the ends, well inside of the step, and both slopes
/// and the secant are much alike: it does not turn back.
bool plain(const StepEnd &a, const StepEnd &b) {
    const double secant = (b.distance - a.distance) / (b.speed - a.speed);
    const auto like = [secant](double slope) { // not of what is not a number
        return slope / secant > 0.5 && slope / secant < 2;
    };
    return std::abs(a.distance) > 1e3 * a.tolerance && std::abs(b.distance) > 1e3 * b.tolerance &&
           (a.distance > 0) != (b.distance > 0) && like(a.slope) && like(b.slope);
}

std::optional<Search> search_of(const SweepNodes &nodes, std::size_t k, const Link &link,
                                double multiple) {
    const modes::Spectrum &here = nodes.spectrum(k);
    const modes::Spectrum &next = nodes.spectrum(k + 1);
    const modes::WhirlMode &mode = here.modes[link.from];
    const modes::WhirlMode &later = next.modes[link.to];
    const bool one_motion = mode.followed >= 0 && mode.followed == later.followed &&
                            mode.eigenvalue.imag() != 0 && later.eigenvalue.imag() != 0;
    if (!one_motion || here.speed * next.speed <= 0)
        return std::nullopt;
    const StepEnd a = end_of(here, nodes.rates(k).above, link.from, multiple);
    const StepEnd b = end_of(next, nodes.rates(k + 1).below, link.to, multiple);
    if (!plain(a, b))
        return std::nullopt;
    const double share = a.distance / (a.distance - b.distance);
    return Search{
        {k, link.line, a.speed + share * (b.speed - a.speed), 0}, mode.followed, a.speed, b.speed};
}

/// One step of Newton's method; the last one is that from a distance of zero.
void advance(Search &search, const std::optional<Motion> &motion, double multiple) {
    if (!motion) {
        search.lost = true;
        return;
    }
    const double speed = search.found.speed;
    const double target = multiple * std::abs(speed);
    const double distance = motion->eigenvalue.imag() - target;
    const double slope = motion->rate.imag() - (std::signbit(speed) ? -multiple : multiple);
    search.found.speed -= distance / slope;
    search.found.real = motion->eigenvalue.real();
    search.settled = std::abs(distance) <= resolved * target &&
                     std::abs(search.found.speed - speed) < 1e3 * resolved * std::abs(speed);
    search.lost = !(search.found.speed > search.low && search.found.speed < search.high);
}

} // namespace

std::vector<FollowedCrossing> followed_crossings(const SweepNodes &nodes, double multiple) {
    constexpr int most_steps = 8;
    std::vector<FollowedCrossing> out;
    if (!nodes.solver().follows())
        return out;
    std::vector<Search> open;
    for (std::size_t k = 0; k + 1 < nodes.count(); ++k)
        for (const Link &link : nodes.links(k))
            if (const std::optional<Search> search = search_of(nodes, k, link, multiple))
                open.push_back(*search);
    for (int step = 0; step < most_steps && !open.empty(); ++step) {
        std::vector<Asked> asked;
        for (const Search &search : open)
            asked.push_back({search.found.speed, search.followed});
        const auto motions = nodes.solver().followed(asked);
        for (std::size_t i = 0; i < open.size(); ++i)
            advance(open[i], motions[i], multiple);
        for (const Search &search : open)
            if (search.settled && !search.lost)
                out.push_back(search.found);
        std::erase_if(open, [](const Search &search) { return search.settled || search.lost; });
    }
    return out;
}

} // namespace whirl::tracking

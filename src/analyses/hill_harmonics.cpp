#include "analyses/hill_harmonics.h"

#include "analyses/motions.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::analyses {

namespace {

constexpr int most_harmonics = 8;
constexpr double settled = 1e-8;

/// Largest distance, over the speed, of the motions below the speed to the nearest of the others.
double largest_distance(const std::vector<Motion> &some, const std::vector<Motion> &others,
                        double speed) {
    double worst = 0;
    int looked_at = 0;
    for (const Motion &motion : some) {
        if (std::abs(motion.value) > speed)
            continue;
        ++looked_at;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Motion &other : others)
            nearest = std::min(nearest, std::abs(other.value - motion.value));
        worst = std::max(worst, nearest / speed);
    }
    // Every motion has a copy below the speed, if the series reaches so far.
    return looked_at > 0 ? worst : 1;
}

/// A series too short shows some motions and not others: both ways, and the growth itself.
double change(const std::vector<Motion> &before, const std::vector<Motion> &after, double speed) {
    const double growth = std::abs(growth_of(before) - growth_of(after)) / speed;
    return std::max(
        {largest_distance(before, after, speed), largest_distance(after, before, speed), growth});
}

/// The slowest, a middle and the fastest speed that are not zero.
std::vector<double> probes_of(const std::vector<double> &speeds) {
    std::vector<double> probes;
    for (const double speed : speeds)
        if (speed != 0)
            probes.push_back(std::abs(speed));
    std::sort(probes.begin(), probes.end());
    if (probes.size() > 3)
        probes = {probes.front(), probes[probes.size() / 2], probes.back()};
    return probes;
}

} // namespace

int settled_harmonics(const model::Rotor &rotor, int order, const Arrangement &arrangement,
                      const std::vector<double> &speeds) {
    const std::vector<double> probes = probes_of(speeds);
    if (probes.empty())
        return 1; // at rest the terms of the series do not see each other
    double worst = 0;
    std::vector<std::vector<Motion>> last;
    for (int N = 1; N <= most_harmonics; ++N) {
        const MotionSolver solver(rotor, Form::hill, order, arrangement, N);
        std::vector<std::vector<Motion>> now;
        worst = last.empty() ? 1 : 0;
        for (std::size_t i = 0; i < probes.size(); ++i) {
            now.push_back(solver.at(probes[i]));
            if (!last.empty())
                worst = std::max(worst, change(last[i], now[i], probes[i]));
        }
        if (worst < settled)
            return N - 1;
        last = std::move(now);
    }
    throw model::AnalysisFailure(fmt::format(
        "the Hill series does not settle: with {} harmonics eigenvalues still change by {:.1e} of "
        "the spin speed; the range of speeds may start too low (harmonics lie 2 x speed apart), or "
        "the bearings differ too much between their directions",
        most_harmonics, worst));
}

} // namespace whirl::analyses

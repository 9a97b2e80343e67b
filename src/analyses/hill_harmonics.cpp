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

/// What one more harmonic changes. Motions seen before must stay where they are; new ones are
/// welcome (fast motions, whose copies begin to reach below the speed), if they do not grow.
double change(const std::vector<Motion> &before, const std::vector<Motion> &after, double speed) {
    const double grew = std::max(0.0, growth_of(before));
    const double grows = std::max(0.0, growth_of(after));
    return std::max(largest_distance(before, after, speed), std::abs(grew - grows) / speed);
}

/// Harmonics that are enough at all of these speeds; 0: none up to the most that are tried.
int enough_harmonics(const model::Rotor &rotor, int order, const Arrangement &arrangement,
                     const std::vector<double> &probes, double &worst) {
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
    return 0;
}

/// A series that cannot even be solved at these speeds is not enough either.
int enough_or_none(const model::Rotor &rotor, int order, const Arrangement &arrangement,
                   const std::vector<double> &probes, double &worst) {
    try {
        return enough_harmonics(rotor, order, arrangement, probes, worst);
    } catch (const model::AnalysisFailure &) {
        return 0;
    }
}

} // namespace

HillSeries settled_series(const model::Rotor &rotor, int order, const Arrangement &arrangement,
                          const std::vector<double> &speeds) {
    std::vector<double> moduli;
    for (const double speed : speeds)
        if (speed != 0)
            moduli.push_back(std::abs(speed));
    std::sort(moduli.begin(), moduli.end());
    if (moduli.empty())
        return {1, 0}; // at rest the terms of the series do not see each other
    double worst = 0;
    for (std::size_t first = 0; first < moduli.size();) {
        const std::size_t middle = (first + moduli.size()) / 2;
        std::vector<double> probes{moduli[first], moduli[middle], moduli.back()};
        probes.erase(std::unique(probes.begin(), probes.end()), probes.end());
        if (const int N = enough_or_none(rotor, order, arrangement, probes, worst))
            return {N, first == 0 ? 0 : moduli[first]};
        // The next rung: twice as fast.
        const double faster = 2 * moduli[first];
        if (moduli[first] == moduli.back())
            break;
        while (first + 1 < moduli.size() && moduli[first] < faster)
            ++first;
    }
    throw model::AnalysisFailure(fmt::format(
        "the Hill series does not settle: with {} harmonics eigenvalues still change by {:.1e} of "
        "the spin speed; the range of speeds may lie too low (harmonics lie 2 x speed apart), or "
        "the bearings differ too much between their directions",
        most_harmonics, worst));
}

} // namespace whirl::analyses

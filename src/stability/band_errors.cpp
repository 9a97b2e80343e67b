#include "stability/band_errors.h"

#include "mesh_error/safety.h"
#include "periodic/whole_root.h"
#include "stability/periodic_motions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace whirl::stability {

namespace {

/// One end of a band: where it is, which way the band lies, and how far it and what lies beyond
/// reach.
struct End {
    double speed = 0;
    double inward = 1; ///< sign
    double width = 0;  ///< of the band, rad/s
    double beyond = 0; ///< distance to the next band or to the border of the range, rad/s
};

/// How far the end can lie from where the growth rises out of its noise.
double blurred(const BandFinder &finder, const End &end, double &slope) {
    const double step = std::min(0.25 * end.width, 1e-4 * std::abs(end.speed));
    const Motion inside = fastest_growing(finder.at(end.speed + end.inward * step));
    slope = std::max(inside.value.real(), 0.0) / step;
    return slope > 0 ? std::min(step, inside.noise / slope) : step;
}

/// Distance to the end in the finer model; the width where it has no band there.
double distance(const MotionsAt &finer, const End &end, double slope) {
    const auto unstable = [&](double speed) { return growth_of(finer(speed)) > 0; };
    const bool here = unstable(end.speed);
    const double sign = here ? -end.inward : end.inward;
    const double most = here ? end.beyond : 0.999 * end.width;
    const double least = 1e-11 * std::abs(end.speed);
    const double growth = std::abs(fastest_growing(finer(end.speed)).value.real());
    double inner = 0; // known to be as here
    double step =
        std::clamp(slope > 0 ? 1.5 * growth / slope : least, least, std::max(most, least));
    while (true) {
        const double speed = end.speed + sign * step;
        if (unstable(speed) != here) {
            const double as_here = end.speed + sign * inner;
            const double found = here ? band_end(finer, speed, as_here, 0.03 * step)
                                      : band_end(finer, as_here, speed, 0.03 * step);
            return std::abs(found - end.speed) + 0.03 * step;
        }
        if (step >= most)
            return here ? end.beyond : end.width;
        inner = step;
        step = std::min(most, 8 * step);
    }
}

/// How far from it the finer model's end can lie without being another one.
double reach_of(const End &end) { return std::min(end.width, end.beyond) / 4; }

/// Error of an end at which the growth passes zero with a slope, from the roots of both models;
/// nothing where it is not one.
std::optional<double> by_roots(const PeriodicMotions &motions, const periodic::WholeRotor &finer,
                               const End &end) {
    const double reach = reach_of(end);
    const auto own = motions.neutral_next_to(end.speed, reach);
    if (!own || own->slope * end.inward <= 0 ||
        std::abs(own->speed - end.speed) > 1e-9 * std::abs(end.speed))
        return std::nullopt;
    const auto other = motions.neutral_next_to(end.speed, reach, &finer);
    if (!other || other->slope * end.inward <= 0)
        return std::nullopt;
    const double step = std::min(0.25 * end.width, 1e-4 * std::abs(end.speed));
    const double noise = motions.fastest_growing(end.speed).motion.noise / std::abs(own->slope);
    return std::min(step, noise + other->noise) + 1e-12 * std::abs(end.speed) +
           mesh_error::estimate_safety * std::abs(other->speed - end.speed);
}

} // namespace

std::vector<results::EndErrors> band_errors(const BandFinder &finder,
                                            const std::vector<results::Interval> &bands,
                                            const results::Interval &range,
                                            const ErrorByRoot &by_root) {
    const StabilityModel &model = finder.model();
    const bool elastic = !model.rotor.shaft.rigid;
    const PeriodicMotions *const periodic = finder.solver().by_monodromy();
    StabilityModel finer_model = model;
    finer_model.order = mesh_error::finer_order(model.order);
    std::optional<OwnWholeRotor> whole;
    if (elastic && periodic != nullptr && model.rotor.damped() && !bands.empty())
        whole.emplace(finer_model, finder.arrangement());
    std::optional<MotionSolver> finer;
    std::map<double, std::vector<Motion>> known; // of the finer model: the same speeds come again
    const MotionsAt finer_at = [&](double speed) {
        if (const auto found = known.find(speed); found != known.end())
            return found->second;
        if (!finer)
            finer.emplace(finer_model, finder.arrangement());
        return known.emplace(speed, finer->at(speed)).first->second;
    };
    const auto error_of = [&](const End &end) {
        if (whole)
            if (const auto error = by_roots(*periodic, whole->rotor, end))
                return *error;
        if (elastic)
            if (const auto error = by_root(end.speed, end.inward, reach_of(end)))
                return *error;
        double slope = 0;
        const double rounding = blurred(finder, end, slope);
        return rounding + 1e-12 * std::abs(end.speed) +
               (elastic ? mesh_error::estimate_safety * distance(finer_at, end, slope) : 0.0);
    };
    std::vector<results::EndErrors> out;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const auto &[from, to] = bands[i];
        const double below = i > 0 ? bands[i - 1].to : range.from;
        const double above = i + 1 < bands.size() ? bands[i + 1].from : range.to;
        out.emplace_back(from > range.from ? error_of({from, 1, to - from, from - below}) : 0.0,
                         to < range.to ? error_of({to, -1, to - from, above - to}) : 0.0);
    }
    return out;
}

} // namespace whirl::stability

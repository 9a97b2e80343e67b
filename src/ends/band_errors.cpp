#include "ends/band_errors.h"

#include "ends/finer_ends.h"
#include "ends/growth.h"
#include "mesh_error/safety.h"
#include "periodic/whole_root.h"
#include "stability/hill/periodic_motions.h"
#include "stability/unstable_bands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace whirl::ends {

namespace {

/// One end of a band: where it is, which way the band lies, and how far it and what lies beyond
/// reach.
struct End {
    double speed = 0;
    double inward = 1; ///< sign
    double width = 0;  ///< of the band, rad/s
    double beyond = 0; ///< distance to the next band or to the border of the range, rad/s
};

/// Of the motion that grows most, 1/s.
struct Grown {
    double growth = 0;
    double noise = 0;
};

/// How far the end can lie from where the growth rises out of its noise.
/// @param growth  of the rotor itself, over the speed
double blurred(const std::function<Grown(double speed)> &growth, const End &end, double &slope) {
    const double step = std::min(0.25 * end.width, 1e-4 * std::abs(end.speed));
    const Grown inside = growth(end.speed + end.inward * step);
    slope = std::max(inside.growth, 0.0) / step;
    return slope > 0 ? std::min(step, inside.noise / slope) : step;
}

/// Distance to the end in the finer model; the width where it has no band there.
double distance(const Growth &finer, const End &end, double slope) {
    const double growth = finer.at(end.speed);
    const bool here = growth > 0;
    const double sign = here ? -end.inward : end.inward;
    const double most = here ? end.beyond : 0.999 * end.width;
    const double least = 1e-11 * std::abs(end.speed);
    double inner = 0; // known to be as here
    double step = std::clamp(slope > 0 ? 1.5 * std::abs(growth) / slope : least, least,
                             std::max(most, least));
    while (true) {
        const double speed = end.speed + sign * step;
        if ((finer.at(speed) > 0) != here) {
            const double as_here = end.speed + sign * inner;
            const double found = stability::border_of_growth(
                [&finer](double at) { return finer.at(at); }, here ? speed : as_here,
                here ? as_here : speed, 0.03 * step);
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
std::optional<double> by_roots(const stability::PeriodicMotions &motions,
                               const periodic::WholeRotor &finer, const End &end) {
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

std::vector<results::EndErrors> band_errors(const stability::BandFinder &finder,
                                            const std::vector<results::Interval> &bands,
                                            const results::Interval &range,
                                            const std::vector<EndOfGrowth> &roots) {
    const stability::StabilityModel &model = finder.model();
    const bool elastic = !model.rotor.shaft.rigid;
    stability::StabilityModel finer_model = model;
    finer_model.order = mesh_error::finer_order(model.order);
    const stability::PeriodicMotions *const periodic =
        finder.hill() != nullptr ? finder.hill()->by_monodromy() : nullptr;
    std::optional<stability::OwnWholeRotor> whole;
    if (elastic && periodic != nullptr && model.rotor.damped() && !bands.empty())
        whole.emplace(finer_model, finder.arrangement());
    std::optional<FinerEnds> finer_ends;
    const auto by_root = [&](const End &end) -> std::optional<double> {
        if (whole)
            return by_roots(*periodic, whole->rotor, end);
        const auto root = std::ranges::find(roots, end.speed, &EndOfGrowth::speed);
        if (root == roots.end())
            return std::nullopt;
        if (!elastic)
            return root->blur + 1e-12 * std::abs(end.speed);
        if (!finer_ends)
            finer_ends.emplace(finder.discretization(), model.form, finder.arrangement());
        return finer_ends->error(*root, end.inward, reach_of(end));
    };
    std::optional<Growth> own;
    std::optional<Growth> finer;
    const auto own_at = [&](double speed) -> Grown {
        if (finder.hill() != nullptr) {
            const auto motions = finder.at(speed);
            const stability::Motion &fastest = stability::fastest_growing(motions);
            return {fastest.value.real(), fastest.noise};
        }
        if (!own)
            own.emplace(model, finder.arrangement(), finder.shapes(), range);
        const FastestGrowing fastest = own->motions().fastest_growing(speed);
        return {fastest.value.real(), fastest.noise};
    };
    const auto error_of = [&](const End &end) {
        if (const auto error = by_root(end))
            return *error;
        double slope = 0;
        const double rounding = blurred(own_at, end, slope) + 1e-12 * std::abs(end.speed);
        if (!elastic)
            return rounding;
        if (!finer)
            finer.emplace(finer_model, finder.arrangement(), std::vector{range.from, range.to});
        return rounding + mesh_error::estimate_safety * distance(*finer, end, slope);
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

} // namespace whirl::ends

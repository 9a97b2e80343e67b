#include "results/formulation.h"
#include "results/margins.h"
#include "results/simulate.h"
#include "results/stability.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::results {

std::string form_name(Form form) {
    switch (form) {
    case Form::planar:
        return "planar";
    case Form::planar_damped:
        return "planar_damped";
    case Form::hyperbolic:
        return "hyperbolic";
    case Form::rotating:
        return "rotating";
    case Form::hill:
        return "hill";
    default:
        return "general";
    }
}

std::string frame_name(Form form) { return in_rotating_axes(form) ? form_name(form) : "fixed"; }

std::string unknowns_name(Form form) { return is_planar(form) ? "planar" : "real"; }

std::string whirl_name(Whirl whirl) {
    switch (whirl) {
    case Whirl::forward:
        return "forward";
    case Whirl::backward:
        return "backward";
    default:
        return "mixed";
    }
}

std::string end_kind_name(EndKind kind) {
    switch (kind) {
    case EndKind::zero:
        return "zero";
    case EndKind::pair:
        return "pair";
    case EndKind::collision:
        return "collision";
    default:
        return "multiplier";
    }
}

std::string margin_side_name(MarginSide side) {
    switch (side) {
    case MarginSide::below:
        return "below";
    case MarginSide::above:
        return "above";
    default:
        return "inside";
    }
}

std::string verdict_name(Verdict verdict) {
    switch (verdict) {
    case Verdict::stable:
        return "stable";
    case Verdict::neutral:
        return "neutral";
    case Verdict::unstable:
        return "unstable";
    case Verdict::diverges:
        return "diverges";
    default:
        return {};
    }
}

std::size_t largest_station(const std::vector<StationMotion> &stations) {
    constexpr double alike = 1e-9;
    double most = 0;
    for (const StationMotion &station : stations)
        most = std::max(most, station.peak.value);
    const double middle = (stations.front().z + stations.back().z) / 2;
    std::size_t best = stations.size();
    for (std::size_t i = 0; i < stations.size(); ++i)
        if (stations[i].peak.value >= (1 - alike) * most &&
            (best == stations.size() ||
             std::abs(stations[i].z - middle) < std::abs(stations[best].z - middle)))
            best = i;
    return best;
}

std::string outcome_name(Outcome outcome) {
    switch (outcome) {
    case Outcome::balanced:
        return "balanced";
    case Outcome::offset:
        return "offset";
    case Outcome::lagging:
        return "lagging";
    case Outcome::whirling:
        return "whirling";
    case Outcome::growing:
        return "growing";
    case Outcome::steady:
        return "steady";
    case Outcome::transient:
        return "transient";
    default:
        return "undecided";
    }
}

} // namespace whirl::results

#include "model/operation.h"
#include "results/balance.h"
#include "results/checks.h"
#include "results/enum_name.h"
#include "results/formulation.h"
#include "results/margins.h"
#include "results/operating.h"
#include "results/response.h"
#include "results/simulate.h"
#include "results/stability.h"
#include "results/steady_states.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace whirl::results {

Sentence place_in_words(const std::string &of, const std::string &name, double z, int digits) {
    return name.empty() ? Sentence("{} at z = {}", of, as::length(z, digits))
                        : Sentence("{} {}", of, name);
}

std::string form_name(Form form) {
    return enum_name(form,
                     {"planar", "planar_damped", "hyperbolic", "general", "rotating", "hill"});
}

std::string frame_name(Form form) { return in_rotating_axes(form) ? form_name(form) : "fixed"; }

std::string unknowns_name(Form form) { return is_planar(form) ? "planar" : "real"; }

std::string whirl_name(Whirl whirl) { return enum_name(whirl, {"forward", "backward", "mixed"}); }

std::string supply_name(Supply supply) {
    return enum_name(supply, {"balanced", "saturated", "beyond capacity", "criterion does not hold",
                              "balanced, unstable", "too coarse", "out of reach", "resonance",
                              "at rest", "not known"});
}

std::string end_kind_name(EndKind kind) {
    return enum_name(kind, {"zero", "pair", "collision", "multiplier"});
}

Sentence run_name(const StandardRun &run) {
    return run.fit == model::BearingFit::given
               ? Sentence("run {}", run.name)
               : Sentence("run {}, clearance {}", run.name, model::fit_name(run.fit));
}

std::string measure_name(Measure measure) {
    return enum_name(measure,
                     {"amplitude", "amplitude rms", "velocity", "velocity rms", "clearance share"});
}

model::Quantity measure_quantity(Measure measure) {
    switch (measure) {
    case Measure::amplitude:
        return model::Quantity::amplitude;
    case Measure::amplitude_rms:
        return model::Quantity::deflection; // never from peak to peak
    case Measure::velocity:
    case Measure::velocity_rms:
        return model::Quantity::velocity;
    case Measure::clearance_share:
        return model::Quantity::number;
    }
    return model::Quantity::number;
}

std::string judgement_name(Judgement judgement) {
    return enum_name(judgement, {"passes", "fails", "incomplete"});
}

std::optional<double> Check::margin() const {
    if (!value || !limit || !std::isfinite(*value) || !std::isfinite(*limit) || *limit == 0)
        return std::nullopt;
    return (at_least ? *value - *limit : *limit - *value) / std::abs(*limit);
}

std::string peak_kind_name(PeakKind kind) {
    return enum_name(kind, {"resonance", "heavily damped", "flank", "plateau"});
}

std::string margin_side_name(MarginSide side) {
    return enum_name(side, {"below", "inside", "above"});
}

std::string verdict_name(Verdict verdict) {
    return enum_name(verdict, {"stable", "neutral", "unstable", "diverges", ""});
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
    return enum_name(outcome, {"balanced", "offset", "lagging", "whirling", "growing", "steady",
                               "transient", "undecided"});
}

std::string steady_kind_name(SteadyState::Kind kind) {
    return enum_name(kind, {"balanced", "partly balanced", "coincident", "split", "swung",
                            "out of round", "at wall"});
}

std::string steady_border_name(SteadyBorder::Kind kind) {
    return enum_name(kind, {"fold", "limit", "zero", "pair", "undecided", "wall"});
}

} // namespace whirl::results

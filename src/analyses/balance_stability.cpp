#include "analyses/balance_stability.h"

#include "analyses/stability.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::analyses {

namespace {

/// What `bands`, ascending and apart, leave of the range.
std::vector<results::SpeedBand> rest_of(const std::vector<stability::SpeedInterval> &bands,
                                        double from, double to) {
    std::vector<results::SpeedBand> rest;
    double start = from;
    for (const stability::SpeedInterval &band : bands) {
        if (band.first > start)
            rest.push_back({start, band.first});
        start = std::max(start, band.second);
    }
    if (start < to)
        rest.push_back({start, to});
    return rest;
}

/// Arrangements looked at where the balls have a choice; each takes a search of its own.
constexpr int arrangements = 6;

/// Errors of the ends of `rest`: those of the ends of the unstable bands beside it.
std::vector<std::pair<double, double>> errors_of(const std::vector<results::SpeedBand> &rest,
                                                 const UnstableBands &unstable) {
    std::vector<std::pair<double, double>> out;
    for (const results::SpeedBand &band : rest) {
        out.emplace_back(0, 0); // at a border of the range
        for (std::size_t i = 0; i < unstable.bands.size(); ++i) {
            if (unstable.bands[i].second == band.from)
                out.back().first = unstable.errors[i].second;
            if (unstable.bands[i].first == band.to)
                out.back().second = unstable.errors[i].first;
        }
    }
    return out;
}

results::BalancedPosition stable_speeds(const stability::StabilityModel &model,
                                        const model::SpeedRange &range,
                                        std::vector<std::string> &notes) {
    const std::vector<double> grid = stability::search_speeds(range);
    const double from = range.from;
    const double to = range.to;
    results::BalancedPosition out;
    std::vector<stability::SpeedInterval> sometimes_unstable;
    std::vector<stability::SpeedInterval> always_unstable;
    for (const balancers::Arrangement &arrangement :
         balancers::sampled_arrangements(model.rotor, arrangements)) {
        const bool first = out.arrangements == 0;
        const UnstableBands unstable = unstable_bands_of(model, grid, arrangement, first);
        const std::vector<stability::SpeedInterval> bands = stability::joined(unstable.bands);
        if (first) {
            out.bands = rest_of(bands, from, to);
            out.errors = errors_of(out.bands, unstable);
            for (const auto &[a, b] : unstable.doubtful)
                notes.push_back(fmt::format(
                    "between {:.10g} and {:.10g} rad/s the motions about the balanced position "
                    "could not be followed: a narrow unstable band may be missing there",
                    a, b));
        }
        always_unstable = first ? bands : stability::common(always_unstable, bands);
        sometimes_unstable.insert(sometimes_unstable.end(), bands.begin(), bands.end());
        ++out.arrangements;
    }
    out.with_every = rest_of(stability::joined(sometimes_unstable), from, to);
    out.with_some = rest_of(always_unstable, from, to);
    return out;
}

} // namespace

JudgedPosition judged_position(const model::Case &scene, std::vector<std::string> &notes) {
    JudgedPosition out;
    try {
        const model::SpeedRange &range = model::required_speeds(scene);
        out.model = stability::stability_model(scene, stability::search_speeds(range));
        if (scene.balance.balanced_position)
            out.stable = stable_speeds(*out.model, range, notes);
    } catch (const model::BadInput &error) {
        notes.push_back(std::string("no balanced position to look at: ") + error.what());
    } catch (const model::AnalysisFailure &failure) {
        notes.push_back(std::string("the balanced position was not judged: ") + failure.what());
    }
    return out;
}

} // namespace whirl::analyses

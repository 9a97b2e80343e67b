#include "analyses/balance_tier_two.h"

#include "analyses/stability.h"
#include "model/errors.h"

#include <algorithm>

namespace whirl::analyses {

namespace {

/// What `bands`, ascending and apart, leave of the range.
std::vector<SpeedBand> rest_of(const std::vector<SpeedInterval> &bands, double from, double to) {
    std::vector<SpeedBand> rest;
    double start = from;
    for (const SpeedInterval &band : bands) {
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

BalancedPosition stable_speeds(const model::Case &scene) {
    const double from = scene.speeds->from;
    const double to = scene.speeds->to;
    BalancedPosition out;
    std::vector<SpeedInterval> sometimes_unstable;
    std::vector<SpeedInterval> always_unstable;
    for (const Arrangement &arrangement : sampled_arrangements(scene.rotor, arrangements)) {
        const std::vector<SpeedInterval> unstable =
            unstable_bands_of(scene, scene.rotor, arrangement);
        if (out.arrangements == 0)
            out.bands = rest_of(unstable, from, to);
        always_unstable = out.arrangements == 0 ? unstable : common(always_unstable, unstable);
        sometimes_unstable.insert(sometimes_unstable.end(), unstable.begin(), unstable.end());
        ++out.arrangements;
    }
    out.with_every = rest_of(joined(sometimes_unstable), from, to);
    out.with_some = rest_of(always_unstable, from, to);
    return out;
}

} // namespace

std::optional<BalancedPosition> balanced_position(const model::Case &scene,
                                                  std::vector<std::string> &notes) {
    if (!scene.balance.balanced_position || scene.rotor.balancers.empty() || !scene.speeds ||
        scene.speeds->count < 2)
        return std::nullopt;
    model::Case real = scene;
    real.formulation = model::FormChoice::automatic; // a form forced for the criterion
    try {
        return stable_speeds(real);
    } catch (const model::BadInput &none) {
        notes.push_back(std::string("no balanced position to look at: ") + none.what());
    } catch (const model::AnalysisFailure &failure) {
        notes.push_back(std::string("the balanced position was not judged: ") + failure.what());
    }
    return std::nullopt;
}

} // namespace whirl::analyses

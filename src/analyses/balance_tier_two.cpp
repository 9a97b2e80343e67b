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

std::vector<SpeedBand> common(const std::vector<SpeedBand> &a, const std::vector<SpeedBand> &b) {
    std::vector<SpeedBand> out;
    for (const SpeedBand &x : a)
        for (const SpeedBand &y : b)
            if (std::max(x.from, y.from) < std::min(x.to, y.to))
                out.push_back({std::max(x.from, y.from), std::min(x.to, y.to)});
    return out;
}

/// Arrangements looked at where the balls have a choice; each takes a search of its own.
constexpr int arrangements = 6;

BalancedPosition stable_speeds(const model::Case &scene) {
    const double from = scene.speeds->from;
    const double to = scene.speeds->to;
    BalancedPosition out;
    std::vector<SpeedInterval> sometimes_unstable;
    std::vector<SpeedBand> always_unstable;
    for (const Arrangement &arrangement : sampled_arrangements(scene.rotor, arrangements)) {
        const std::vector<SpeedInterval> unstable =
            unstable_bands_of(scene, scene.rotor, arrangement);
        std::vector<SpeedBand> bands;
        for (const SpeedInterval &band : unstable)
            bands.push_back({band.first, band.second});
        if (out.arrangements == 0)
            out.bands = rest_of(unstable, from, to);
        always_unstable = out.arrangements == 0 ? bands : common(always_unstable, bands);
        sometimes_unstable.insert(sometimes_unstable.end(), unstable.begin(), unstable.end());
        ++out.arrangements;
    }
    std::vector<SpeedInterval> always;
    for (const SpeedBand &band : always_unstable)
        always.emplace_back(band.from, band.to);
    out.with_every = rest_of(joined(sometimes_unstable), from, to);
    out.with_some = rest_of(always, from, to);
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

#include "linalg/check.h"
#include "modes/following/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::modes {

namespace {

/// Pairs to begin with beyond those wanted: to place the circle among, and to leave room for it to
/// shrink.
constexpr int beyond = 4;

/// Drops the pairs beyond the smallest that whirl.
void drop_beyond(FollowedSpeed &at, int whirling) {
    std::vector<double> sizes;
    for (const SymmetricPair &pair : at.pairs)
        if (pair.whirls())
            sizes.push_back(std::abs(pair.value));
    if (std::ssize(sizes) <= whirling)
        return;
    std::sort(sizes.begin(), sizes.end());
    const double last = sizes[static_cast<std::size_t>(whirling - 1)];
    std::erase_if(at.pairs, [last](const auto &pair) { return std::abs(pair.value) > last; });
}

} // namespace

/// Pairs by inverse iteration from these, as many as can be followed; none where they do not settle
/// or coincide.
std::optional<FollowedSpeed> Continuation::refined(const StartingPairs &found, double speed,
                                                   int wanted) const {
    FollowedSpeed out;
    out.speed = speed;
    for (const auto &[value, shape] : found.whirls) {
        out.pairs.emplace_back();
        out.pairs.back().value = value;
        out.pairs.back().vector = _problem.from_form(shape);
    }
    for (const double value : found.real)
        out.pairs.push_back(nearest_upper(_problem, speed, value));
    std::optional<std::vector<SymmetricPair>> pairs =
        pairs_near(_problem, speed, std::move(out.pairs), wanted);
    if (!pairs)
        return std::nullopt;
    out.pairs = std::move(*pairs);
    for (std::size_t i = 0; i < out.pairs.size(); ++i) {
        out.pairs[i].solved = true;
        for (std::size_t j = 0; j < i; ++j) // no vectors to go on from, but a space
            if (std::norm(out.pairs[i].value - out.pairs[j].value) <
                1e-10 * std::norm(out.pairs[i].value))
                return std::nullopt;
    }
    // Pairs are refined a few at a time: none for which that many more would have to stand in.
    const int excess = (wanted + beyond + static_cast<int>(found.real.size())) % linalg::lanes;
    drop_beyond(out, wanted + beyond - (excess <= beyond / 2 ? excess : 0));
    out.radius = widest_gap(out, wanted);
    return out;
}

std::optional<FollowedSpeed> Continuation::from_undamped(double speed, int wanted) const {
    const StartingPairs found = _undamped(speed, wanted + beyond);
    FollowedSpeed undamped;
    undamped.speed = found.speed;
    for (const auto &[value, shape] : found.whirls)
        undamped.pairs.emplace_back().value = value;
    undamped.radius = std::min(found.radius, widest_gap(undamped, wanted));
    std::optional<FollowedSpeed> out = refined(found, speed, wanted);
    if (!out || undamped.radius == 0 || out->radius == 0 ||
        !none_missing(_problem, undamped, undamped.radius, *out, out->radius, false))
        return std::nullopt;
    return out;
}

std::optional<FollowedSpeed> Continuation::begin(double speed, int wanted) const try {
    std::optional<FollowedSpeed> out = _undamped ? from_undamped(speed, wanted) : std::nullopt;
    if (!out) {
        const StartingPairs found = _start(speed, wanted + beyond);
        if ((out = refined(found, speed, wanted)))
            out->radius = std::min(found.radius, out->radius);
    }
    // Motions that come to rest in the shaft's damping are not followed, and lie without end there.
    constexpr double clear = 0.9;
    if (!out || out->radius == 0 || out->within(out->radius) < wanted ||
        out->radius > clear * _problem.relaxation().rate)
        return std::nullopt;
    out->counted = true;
    return out;
} catch (const linalg::SolverError &) {
    return std::nullopt; // that speed is solved alone
}

} // namespace whirl::modes

#pragma once

#include "model/operation.h"
#include "results/operating.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::operation {

/// What a motion may be at most.
struct VibrationLimit {
    results::Measure what = results::Measure::amplitude;
    double value = 0; ///< in SI; amplitudes from zero to peak
    std::string source;
    results::Sentence why; ///< it cannot judge these operating speeds; empty: it can
};

/// Of what a shaft probe reads at any operating speed, the trip speed among them:
///  - the one that the case names;
///  - API 617: 25.4 um sqrt(12000/N), at most 25.4 um, from peak to peak, N rpm the maximum
///    continuous speed. The standard lets more pass between that and the trip speed; here the limit
///    is the same up to there;
///  - ISO 20816-3: 4800/sqrt(n), 9000/sqrt(n) and 13200/sqrt(n) um from peak to peak at the
///    boundaries A/B, B/C and C/D, n rpm the maximum speed.
[[nodiscard]] std::vector<VibrationLimit> shaft_limits(const model::Limits &limits,
                                                       const model::Operation &operation);

/// Of the motion of a pedestal in any direction:
///  - the velocity that the case names;
///  - ISO 20816-3 (the figures of ISO 10816-3): velocity and displacement, root mean square, at the
///    boundaries of its zones; both must hold, the latter is the stricter below 12.5 Hz.
[[nodiscard]] std::vector<VibrationLimit> pedestal_limits(const model::Limits &limits,
                                                          const model::Operation &operation);

/// The highest operating speed, rad/s: the trip speed, else the maximum one.
[[nodiscard]] double top_speed(const model::Operation &operation);

} // namespace whirl::operation

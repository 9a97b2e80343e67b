#include "analyses/stability_ends.h"

#include "ends/band_ends.h"
#include "ends/stability_ends.h"

#include <fmt/format.h>

namespace whirl::analyses {

namespace {

/// Inside of the bands and between them.
std::vector<double> looks(const std::vector<stability::SpeedInterval> &bands) {
    std::vector<double> out;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        out.push_back((bands[i].first + bands[i].second) / 2);
        if (i > 0)
            out.push_back((bands[i - 1].second + bands[i].first) / 2);
    }
    return out;
}

results::Verdict verdict_of(std::complex<double> fastest) {
    if (fastest.real() <= 0)
        return fastest.real() < 0 ? results::Verdict::stable : results::Verdict::neutral;
    return fastest.imag() == 0 ? results::Verdict::diverges : results::Verdict::unstable;
}

} // namespace

void add_growth(const ends::AllMotions &motions, results::StabilityResult &result) {
    for (const double speed : result.speeds) {
        const std::complex<double> fastest = motions.fastest_growing(speed);
        result.growth.push_back(fastest.real());
        result.verdict.push_back(verdict_of(fastest));
    }
}

void add_ends(const ends::AllMotions *motions, results::Form form, const stability::MotionsAt &at,
              const std::vector<double> &grid, results::StabilityResult &result) {
    const stability::SpeedInterval range{grid.front(), grid.back()};
    if (motions != nullptr) {
        ends::EndsFound found =
            ends::find_ends(*motions, range.first, range.second, looks(result.unstable));
        result.ends = std::move(found.ends);
        for (const auto &[from, to] : found.doubtful)
            result.model.notes.push_back(
                fmt::format("between {:.10g} and {:.10g} rad/s the number of growing motions is in "
                            "doubt",
                            from, to));
    } else {
        result.ends = ends::multiplier_ends(at, grid, result.unstable);
    }
    for (const double edge : ends::reconcile(result.ends, result.unstable, at, form, range))
        result.model.notes.push_back(fmt::format(
            "at {:.10g} rad/s an unstable band ends, but no change of the number of growing "
            "motions was found",
            edge));
}

} // namespace whirl::analyses

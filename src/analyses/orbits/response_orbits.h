#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/response_error.h"
#include "forced/response_places.h"
#include "model/case.h"
#include "results/response.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// The steady motion at one speed, solved.
struct SolvedMotion {
    const forced::ForcedMotion &motion;
    const forced::ResponseError *finer; ///< null: at a resonance there
    double rounding = 0;                ///< relative error by it

    /// Relative error of a quantity.
    /// @param of_elements  by the finer elements
    template <class Of> [[nodiscard]] double error(const Of &of_elements) const {
        return finer ? of_elements(*finer) + rounding : forced::unlimited;
    }
};
/// None at a resonance without damping.
using MotionAt = std::function<std::optional<SolvedMotion>(double speed)>;

/// Bearings and seals with a clearance as quantities whose peaks are looked for.
void watch_clearances(forced::Watched &all, const assembly::Discretization &d);
/// Takes the peaks and curves of those out of lists that have them last.
[[nodiscard]] std::vector<results::ResponsePeak> clearance_peaks(results::ResponseResult &result,
                                                                 std::size_t other_quantities);

/// Orbits and deflected shapes at the speeds of the case, without any at the operating speeds and
/// at resonances of stations between them, without these at the largest resonance. And the largest
/// orbit in each clearance over the range, with a note where it is too large.
///
/// @param nodes  as of the response, with their names
/// @param peaks  of clearance_peaks
void add_orbits(results::ResponseResult &result, const assembly::Discretization &d,
                const model::Case &scene, const std::map<int, std::string> &nodes,
                const std::vector<results::ResponsePeak> &peaks, const MotionAt &motion_at);

} // namespace whirl::analyses

#pragma once

#include "model/case.h"
#include "results/interval.h"
#include "results/sentence.h"
#include "results/stability.h"
#include "states/balanced_over_speed.h"

#include <memory>
#include <vector>

namespace whirl::analyses {

// Balls that [[imbalance]] entries or the eccentricity of a race make stand elsewhere, at every
// speed, than the imbalances of their own balancers ask for.

/// The balanced position that all imbalances of the rotor ask for together. None without balancers
/// or anything that does so, and where it is not found: a warning then says why, and that what
/// follows is for balls against the imbalance of their own balancer.
/// @param order   of the shaft's elements
/// @param speeds  at which it will be asked for, rad/s
[[nodiscard]] std::unique_ptr<states::BalancedOverSpeed>
placed_by_all_imbalances(const model::Case &scene, int order, const std::vector<double> &speeds,
                         std::vector<results::Sentence> &notes);

/// Motions about such a position over a range of speeds.
struct PlacedBands {
    states::BalancedRange range;
    /// Of the intervals in which some motion grows, rad/s: what elements four orders higher and a
    /// hundredth of the error of the reduction change, times 1.2; 0 at the ends of the range and
    /// NaN where the finer rotor has no such end next to it. None where not asked for.
    std::vector<results::EndErrors> errors;
    std::vector<results::EndErrors> missing_errors; ///< likewise, of those without a position
};
[[nodiscard]] PlacedBands placed_bands(const model::Case &scene, int order,
                                       const states::BalancedOverSpeed &position,
                                       const std::vector<double> &grid, int arrangement,
                                       bool with_errors);

/// Growth at the speeds of the result, unstable bands and their ends, and over the arrangements of
/// the balls.
void answer_for_placed_balls(const model::Case &scene, int order,
                             const states::BalancedOverSpeed &position,
                             const std::vector<double> &grid, results::StabilityResult &result);

/// Why there is none at a speed; in a sentence.
inline constexpr const char *no_balanced_position =
    "no balanced position: the imbalances ask for more than the balancers can supply, or for less "
    "than they always make";
/// Says where no balanced position exists.
void note_missing(const std::vector<results::Interval> &missing,
                  std::vector<results::Sentence> &notes);

} // namespace whirl::analyses

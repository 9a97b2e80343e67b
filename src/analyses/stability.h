#pragma once

#include "analyses/case_with.h"
#include "balancers/arrangement.h"
#include "ends/refinement.h"
#include "model/case.h"
#include "results/stability.h"
#include "stability/band_finder.h"
#include "stability/rotor_at_speeds.h"
#include "stability/unstable_bands.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace whirl::analyses {

/// Where motion is unstable: growth over the speeds of the case; all unstable bands in the range,
/// ends refined (unstable_bands.h); critical and additional speeds; permissible anisotropies;
/// intervals over the family of balanced positions; with [map] the growth over two entries; with
/// [standard] clearances the same with the bearings of each.
/// Maps are collective under mpirun and complete on process 0.
/// @throws model::BadInput without [speeds] or a balanced position; model::AnalysisFailure where
/// eigenvalues are not found or a Hill series does not settle.
[[nodiscard]] results::StabilityResult stability(const model::Case &scene, const CaseWith &with);

/// Unstable bands for one arrangement of the balls.
struct UnstableBands {
    std::vector<results::Interval> bands;
    std::vector<results::EndErrors> errors;        ///< rad/s; none where not asked for
    std::vector<results::Interval> doubtful;       ///< motions could not be followed through
    std::vector<ends::EndOfGrowth> roots;          ///< the motions at ends, as far as known
    std::shared_ptr<stability::BandFinder> finder; ///< by which they were found, if by one
};
/// By the same rules as stability(): of the balanced position that all imbalances ask for.
[[nodiscard]] UnstableBands unstable_bands_of(const model::Case &scene, bool with_errors);
/// Of one arrangement at all speeds. Speeds that a Hill series does not describe count as unstable.
[[nodiscard]] UnstableBands unstable_bands_of(const model::Case &scene,
                                              const balancers::Arrangement &arrangement,
                                              bool with_errors);
/// The same with form and order chosen before, at speeds that search_speeds() gives.
/// @param like  of another arrangement in the same model at the same speeds, to begin with
[[nodiscard]] UnstableBands unstable_bands_of(stability::StabilityModel model,
                                              const std::vector<double> &grid,
                                              const balancers::Arrangement &arrangement,
                                              bool with_errors,
                                              const stability::BandFinder *like = nullptr);

} // namespace whirl::analyses

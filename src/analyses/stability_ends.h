#pragma once

#include "ends/all_motions.h"
#include "ends/stability_ends.h"
#include "results/stability.h"
#include "stability/band_finder.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// Largest real part and verdict at the speeds of the result, of all motions of the rotor.
void add_growth(const ends::AllMotions &motions, results::StabilityResult &result);

/// The same, and bands, of motions that are the same at every speed: all of the range or nothing.
void add_growth_of_all_speeds(const ends::AllMotions &motions, results::StabilityResult &result);

/// The same of the speeds that a Hill series describes.
void add_hill_growth(const stability::MotionsAt &at, const stability::StabilityModel &model,
                     results::StabilityResult &result);

/// All speeds at which the number of growing motions changes, where they tell all there is to tell
/// of the unstable bands: every motion is damped or grows, and was followed throughout.
/// @param grid   range of speeds, its ends alone matter
/// @param steps  of the range to begin with
[[nodiscard]] std::optional<ends::EndsFound>
certain_ends(const ends::AllMotions &motions, const std::vector<double> &grid, int steps);

/// Unstable bands by the ends of growth, where these are certain, else by the search for bands.
/// @param at  motions of the whole rotor of the finder
[[nodiscard]] stability::BandsFound bands_between_ends(stability::BandFinder &finder,
                                                       const stability::StabilityModel &model,
                                                       const balancers::Arrangement &arrangement,
                                                       const stability::MotionsAt &at,
                                                       const std::vector<double> &grid);

/// Bands and ends where the search for bands is needed beside that for ends: motions without
/// damping, equations that stay periodic. Each completes the other; notes where they do not agree.
/// @param motions  of the rotor; none: form hill
void add_bands_and_ends(stability::BandFinder &finder, const ends::AllMotions *motions,
                        results::Form form, const stability::MotionsAt &at,
                        const std::vector<double> &grid, results::StabilityResult &result);

/// Growth below 1e-8 of the highest speed outside of the unstable bands is what rounding leaves of
/// none: the search for bands looks more sharply than the eigenvalues at a speed can. So is decay
/// as slow of a rotor without damping.
void settle_rounding(results::StabilityResult &result, bool damped);

/// Balls on one diameter can roll on without any effect, which neither grows nor dies out.
void add_neutral_balls(const model::Rotor &rotor, results::StabilityResult &result);

/// The longest run of speeds that a Hill series describes.
[[nodiscard]] std::vector<double> described(const std::vector<double> &speeds,
                                            const stability::StabilityModel &model);

/// Speeds at which the Hill series does not settle, and all slower ones, are given up: of the grid
/// the longest run of those that are left stays.
void give_up_unsettled(const stability::MotionsAt &at, std::vector<double> &grid,
                       stability::StabilityModel &model);

} // namespace whirl::analyses

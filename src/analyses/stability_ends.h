#pragma once

#include "ends/all_motions.h"
#include "ends/stability_ends.h"
#include "results/stability.h"
#include "stability/band_finder.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// Largest real part and verdict at the speeds of the result, of all motions of the rotor; of those
/// that the elements resolve and of the others where they are told apart (count_resolved).
void add_growth(const ends::AllMotions &motions, results::StabilityResult &result);

/// The same, and bands, of motions that are the same at every speed: all of the range or nothing.
void add_growth_of_all_speeds(const ends::AllMotions &motions, results::StabilityResult &result);

/// The same of form hill.
/// @param from  rad/s, least |speed| that is described
void add_hill_growth(const stability::BandFinder &finder, double from,
                     results::StabilityResult &result);

/// Unstable bands, and the motions at their ends that are known as roots.
struct BandsBetween {
    stability::BandsFound found;
    std::vector<ends::EndOfGrowth> roots;
};

/// Unstable bands by the ends of growth, where these are certain, else by the search for bands.
[[nodiscard]] BandsBetween bands_between_ends(stability::BandFinder &finder,
                                              const std::vector<double> &grid);

/// Says where motions could not be followed through, in one note however many places there are.
/// @param motions  "the motions about the balanced position"
void note_lost_motions(const std::vector<results::Interval> &doubtful, const char *motions,
                       std::vector<results::Sentence> &notes);

/// Unstable bands and the speeds at which the number of growing motions changes: by the ends of
/// growth where these are certain, else by the search for bands beside them.
/// @param motions  of the rotor; none: form hill
/// @returns the motions at the ends that are known as roots
[[nodiscard]] std::vector<ends::EndOfGrowth> search_bands(stability::BandFinder &finder,
                                                          const ends::AllMotions *motions,
                                                          const std::vector<double> &grid,
                                                          results::StabilityResult &result);

/// Growth at the speeds of a result and what follows from it, to be changed together.
struct GrowthAndVerdict {
    std::vector<double> &growth;
    std::vector<results::Verdict> &verdict;
};

/// Growth below 1e-8 of the highest speed outside of the unstable bands is what rounding leaves of
/// none: the search for bands looks more sharply than the eigenvalues at a speed can. So is decay
/// as slow of a rotor without damping.
void settle_rounding(GrowthAndVerdict of, const std::vector<double> &speeds,
                     const std::vector<results::Interval> &bands, bool damped);

/// Pairs of roots 0, -h that the motion of the rotor does not see: each ball or ring of a balancer
/// beyond two, on one diameter beyond the first, adds one for each of its coordinates.
[[nodiscard]] int neutral_pairs(const model::Rotor &rotor);

/// Several balls on one diameter can roll against each other without any effect, which neither
/// grows nor dies out. One alone cannot.
void add_neutral_balls(const model::Rotor &rotor, results::StabilityResult &result);

/// The longest run of speeds that a Hill series describes.
[[nodiscard]] std::vector<double> described(const std::vector<double> &speeds,
                                            const stability::StabilityModel &model);

/// Speeds at which the Hill series does not settle, and all slower ones, are given up: of the grid
/// the longest run of those that are left stays.
void give_up_unsettled(const stability::BandFinder &finder, std::vector<double> &grid,
                       stability::StabilityModel &model);

} // namespace whirl::analyses

#pragma once

#include "stability/band_finder.h"
#include "stability/rotor_at_speeds.h"
#include "stability/unstable_bands.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::stability {

/// Whether bands can be followed: of an elastic rotor with damping whose equations stay periodic in
/// time.
[[nodiscard]] bool bands_can_be_followed(const BandFinder &finder);

/// The dI at which the last band closes, where bands_can_be_followed, from the bands of the rotor
/// with some dI. They are followed (periodic/neutral.h), and so are bands that the search at what
/// was found still sees, until it finds none; just above something grows.
/// @param with     the model with another dI
/// @param given    some dI
/// @param finder   with which the bands with it were found
/// @param speeds   ascending, at which the search looks
/// @returns nothing where there are no bands, or they cannot be followed
[[nodiscard]] std::optional<double>
closing_anisotropy(const std::function<StabilityModel(double dI)> &with, double given,
                   const BandFinder &as_it_is, std::vector<results::Interval> bands,
                   const std::vector<double> &speeds);

} // namespace whirl::stability

#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/response.h"
#include "synchronous/reduced.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// Critical speeds directly, without a sweep over speed: the `campbell.modes` lowest, and all up
/// to speeds.to where the case has speeds. Of negative speeds the same where its range reaches
/// there: as many of |speed|, and all down to speeds.from.
///
/// Undamped and isotropic: forward det[K - W^2 (M - G)] = 0, backward det[K - W^2 (M + G)] = 0.
/// Orthotropic undamped: det[K - W^2 (M + S)] = 0; coupled symmetrically: det[K - W^2 (M - iG)] =
/// 0, Hermitian. General: l = i W in the quadratic problem, l^2 (M - iG) + l (C - i Kc) + K, of
/// which Im l is the speed and Re l is reported; roots with |Re l| >= Im l (no resonance peak) are
/// left out. At negative speeds G and Kc have the other sign. Bearing tables: the same with the
/// coefficients at the speed found; all such speeds (synchronous::followed_modes). Asymmetric
/// rotors on equal bearings: forward, balls held, and without damping. Errors: critical_errors;
/// infinite where they are not known.
///
/// @param map    with the critical speed map (critical_map)
/// @param peaks  of unbalance_response, for the margins; null: they are looked for here
[[nodiscard]] results::CriticalResult
critical_speeds(const model::Case &scene, bool map = false,
                const std::vector<results::ResponsePeak> *peaks = nullptr);

/// The same with elements of the order given, errors and completeness not judged: for many rotors
/// that differ a little from one whose errors are known. Of asymmetric rotors each direction of a
/// motion is listed, as equal ones need not stay equal, and twice as many.
/// @param shapes  shapes_for_samples() of one of them; none: each rotor's own
[[nodiscard]] results::CriticalResult
unjudged_critical_speeds(const model::Case &scene,
                         const synchronous::SharedShapes *shapes = nullptr);

/// Those that critical_speeds() lists, not judged: separation margins are of these.
[[nodiscard]] std::vector<results::CriticalSpeed> listed_critical_speeds(const model::Case &scene);

/// The separation margins, where the case has operating speeds: of those critical speeds of the
/// result that critical_speeds() lists for the case.
/// @param peaks  of the response to imbalance; null: they are looked for here
void add_separation_margins(const model::Case &scene, results::CriticalResult &result,
                            const std::vector<results::ResponsePeak> *peaks = nullptr);

/// Shapes that serve all rotors which differ a little from a case.
/// @param order    of the elements
/// @param highest  of its critical speeds, rad/s
/// @returns none where they cannot be found at once
[[nodiscard]] std::optional<synchronous::SharedShapes>
shapes_for_samples(const model::Case &scene, int order, double highest);

/// The same motion in two directions, where nothing asymmetric takes part, is one whirl: leaves as
/// many as are wanted of each sign of the speed, and all of a range.
/// @param speeds  ascending
void drop_second_directions(std::vector<results::CriticalSpeed> &speeds, int wanted,
                            const results::Interval &all);

} // namespace whirl::analyses

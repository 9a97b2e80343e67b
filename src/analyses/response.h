#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/response.h"

#include <vector>

namespace whirl::analyses {

/// Steady motion under the imbalances of the case over its speeds, forward synchronous, and, with
/// [response] gravity, under its weight (forced/response_gravity.h):
///
///     force at an imbalance: mr Omega^2 (cos(Omega t + phase), sin(Omega t + phase)).
///
/// Orbits at every node where something is attached and at the shaft ends; the readings of the
/// probes; in each bearing the largest |k u + c u'| over a turn, u the stretch of its film (shaft
/// minus pedestal). Each with an estimate of its relative error by the shaft elements
/// (response_error.h) and by rounding. Without limit (and a note) at an undamped resonance. Bearing
/// tables are read at each speed. Collective over MPI processes: the result is complete on process
/// 0, without lists elsewhere. Auto-balancers are left out (a note says so).
/// @throws model::BadInput without [[imbalance]] and gravity, or without [speeds];
///         model::AnalysisFailure for an asymmetric rotor on bearings that differ between their
///         directions.
[[nodiscard]] results::ResponseResult unbalance_response(const model::Case &scene);

/// Of that response peaks, margins and the motion at the operating speeds, by this process alone.
/// @param scene            with [operation] and imbalances; no balancers, and no rotor that is
///                         stiffer in one direction than in another
/// @param critical_speeds  of that rotor, for the margins
[[nodiscard]] results::ResponseResult
response_in_operation(const model::Case &scene,
                      const std::vector<results::CriticalSpeed> &critical_speeds);

/// Of that response the model and the peaks alone, by this process alone.
/// @param with_errors  false: the errors of the peaks are NaN
[[nodiscard]] results::ResponseResult response_peaks(const model::Case &scene, bool with_errors);

} // namespace whirl::analyses

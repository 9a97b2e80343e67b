#pragma once

#include "analyses/critical_map/points.h"
#include "results/critical.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// The stiffnesses of the bearings over speed, to be laid across a map: equal bearings together;
/// all of them, or the one that varies.
/// @param rotor     as the case has it
/// @param low,high  speeds of the map, rad/s
[[nodiscard]] std::vector<results::CriticalMapBearing>
bearings_across(const model::Rotor &rotor, std::optional<std::size_t> varied, double low,
                double high);

/// Adds where those stiffnesses meet the curves of the map, as roots.
/// @param rotor  as the case has it
/// @throws linalg::SolverError
void add_crossings(const MapScene &map, const CurveOf &curve_of, const model::Rotor &rotor,
                   results::CriticalMap &out, std::vector<std::string> &notes);

} // namespace whirl::analyses

#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/critical.h"

#include <string>
#include <vector>

namespace whirl::report {

// The critical speed map as a part of the report of `critical`.

[[nodiscard]] Json critical_map_json(const model::Case &scene, const results::CriticalMap &map);
/// Crossings, and the speeds at the soft and the stiff end.
[[nodiscard]] std::vector<Section> critical_map_sections(const model::Case &scene,
                                                         const results::CriticalMap &map);
[[nodiscard]] std::string critical_map_text(const model::Case &scene,
                                            const results::CriticalMap &map);
/// The map with its CSV: rows of kind "curve", "bearing", "crossing" and "shape".
[[nodiscard]] Picture critical_map_picture(const model::Case &scene,
                                           const results::CriticalMap &map, const Units &units);

/// "left, right (z = 1.5 m)": the bearings whose stiffness is laid across a map.
[[nodiscard]] std::string bearings_text(const model::Case &scene,
                                        const std::vector<std::size_t> &bearings);
/// "kxx" or "kyy", or "k" where both are the same.
[[nodiscard]] std::string coefficient_name(const results::CriticalMapBearing &across, bool x);
/// "2 forward": short for tables and pictures "2F".
[[nodiscard]] std::string curve_name(results::Whirl whirl, int number);

} // namespace whirl::report

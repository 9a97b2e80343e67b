#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/response.h"

#include <string>
#include <vector>

namespace whirl::report {

// What the report of the response says of orbits, clearances and deflected shapes.

/// Adds the keys `orbits`, `clearances` and `shapes`.
void add_orbits(Json &json, const results::ResponseResult &result, const Units &units);

[[nodiscard]] std::vector<Section> orbit_sections(const results::ResponseResult &result,
                                                  const Units &units);
[[nodiscard]] std::string orbit_text(const results::ResponseResult &result, const Units &units);

/// Orbits in their clearance circles, and deflected shapes, as far as there are any.
[[nodiscard]] std::vector<Picture>
orbit_pictures(const model::Case &scene, const results::ResponseResult &result, const Units &units);

/// One row a speed, one column a place: bearings and seals, and the station that moves most.
[[nodiscard]] Chart orbits_chart(const model::Case &scene,
                                 const std::vector<results::Orbits> &orbits, const Units &units);
/// One panel a speed: x and y along the shaft at the instant of the largest deflection, and the
/// envelope of the orbits.
[[nodiscard]] Chart shapes_chart(const model::Case &scene,
                                 const std::vector<results::DeflectedShape> &shapes,
                                 const Units &units);

} // namespace whirl::report

#pragma once

// Parts of the report of the response.

#include "report/common/column.h"
#include "report/report.h"
#include "results/response.h"

#include <functional>
#include <string>
#include <vector>

namespace whirl::report {

/// One motion of a result for all readers: that of each drive, whose amplitudes do not add.
struct Part {
    std::string file;    ///< of its picture and its table, where it is not the first
    std::string title;   ///< "Response to the weight"
    std::string picture; ///< "motion under the weight"
    std::function<Chart(const Units &)> chart;
    std::function<std::string(const Units &)> csv;
    std::function<std::vector<Section>(const Units &)> sections;
    std::function<std::string(const Units &)> text;
    std::string key{}; ///< of what follows; empty: it has none of its own
    std::function<Json(const Units &)> json{};
};

/// The motion under the weight. @param result  which has it
[[nodiscard]] Part weight_part(const model::Case &scene, const results::ResponseResult &result);
/// @param result  with receptances
[[nodiscard]] Part receptance_part(const model::Case &scene, const results::ResponseResult &result);

// The machine at its operating speeds.

/// The keys `operating`, `worst` and `scale`.
[[nodiscard]] Json operating_json(const results::OperatingResponse &operating, const Units &units);
/// A line a place and speed. @param first  columns in front: which runs they belong to
[[nodiscard]] std::string operating_csv(const Columns<results::OperatingRow> &first,
                                        const std::vector<results::OperatingRow> &rows,
                                        const Units &units);
/// What is told first; nothing without.
[[nodiscard]] std::vector<Section> operating_sections(const results::ResponseResult &result,
                                                      const Units &units);
/// For a summary: limits, and the places at the speed at which the machine runs most.
[[nodiscard]] std::vector<Section> operating_brief(const results::ResponseResult &result,
                                                   const Units &units);
/// The place that uses most of its limit, else that with the largest amplitude; with operating
/// speeds.
[[nodiscard]] model::Sentence operating_answer(const results::ResponseResult &result);
[[nodiscard]] std::string operating_text(const results::ResponseResult &result, const Units &units);

// Orbits, clearances and deflected shapes.

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

// Standard runs; nothing without any.

/// Adds the keys `runs` and `worst_run`.
void add_runs(Json &json, const results::ResponseResult &result, const Units &units);
/// All runs side by side, and the worst of them.
[[nodiscard]] std::vector<Section> run_sections(const results::ResponseResult &result,
                                                const Units &units);
/// The worst in a line, and the table.
[[nodiscard]] std::string worst_run_text(const results::ResponseResult &result, const Units &units);
[[nodiscard]] std::string runs_text(const results::ResponseResult &result, const Units &units);
/// The places of all runs at the operating speeds.
[[nodiscard]] std::string runs_csv(const results::ResponseResult &result, const Units &units);

} // namespace whirl::report

#include "report/csv.h"

#include "results/stability.h"
#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

/// Empty where there is no answer.
std::string growth_cell(double growth) {
    return std::isfinite(growth) ? fmt::format("{}", growth) : "";
}

/// @param errors  of both ends, or empty
std::string band_rows(const char *kind, const std::vector<std::pair<double, double>> &bands,
                      const std::vector<std::pair<double, double>> &errors = {}) {
    std::string csv;
    for (std::size_t i = 0; i < bands.size(); ++i)
        csv += fmt::format(
            "{},{},{},,,{}\n", kind, bands[i].first, bands[i].second,
            i < errors.size() ? fmt::format("{},{}", errors[i].first, errors[i].second) : ",");
    return csv;
}

std::string map_rows(const results::StabilityMap &map) {
    std::string csv;
    for (std::size_t j = 0; j < map.growth.size(); ++j)
        for (std::size_t i = 0; i < map.growth[j].size(); ++i)
            csv += fmt::format("map,{},{},{},,,\n", map.x_values[i], map.y_values[j],
                               growth_cell(map.growth[j][i]));
    return csv;
}

} // namespace

std::string to_csv(const results::StabilityResult &result) {
    // Of a band from and to are its ends; of a map they are its two entries.
    std::string csv = "kind,from,to,growth [1/s],verdict,error of from,error of to\n";
    for (std::size_t i = 0; i < result.speeds.size() && i < result.growth.size(); ++i)
        csv += fmt::format(
            "growth,{0},{0},{1},{2},,\n", result.speeds[i], growth_cell(result.growth[i]),
            i < result.verdict.size() ? results::verdict_name(result.verdict[i]) : "");
    csv += band_rows("unstable", result.unstable, result.unstable_error);
    for (const double speed : result.critical_speeds)
        csv += fmt::format("critical speed,{0},{0},,,,\n", speed);
    for (const double speed : result.zero_root_speeds)
        csv += fmt::format("zero root,{0},{0},,,,\n", speed);
    for (const double speed : result.additional_speeds)
        csv += fmt::format("additional speed,{0},{0},,,,\n", speed);
    if (result.family) {
        csv += band_rows("unstable with some arrangement", result.family->unstable);
        csv += band_rows("unstable with every arrangement", result.family->always_unstable);
        csv += band_rows("critical speed over arrangements", result.family->critical_speeds);
        csv += band_rows("additional speed over arrangements", result.family->additional_speeds);
    }
    return result.map ? csv + map_rows(*result.map) : csv;
}

} // namespace whirl::report

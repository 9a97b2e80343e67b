#include "analyses/stability_map.h"

#include "model/case.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "process/progress.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace whirl::analyses {

namespace {

std::vector<double> values_of(const model::MapAxis &axis) {
    return model::SpeedRange{axis.from, axis.to, axis.count}.values();
}

std::string entry(const model::MapAxis &axis, double value) {
    return fmt::format("{}={}", axis.path, value);
}

bool is_speed(const model::MapAxis &axis) { return axis.path == "speed"; }

/// Growth of one case at each of some speeds.
std::vector<double> growth_at(const model::Case &scene, const std::vector<double> &speeds) {
    const stability::StabilityModel model = stability::stability_model(scene, speeds);
    if (model.conservative)
        return std::vector<double>(speeds.size(), 0.0);
    const stability::MotionSolver solver(scene.rotor, model.form, model.order,
                                         balancers::arrangement_at_balance(scene.rotor),
                                         model.harmonics);
    std::vector<double> out;
    for (const double speed : speeds)
        out.push_back(std::abs(speed) >= model.from ? stability::growth_of(solver.at(speed))
                                                    : std::numeric_limits<double>::quiet_NaN());
    return out;
}

/// NaN where there is no such rotor: an inertia out of bounds, a capacity below 1.
/// `why` takes the first reason.
std::vector<double> where_possible(std::size_t count, std::string &why,
                                   const std::function<std::vector<double>()> &growth) {
    try {
        return growth();
    } catch (const model::BadInput &problem) {
        if (why.empty())
            why = problem.what();
        return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
    }
}

std::vector<double> row_of(const model::MapSettings &map, double y, const CaseWith &with,
                           std::string &why) {
    const std::vector<double> x_values = values_of(map.x);
    if (is_speed(map.x))
        return where_possible(x_values.size(), why,
                              [&] { return growth_at(with({entry(map.y, y)}), x_values); });
    std::vector<double> row;
    for (const double x : x_values)
        row.push_back(where_possible(1, why, [&]() -> std::vector<double> {
                          const model::Case scene = with({entry(map.x, x), entry(map.y, y)});
                          const auto growth =
                              growth_at(scene, model::required_speeds(scene).values());
                          return {*std::max_element(growth.begin(), growth.end())};
                      }).front());
    return row;
}

} // namespace

results::StabilityMap stability_map(const model::MapSettings &settings, const CaseWith &with) {
    results::StabilityMap map{settings.x, settings.y, values_of(settings.x), values_of(settings.y),
                              {},         {}};
    if (!is_speed(settings.x) && is_speed(settings.y)) {
        // A case is read once for each column: turn the map, and turn it back.
        const results::StabilityMap turned = stability_map({settings.y, settings.x}, with);
        map.why = turned.why;
        map.growth.assign(turned.growth.empty() ? 0 : map.y_values.size(),
                          std::vector<double>(map.x_values.size()));
        for (std::size_t i = 0; i < turned.growth.size(); ++i)
            for (std::size_t j = 0; j < turned.growth[i].size(); ++j)
                map.growth[j][i] = turned.growth[i][j];
        return map;
    }
    std::size_t done = 0;
    const process::Stage stage("map", 0, 1);
    map.growth = process::rows_at(map.y_values, [&](double y) {
        process::report_progress(static_cast<double>(done++) /
                                 static_cast<double>(map.y_values.size()));
        return row_of(settings, y, with, map.why);
    });
    return map;
}

} // namespace whirl::analyses

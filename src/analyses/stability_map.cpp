#include "analyses/stability_map.h"

#include "model/case.h"
#include "model/errors.h"
#include "process/parallel.h"
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
    const stability::MotionSolver solver(model, balancers::arrangement_at_balance(scene.rotor));
    std::vector<double> out;
    for (const double speed : speeds)
        out.push_back(std::abs(speed) >= model.from ? stability::growth_of(solver.at(speed))
                                                    : std::numeric_limits<double>::quiet_NaN());
    return out;
}

/// NaN where there is no such rotor: an inertia out of bounds, a capacity below 1; with the reason.
process::Outcome where_possible(std::size_t count,
                                const std::function<std::vector<double>()> &growth) {
    try {
        return {growth(), {}};
    } catch (const model::BadInput &problem) {
        return {std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()),
                problem.what()};
    }
}

/// A row over the spin speed.
process::Outcome row_of(const model::MapSettings &map, double y, const CaseWith &with) {
    const std::vector<double> speeds = values_of(map.x);
    return where_possible(speeds.size(),
                          [&] { return growth_at(with({entry(map.y, y)}), speeds); });
}

/// One point of a map without the spin speed.
process::Outcome point_of(const model::MapSettings &map, double x, double y, const CaseWith &with) {
    return where_possible(1, [&]() -> std::vector<double> {
        const model::Case scene = with({entry(map.x, x), entry(map.y, y)});
        const auto growth = growth_at(scene, model::required_speeds(scene).values());
        return {*std::max_element(growth.begin(), growth.end())};
    });
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
    const bool rows = is_speed(settings.x);
    const std::size_t columns = map.x_values.size();
    const std::size_t pieces = map.y_values.size() * (rows ? 1 : columns);
    const auto outcomes = process::deal(pieces, "map", [&](std::size_t i) {
        return rows
                   ? row_of(settings, map.y_values[i], with)
                   : point_of(settings, map.x_values[i % columns], map.y_values[i / columns], with);
    });
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (rows || i % columns == 0)
            map.growth.emplace_back();
        map.growth.back().insert(map.growth.back().end(), outcomes[i].numbers.begin(),
                                 outcomes[i].numbers.end());
        if (map.why.empty())
            map.why = outcomes[i].text;
    }
    return map;
}

} // namespace whirl::analyses

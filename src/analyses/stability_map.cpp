#include "analyses/stability_map.h"

#include "analyses/progress.h"
#include "analyses/speeds.h"
#include "analyses/stability_model.h"

#include <fmt/format.h>

#include <algorithm>

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
std::vector<double> growth_at(model::Case scene, const std::vector<double> &speeds) {
    scene.speeds = model::SpeedRange{speeds.front(), speeds.back(), 2};
    const StabilityModel model = stability_model(scene);
    if (model.conservative)
        return std::vector<double>(speeds.size(), 0.0);
    const MotionSolver solver(scene.rotor, model.form, model.order,
                              arrangement_at_balance(scene.rotor), model.harmonics);
    std::vector<double> out;
    for (const double speed : speeds)
        out.push_back(growth_of(solver.at(speed)));
    return out;
}

std::vector<double> row_of(const model::MapSettings &map, double y, const CaseWith &with) {
    if (is_speed(map.x))
        return growth_at(with({entry(map.y, y)}), values_of(map.x));
    std::vector<double> row;
    for (const double x : values_of(map.x)) {
        const model::Case scene = with({entry(map.x, x), entry(map.y, y)});
        const std::vector<double> growth = growth_at(scene, required_speeds(scene).values());
        row.push_back(*std::max_element(growth.begin(), growth.end()));
    }
    return row;
}

} // namespace

StabilityMap stability_map(const model::MapSettings &settings, const CaseWith &with) {
    StabilityMap map{settings.x, settings.y, values_of(settings.x), values_of(settings.y), {}};
    if (!is_speed(settings.x) && is_speed(settings.y)) {
        // A case is read once for each column: turn the map, and turn it back.
        const StabilityMap turned = stability_map({settings.y, settings.x}, with);
        map.growth.assign(turned.growth.empty() ? 0 : map.y_values.size(),
                          std::vector<double>(map.x_values.size()));
        for (std::size_t i = 0; i < turned.growth.size(); ++i)
            for (std::size_t j = 0; j < turned.growth[i].size(); ++j)
                map.growth[j][i] = turned.growth[i][j];
        return map;
    }
    std::size_t done = 0;
    map.growth = rows_at(map.y_values, [&](double y) {
        report_progress(static_cast<double>(done++) / static_cast<double>(map.y_values.size()));
        return row_of(settings, y, with);
    });
    return map;
}

} // namespace whirl::analyses

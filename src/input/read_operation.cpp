#include "input/sections.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

/// The support that an entry names by its place (from 0) or its name.
std::optional<std::size_t> support_of(const CheckedEntry &entry, const model::Rotor &rotor) {
    const auto supports = rotor.supports();
    if (supports.empty()) {
        entry.fail("expected a bearing, the case has none");
        return std::nullopt;
    }
    const Node &node = entry.node;
    std::vector<std::string> names;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < supports.size(); ++i) {
        if (!supports[i].name.empty())
            names.push_back(supports[i].name);
        if (node.kind == Node::Kind::text
                ? supports[i].name == node.text
                : node.kind == Node::Kind::integer && node.number == static_cast<double>(i))
            places.push_back(i);
    }
    if (places.size() == 1)
        return places.front();
    if (places.size() > 1)
        entry.fail(fmt::format("expected the name of one bearing, got {} of {}; give its place, "
                               "from 0",
                               shown(node), places.size()));
    else
        entry.fail(fmt::format("expected the name of a bearing or its place, 0 to {}, got {}{}",
                               supports.size() - 1, shown(node), did_you_mean(node.text, names)));
    return std::nullopt;
}

/// Reads a [[level1.stage]].
void read_stage(CheckedTable &table, model::Stage &stage) {
    stage.name = table.text("name").value_or("");
    stage.axial = table.choice("kind", {"centrifugal", "axial"}, 0) == 1;
    stage.power = table.number("power", Quantity::power, Range::positive());
    stage.speed = table.optional_number("speed", Quantity::speed, Range::positive());
    stage.diameter = table.number("diameter", Quantity::length, Range::positive());
    stage.width = table.number("width", Quantity::length, Range::positive());
    const auto ratio = table.optional_number("density_ratio", Quantity::number, Range::positive());
    if (ratio && stage.axial)
        table.fail("density_ratio", "expected none of an axial stage, whose cross coupling does "
                                    "not depend on it");
    stage.density_ratio = ratio.value_or(1);
    if (stage.width >= stage.diameter)
        table.fail("width",
                   fmt::format("expected less than diameter = {}, got {}",
                               as_written(table.find("diameter"), stage.diameter, "m", stage.width),
                               as_written(table.find("width"), stage.width, "m", stage.diameter)));
}

} // namespace

void read_operation(CheckedTable &table, model::Case &scene) {
    model::Operation operation;
    operation.from = table.number("from", Quantity::speed, Range::not_negative());
    operation.to = table.number("to", Quantity::speed, Range::positive());
    operation.trip = table.optional_number("trip", Quantity::speed, Range::positive());
    const auto written = [&table](const char *key, double value, double other) {
        return as_written(table.find(key), value, "rad/s", other);
    };
    if (operation.to <= operation.from)
        table.fail("to", fmt::format("expected more than from = {}, got {}",
                                     written("from", operation.from, operation.to),
                                     written("to", operation.to, operation.from)));
    if (operation.trip && *operation.trip < operation.to)
        table.fail("trip", fmt::format("expected at least to = {}, got {}",
                                       written("to", operation.to, *operation.trip),
                                       written("trip", *operation.trip, operation.to)));
    scene.operation = operation;
}

void read_level1(CheckedTable &table, model::Case &scene) {
    model::Level1Settings level1;
    level1.z = table.number("z", Quantity::length);
    level1.to = table.optional_number("to", Quantity::stiffness, Range::positive());
    level1.count = table.whole_or("count", level1.count, 2, 10000);
    level1.anticipated =
        table.optional_number("anticipated", Quantity::stiffness, Range::positive());
    level1.gas_density = table.optional_number("gas_density", Quantity::density, Range::positive());
    read_each(table, "stage", level1.stages, read_stage);
    if (level1.anticipated && !level1.stages.empty())
        table.fail("anticipated", "expected either this or [[level1.stage]], from which it is "
                                  "calculated, got both");
    scene.level1 = level1;
    if (!table.context().tree.find("operation"))
        table.fail("expected a section [operation], at whose highest speed cross coupling is "
                   "added, got none");
}

void read_critical_map(CheckedTable &table, model::Case &scene) {
    model::CriticalMapSettings map;
    map.from = table.optional_number("from", Quantity::stiffness, Range::positive());
    map.to = table.optional_number("to", Quantity::stiffness, Range::positive());
    map.points = table.whole_or("points", map.points, 2, 10000);
    if (map.from && map.to && *map.to <= *map.from)
        table.fail("to",
                   fmt::format("expected more than from = {} N/m, got {} N/m", *map.from, *map.to));
    if (const auto bearing = table.entry("bearing"))
        map.bearing = support_of(*bearing, scene.rotor);
    scene.critical_map = map;
}

} // namespace whirl::input

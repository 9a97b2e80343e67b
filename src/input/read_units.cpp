#include "input/sections.h"
#include "input/unit_presets.h"

#include <array>
#include <utility>

namespace whirl::input {
namespace {

/// What of results may be written in other units, as the keys of [units].
constexpr std::array written{
    std::pair{"length", Quantity::length},       std::pair{"amplitude", Quantity::length},
    std::pair{"speed", Quantity::angular_speed}, std::pair{"frequency", Quantity::angular_speed},
    std::pair{"force", Quantity::force},         std::pair{"stiffness", Quantity::stiffness},
    std::pair{"damping", Quantity::damping},     std::pair{"mass", Quantity::mass},
    std::pair{"inertia", Quantity::inertia},     std::pair{"imbalance", Quantity::imbalance}};

void read_written(CheckedTable &table, const char *key, Quantity quantity,
                  model::OutputUnits &units) {
    const Node *node = table.find(key);
    if (!node)
        return;
    const auto factor =
        node->kind == Node::Kind::text ? unit_factor(node->text, quantity) : std::nullopt;
    if (!factor)
        table.fail(key, "expected the unit of " + describe(quantity) + " or another one, got " +
                            shown(*node));
    else
        units.of[key] = {std::string(trimmed(node->text)), *factor};
}

} // namespace

const std::vector<UnitPreset> &unit_presets() {
    static const std::vector<UnitPreset> presets{{"si",
                                                  {{"length", "m"},
                                                   {"amplitude", "m"},
                                                   {"speed", "rad/s"},
                                                   {"frequency", "rad/s"},
                                                   {"force", "N"},
                                                   {"stiffness", "N/m"},
                                                   {"damping", "N s/m"},
                                                   {"mass", "kg"},
                                                   {"inertia", "kg m2"},
                                                   {"imbalance", "kg m"}}},
                                                 {"mm-rpm",
                                                  {{"length", "mm"},
                                                   {"amplitude", "um"},
                                                   {"speed", "rpm"},
                                                   {"frequency", "Hz"},
                                                   {"force", "N"},
                                                   {"stiffness", "N/mm"},
                                                   {"damping", "N s/mm"},
                                                   {"mass", "kg"},
                                                   {"inertia", "kg mm2"},
                                                   {"imbalance", "g mm"}}},
                                                 {"us",
                                                  {{"length", "in"},
                                                   {"amplitude", "mil"},
                                                   {"speed", "rpm"},
                                                   {"frequency", "Hz"},
                                                   {"force", "lbf"},
                                                   {"stiffness", "lbf/in"},
                                                   {"damping", "lbf s/in"},
                                                   {"mass", "lb"},
                                                   {"inertia", "lb in2"},
                                                   {"imbalance", "oz in"}}}};
    return presets;
}

void read_units(CheckedTable &root, model::Case &scene) {
    auto table = root.table("units");
    if (!table)
        return;
    std::vector<std::string> names{"none"};
    for (const UnitPreset &preset : unit_presets())
        names.push_back(preset.name);
    const std::size_t chosen = table->choice("preset", names, 0);
    if (chosen > 0)
        for (const auto &[key, unit] : unit_presets()[chosen - 1].units)
            for (const auto &[quantity_key, quantity] : written)
                if (key == quantity_key)
                    scene.units.of[key] = {unit, unit_factor(unit, quantity).value()};
    for (const auto &[key, quantity] : written)
        read_written(*table, key, quantity, scene.units);
    scene.units.peak_to_peak = table->flag_or("peak_to_peak", false);
    scene.units.json = table->flag_or("json", false);
    table->refuse_unknown();
}

} // namespace whirl::input

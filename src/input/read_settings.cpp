#include "input/overrides.h"
#include "input/sections.h"

#include "balancers/pendulum4.h"
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

namespace whirl::input {
namespace {

/// What of results may be written in other units, and its units in each preset.
struct Written {
    Quantity quantity;
    std::array<const char *, 3> units;
};
const std::vector<std::string> presets{"none", "si", "mm-rpm", "us"}; ///< "none" has no units
constexpr std::array written{
    Written{Quantity::length, {"m", "mm", "in"}},
    Written{Quantity::amplitude, {"m", "um", "mil"}},
    Written{Quantity::speed, {"rad/s", "rpm", "rpm"}},
    Written{Quantity::frequency, {"rad/s", "Hz", "Hz"}},
    Written{Quantity::force, {"N", "N", "lbf"}},
    Written{Quantity::stiffness, {"N/m", "N/mm", "lbf/in"}},
    Written{Quantity::receptance, {"m/N", "um/N", "mil/lbf"}},
    Written{Quantity::damping, {"N s/m", "N s/mm", "lbf s/in"}},
    Written{Quantity::mass, {"kg", "kg", "lb"}},
    Written{Quantity::inertia, {"kg m2", "kg mm2", "lb in2"}},
    Written{Quantity::imbalance, {"kg m", "g mm", "oz in"}},
    Written{Quantity::velocity, {"m/s", "mm/s", "in/s"}},
};

void read_written(CheckedTable &table, Quantity quantity, model::OutputUnits &units) {
    const char *key = model::names_of(quantity).key;
    const Node *node = table.find(key);
    if (!node)
        return;
    const auto factor = unit_factor(node->text, quantity);
    if (!factor)
        table.fail(key, "expected the unit of " + describe(quantity) + " or another one, got " +
                            shown(*node) + unit_hint(node->text, quantity));
    else
        units.of[key] = {std::string(trimmed(node->text)), *factor};
}

} // namespace

std::optional<NumericEntries> numeric_entries(CheckedTable &table, const std::string &path,
                                              const std::string &besides) {
    ReadContext &context = table.context();
    const auto of_quantity =
        [](const std::vector<std::string> &paths,
           const std::map<std::string, Quantity> &numeric) -> std::optional<NumericEntries> {
        const auto first = paths.empty() ? numeric.end() : numeric.find(paths.front());
        const bool all = std::ranges::all_of(paths, [&](const std::string &own) {
            const auto found = numeric.find(own);
            return found != numeric.end() && found->second == first->second &&
                   !own.starts_with("map.") && !own.starts_with("samples.") &&
                   !own.starts_with("sweep.");
        });
        return first != numeric.end() && all ? std::optional(NumericEntries{paths, first->second})
                                             : std::nullopt;
    };
    Node tree = context.tree;
    Problems ignored;
    const std::vector<std::string> paths = set_entries(tree, path, "1", {}, ignored);
    auto found = of_quantity(paths, context.numeric);
    if (!found && !paths.empty()) {
        // An entry that the case leaves out is a number if the case with it has one there.
        std::erase_if(tree.items, [](const Node &own) {
            return own.key == "map" || own.key == "samples" || own.key == "sweep";
        });
        ReadContext with_it(tree, context.files);
        with_it.folder = context.folder;
        CheckedTable root({tree, "", with_it});
        (void)read_case(root);
        found = of_quantity(paths, with_it.numeric);
    }
    if (found)
        return found;
    std::vector<std::string> known;
    if (!besides.empty())
        known.push_back(besides);
    for (const auto &entry : context.numeric)
        known.push_back(entry.first);
    table.fail("path", "expected " + (besides.empty() ? "" : in_quotes(besides) + " or ") +
                           "a numeric entry of the case, got " + in_quotes(path) +
                           did_you_mean(path, known));
    return std::nullopt;
}

void read_speeds(CheckedTable &table, model::Case &scene) {
    model::SpeedRange speeds;
    speeds.from = table.number_or("from", 0, Quantity::speed);
    const auto to = table.optional_number("to", Quantity::speed);
    speeds.to = to.value_or(speeds.from);
    speeds.count = table.whole_or("count", to ? 101 : 1, 1, largest_count);
    if (speeds.to < speeds.from || (to && speeds.count > 1 && speeds.to == speeds.from))
        table.fail("to",
                   fmt::format("expected {} from = {}, got {}",
                               speeds.count > 1 ? "more than" : "at least",
                               as_written(table.find("from"), speeds.from, "rad/s", speeds.to),
                               as_written(table.find("to"), speeds.to, "rad/s", speeds.from)));
    if (!table.has("to") && speeds.count > 1)
        table.fail("to", "missing, expected an angular speed in rad/s where count is above 1");
    scene.speeds = speeds;
}

void read_campbell(CheckedTable &table, model::Case &scene) {
    scene.campbell.modes = table.whole_or("modes", scene.campbell.modes, 1, 1000);
    if (table.has("multiples"))
        scene.campbell.multiples = table.numbers("multiples", Quantity::number, Range::positive());
}

void read_modes(CheckedTable &table, model::Case &scene) {
    scene.modes.speed = table.optional_number("speed", Quantity::speed);
}

namespace {

/// Between which stations, and over which frequencies.
void read_receptances(CheckedTable &table, model::Case &scene) {
    const auto read = [](CheckedTable &one, model::Receptance &asked) {
        asked.from = one.number("from", Quantity::length);
        asked.to = one.number("to", Quantity::length);
    };
    const Node *node = table.find("receptance");
    if (node != nullptr && node->kind == Node::Kind::table) {
        auto one = table.table("receptance");
        read(*one, scene.response.receptances.emplace_back());
        one->refuse_unknown();
    } else {
        read_each(table, "receptance", scene.response.receptances, read);
    }
    constexpr std::size_t most = 1000; // each is solved for along two directions
    if (scene.response.receptances.size() > most)
        table.fail("receptance", fmt::format("expected up to {} pairs of stations, got {}", most,
                                             scene.response.receptances.size()));
    if (auto range = table.table("frequencies")) {
        model::SpeedRange &frequencies = scene.response.frequencies;
        frequencies.from = range->number_or("from", 0, Quantity::speed, Range::not_negative());
        frequencies.to = range->number("to", Quantity::speed, Range::positive());
        frequencies.count = range->whole_or("count", 201, 2, largest_count);
        if (frequencies.to <= frequencies.from)
            range->fail("to", fmt::format("expected more than from = {}, got {}",
                                          as_written(range->find("from"), frequencies.from, "rad/s",
                                                     frequencies.to),
                                          as_written(range->find("to"), frequencies.to, "rad/s",
                                                     frequencies.from)));
        range->refuse_unknown();
    }
    if (table.has("receptance") != table.has("frequencies"))
        table.fail(table.has("receptance") ? "frequencies" : "receptance",
                   "missing, expected receptance (between which stations) and frequencies (of the "
                   "force) together");
}

} // namespace

void read_response(CheckedTable &table, model::Case &scene) {
    scene.response.gravity = table.number_or("gravity", 0, Quantity::acceleration);
    scene.response.orbits_at = table.numbers("orbits_at", Quantity::speed);
    scene.response.shape_at = table.numbers("shape_at", Quantity::speed);
    read_receptances(table, scene);
}

void read_balance(CheckedTable &table, model::Case &scene) {
    scene.balance.balanced_position = table.flag_or("balanced_position", true);
    scene.balance.simulated = table.whole_or("simulated", 0, 0, 1000);
    if (scene.balance.simulated > 0 && !table.context().tree.find("simulate"))
        table.fail("simulated", "expected a section [simulate] that says how long the motions "
                                "are, got none");
    read_each(table, "designs", scene.balance.designs,
              [](CheckedTable &entry, model::PendulumDesign &design) {
                  design.arm = entry.number("arm", Quantity::length, Range::positive());
                  design.pivot = entry.number("pivot", Quantity::length, Range::positive());
              });
    if (table.has("external_damping"))
        scene.balance.external_damping =
            table.numbers("external_damping", Quantity::number, Range::not_negative());
    const bool pendulums = !balancers::pendulums_in(scene.rotor).empty();
    for (const char *key : {"designs", "external_damping"})
        if (table.has(key) && !pendulums)
            table.fail(key, "expected only with a balancer of kind = \"pendulum4\", got none");
}

void read_states(CheckedTable &table, model::Case &scene) {
    model::StatesSettings states;
    states.speeds = table.numbers("speeds", Quantity::speed);
    std::ranges::sort(states.speeds);
    states.max_balls = table.whole_or("max_balls", states.max_balls, 1, 12);
    constexpr std::size_t most = 10000;
    if (states.speeds.size() > most)
        table.fail("speeds",
                   fmt::format("expected up to {} speeds, got {}", most, states.speeds.size()));
    scene.states = states;
}

void read_map(CheckedTable &table, model::Case &scene) {
    model::MapSettings map;
    for (const auto &[key, axis] : {std::pair("x", &map.x), std::pair("y", &map.y)}) {
        if (auto own = table.table(key))
            *axis = read_map_axis(*own, scene.rotor);
        else if (!table.has(key) && (axis == &map.x || !scene.states))
            table.fail(key, "missing, expected a table {path, from, to, count}");
    }
    // Without y the steady states are followed over x.
    const bool alone = !table.has("y") && scene.states && !map.x.values.empty();
    if (alone && map.x.is_speed())
        table.fail("x", "expected an entry of the case, or a second one, y, got the speed: over "
                        "that [states] follows the states without [map]");
    const std::size_t speeds = !alone                            ? 1
                               : scene.states->speeds.size() > 0 ? scene.states->speeds.size()
                               : scene.speeds ? static_cast<std::size_t>(scene.speeds->count)
                                              : 1;
    if (alone && speeds != 1)
        table.fail("y", fmt::format("missing: without it the states are followed over x at one "
                                    "speed, expected one in states.speeds, got {}",
                                    speeds));
    if (alone && map.x.label.starts_with("states."))
        table.fail("x", "expected an entry of the rotor, over which states are followed, got " +
                            in_quotes(map.x.label));
    if (map.x.label == "speed" && map.y.label == "speed")
        table.fail("y", "expected another entry than x, got " + in_quotes(map.y.label) + " twice");
    refuse_twice(table, {map.x, map.y});
    scene.map = map;
}

void read_units(CheckedTable &table, model::Case &scene) {
    const std::size_t chosen = table.choice("preset", presets, 0);
    for (const auto &[quantity, units] : written) {
        if (chosen > 0) {
            const char *unit = units.at(chosen - 1);
            scene.units.of[model::names_of(quantity).key] = {unit,
                                                             unit_factor(unit, quantity).value()};
        }
        read_written(table, quantity, scene.units);
    }
    scene.units.peak_to_peak = table.flag_or("peak_to_peak", false);
    scene.units.json = table.flag_or("json", false);
}

} // namespace whirl::input

#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {

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

namespace {

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

/// A section that counts from the operating speeds.
void need_operation(const CheckedTable &table, const std::string &why) {
    if (!table.context().tree.find("operation"))
        table.fail("expected a section [operation], " + why + ", got none");
}

/// A word that must be there.
std::size_t needed_choice(CheckedTable &table, const std::string &key,
                          const std::vector<std::string> &words, const char *why) {
    if (!table.has(key)) {
        std::string quoted;
        for (const std::string &word : words)
            quoted += (quoted.empty() ? "" : " or ") + in_quotes(word);
        table.fail(key, fmt::format("missing, expected {}: {}", quoted, why));
    }
    return table.choice(key, words, 0);
}

/// Mistakes of entries that say something of another one that is not there.
/// @param got  in place of that one
void refuse_without(CheckedTable &table, bool there, const std::vector<const char *> &keys,
                    const char *other, const std::string &got = "none") {
    for (const char *key : keys)
        if (table.has(key) && !there)
            table.fail(key, fmt::format("expected only with {}, got {}", other, got));
}

} // namespace

void read_operation(CheckedTable &table, model::Case &scene) {
    model::Operation operation;
    operation.from = table.number("from", Quantity::speed, Range::not_negative());
    operation.to = table.number("to", Quantity::speed, Range::positive());
    operation.normal = table.optional_number("normal", Quantity::speed, Range::positive());
    operation.trip = table.optional_number("trip", Quantity::speed, Range::positive());
    const auto written = [&table](const char *key, double value, double other) {
        return as_written(table.find(key), value, "rad/s", other);
    };
    if (operation.to <= operation.from)
        table.fail("to", fmt::format("expected more than from = {}, got {}",
                                     written("from", operation.from, operation.to),
                                     written("to", operation.to, operation.from)));
    if (operation.normal &&
        (*operation.normal < operation.from || *operation.normal > operation.to)) {
        const bool below = *operation.normal < operation.from;
        const double end = below ? operation.from : operation.to;
        table.fail("normal", fmt::format("expected {} {} = {}, got {}",
                                         below ? "at least" : "at most", below ? "from" : "to",
                                         written(below ? "from" : "to", end, *operation.normal),
                                         written("normal", *operation.normal, end)));
    }
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
    need_operation(table, "at whose highest speed cross coupling is added");
}

void read_limits(CheckedTable &table, model::Case &scene) {
    model::Limits limits;
    limits.shaft = table.optional_number("shaft", Quantity::amplitude, Range::positive());
    if (limits.shaft)
        limits.shaft_reading = needed_choice(table, "shaft_reading", {"peak to peak", "peak"},
                                             "whether it is twice the amplitude or once") == 0
                                   ? model::Reading::peak_to_peak
                                   : model::Reading::peak;
    refuse_without(table, limits.shaft.has_value(), {"shaft_reading"}, "shaft");
    if (table.has("shaft_standard"))
        limits.shaft_standard = static_cast<model::ShaftStandard>(
            table.choice("shaft_standard", {"api617", "iso20816-3"}, 0));
    limits.velocity = table.optional_number("velocity", Quantity::velocity, Range::positive());
    if (limits.velocity)
        limits.velocity_reading = needed_choice(table, "velocity_reading", {"rms", "peak"},
                                                "which differ by the square root of 2") == 0
                                      ? model::Reading::rms
                                      : model::Reading::peak;
    refuse_without(table, limits.velocity.has_value(), {"velocity_reading"}, "velocity");
    const bool housings = table.has("pedestal_standard");
    if (housings) {
        (void)table.choice("pedestal_standard", {"iso20816-3"}, 0);
        if (!table.has("group"))
            table.fail("group", "missing, expected 1 (large machines) or 2 (medium ones)");
        model::HousingClass &of = limits.pedestals.emplace();
        of.group = table.whole_or("group", 1, 1, 2);
        of.flexible = needed_choice(table, "support", {"rigid", "flexible"},
                                    "what the machine stands on") == 1;
    }
    refuse_without(table, housings, {"group", "support"}, "pedestal_standard");
    const bool zones = housings || limits.shaft_standard == model::ShaftStandard::iso20816;
    if (zones)
        limits.zone = static_cast<model::Zone>(needed_choice(
            table, "zone", {"A/B", "B/C", "C/D"}, "the boundary that must not be crossed"));
    const Node *other = table.find("shaft_standard");
    refuse_without(table, zones, {"zone"}, "a standard that has zones, iso20816-3",
                   other != nullptr ? shown(*other) + " alone" : "none");
    limits.clearance = table.optional_number("clearance", Quantity::number, Range::positive());
    limits.scaled = table.flag_or("scaled", true);
    limits.scale_most =
        table.optional_number("scale_most", Quantity::number, {1, Range::infinity, false, false});
    refuse_without(table, limits.clearance.has_value(), {"scaled", "scale_most"}, "clearance");
    if (!limits.scaled && limits.scale_most)
        table.fail("scale_most", "expected only with scaled = true, got scaled = false");
    if (!limits.shaft && !limits.shaft_standard && !limits.velocity && !housings &&
        !limits.clearance)
        table.fail("expected at least one of shaft, shaft_standard, velocity, pedestal_standard "
                   "and clearance, got none");
    scene.limits = limits;
    need_operation(table, "over whose speeds limits are judged");
}

namespace {

/// What API 617 places imbalances by: the loads of two journals, and modes that a rotor has.
void refuse_what_api617_is_not_for(CheckedTable &table, const model::Rotor &rotor) {
    const auto supports = rotor.supports();
    const auto fail = [&table](const std::string &what) {
        table.fail("unbalance", "expected " + what);
    };
    if (!rotor.balancers.empty())
        fail("a rotor without balancers, whose parts go where the imbalance lets them, got "
             "[[balancer]]");
    if (!rotor.anisotropies.empty() || rotor.shaft.asymmetric())
        fail("a rotor that is the same from every direction, got one with [[anisotropy]] or two "
             "bending stiffnesses, on which it matters in which of them a weight is");
    if (supports.size() != 2)
        fail(fmt::format("two bearings, whose loads the imbalances come from, got {}",
                         supports.size()));
    else if (supports[0].z == supports[1].z)
        fail("two bearings with a distance between them, got both at one place");
}

/// Which tables of the bearings are wanted: none without mistakes where there are none.
void read_fits(CheckedTable &table, const model::Rotor &rotor,
               std::vector<model::BearingFit> &fits) {
    const auto list = table.entry("clearances");
    if (!list)
        return;
    const std::vector<std::string> words{"min", "max"};
    if (!list->node.is_list())
        list->fail(R"(expected a list of "min" and "max", got )" + shown(list->node));
    for (const CheckedEntry &item : list->items()) {
        const auto word = std::ranges::find(words, item.node.text);
        if (word == words.end()) {
            item.fail(one_of(words, item.node));
            continue;
        }
        const bool least = word == words.begin();
        const auto fit = least ? model::BearingFit::least : model::BearingFit::most;
        if (std::ranges::find(fits, fit) != fits.end()) {
            item.fail("expected each once, got " + shown(item.node) + " again");
            continue;
        }
        fits.push_back(fit);
        if (std::ranges::none_of(rotor.bearings, [least](const model::Bearing &bearing) {
                return least ? bearing.least.has_value() : bearing.most.has_value();
            }))
            item.fail(fmt::format("expected a bearing or seal with table_{0}, got none with one "
                                  "that can be read",
                                  *word));
    }
}

} // namespace

void read_standard(CheckedTable &table, model::Case &scene) {
    model::StandardSettings standard;
    if (table.has("unbalance")) {
        (void)table.choice("unbalance", {"api617"}, 0);
        standard.api617 = true;
        refuse_what_api617_is_not_for(table, scene.rotor);
    }
    read_fits(table, scene.rotor, standard.fits);
    if (!table.has("unbalance") && !table.has("clearances"))
        table.fail("expected unbalance or clearances, got neither");
    if (!table.context().tree.find("speeds"))
        table.fail("expected a section [speeds], over which the response is computed, got none");
    if (standard.api617 && standard.fits.empty())
        standard.fits.push_back(model::BearingFit::given);
    if (!standard.fits.empty()) // an empty list asks for nothing
        scene.standard = standard;
    need_operation(table, "whose maximum speed the imbalances are for and whose speeds the runs "
                          "are judged at");
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

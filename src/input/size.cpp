#include "input/size.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace whirl::input {
namespace {

double points_of(const model::MapSettings &map) {
    return static_cast<double>(map.x.values.size()) *
           std::max(1.0, static_cast<double>(map.y.values.size()));
}

constexpr double kilobyte = 1e3;
constexpr double gigabyte = 1e9;

/// Places of a shaft that all results have a curve or a row of; the model has a node at each.
constexpr std::size_t most_places = 10000;

/// Points of a map: at a millisecond each (docs/scaling.md) more than a day.
constexpr double most_points = 1e8;

/// Memory of a command for one element of order p, kB: each + linear p + square p^2. Measured with
/// 4,000 elements of orders 1 and 4 and 10,000 of order 10 (show, campbell); rounded down.
struct ElementMemory {
    const char *command;
    double each, linear, square;
};
constexpr std::array element_memory{
    ElementMemory{"show", 0, 10.5, 3.1},    ElementMemory{"campbell", 32, 14.4, 1.9},
    ElementMemory{"critical", 22, 14, 0.6}, ElementMemory{"response", 2, 10, 0.2},
    ElementMemory{"modes", 0, 6.5, 1.6},    ElementMemory{"stability", 0, 3.5, 1.2},
};
constexpr ElementMemory of_others{"", 0, 3.5, 1.2}; // the least of them

/// A number of a result, in the lists of the analysis, in those of the report and as text, bytes.
constexpr double answer = 40;

std::size_t places(const model::Rotor &rotor) {
    return rotor.discs.size() + rotor.bearings.size() + rotor.anisotropies.size() +
           rotor.balancers.size() + rotor.planes.size() + rotor.imbalances.size() +
           rotor.forces.size() + rotor.probes.size();
}

double elements(const model::Rotor &rotor) {
    double sum = 0;
    for (const model::Segment &segment : rotor.shaft.segments)
        sum += segment.elements;
    return sum;
}

int least_order(const model::Shaft &shaft) { return shaft.order_auto ? 1 : shaft.order; }

double model_memory(const model::Case &scene, const std::string &command) {
    if (scene.rotor.shaft.rigid)
        return 0;
    const auto known = std::ranges::find_if(
        element_memory, [&](const ElementMemory &at) { return at.command == command; });
    const ElementMemory &of = known == element_memory.end() ? of_others : *known;
    const double p = least_order(scene.rotor.shaft);
    const double count = // a node at each place divides one
        elements(scene.rotor) + static_cast<double>(places(scene.rotor));
    return count * (of.each + of.linear * p + of.square * p * p) * kilobyte;
}

/// Numbers that a command answers beside the model, and what of the case they are counted by.
struct Answers {
    double numbers = 0;
    std::string key, counted;
};

Answers answers_of(const model::Case &scene, const std::string &command) {
    const double speeds = scene.speeds ? scene.speeds->count : 1;
    const double stations = static_cast<double>(places(scene.rotor)) + 2; // and the ends
    if (command == "campbell")
        return {speeds * scene.campbell.modes * 8, "speeds.count",
                fmt::format("{:.0f} speeds with {} modes each", speeds, scene.campbell.modes)};
    if (command == "response") {
        const double frequencies = scene.response.frequencies.count;
        const auto receptances = static_cast<double>(scene.response.receptances.size());
        if (receptances * frequencies * 12 > speeds * stations * 6) // three numbers a direction
            return {
                receptances * frequencies * 12, "response.frequencies.count",
                fmt::format("{:.0f} frequencies of {:.0f} receptances", frequencies, receptances)};
        return {speeds * stations * 6, "speeds.count",
                fmt::format("{:.0f} speeds at {:.0f} stations each", speeds, stations)};
    }
    if (command == "stability" && scene.map)
        return {points_of(*scene.map), "map",
                fmt::format("{} times {} points", scene.map->x.values.size(),
                            scene.map->y.values.size())};
    if (command == "samples" && scene.samples)
        return {static_cast<double>(scene.samples->count) *
                    (static_cast<double>(scene.samples->vary.size()) + 1),
                "samples.count",
                fmt::format("{} samples of {} entries", scene.samples->count,
                            scene.samples->vary.size())};
    if (command == "simulate") {
        const bool balancers = !scene.rotor.balancers.empty();
        const double curves =
            balancers ? static_cast<double>(scene.rotor.balancers.size()) : stations;
        return {scene.simulate.output_points * 3.0 * curves, "simulate.output_points",
                fmt::format("{} times of {:.0f} {}", scene.simulate.output_points, curves,
                            balancers ? "balancers" : "stations")};
    }
    return {};
}

/// What makes a shaft of many elements: the count of the segment that has most of them, where it is
/// given, else of all; else the order, or how many segments there are.
std::string cause_of_elements(const model::Shaft &shaft, const Node &tree) {
    const auto most = std::ranges::max_element(shaft.segments, {}, &model::Segment::elements);
    for (const std::string &key :
         {fmt::format("shaft.segments[{}].elements", most - shaft.segments.begin()),
          std::string("shaft.elements")})
        if (const Node *given = find_path(tree, key); given && given->number == most->elements)
            return key;
    return most->elements > 1 ? "shaft.table" : "shaft";
}

} // namespace

void check_counts(const model::Case &scene, const Check &check) {
    const model::Rotor &rotor = scene.rotor;
    if (places(rotor) > most_places) {
        const std::array<std::pair<const char *, std::size_t>, 8> lists{
            {{"disc", rotor.discs.size()},
             {"bearing", rotor.bearings.size()},
             {"anisotropy", rotor.anisotropies.size()},
             {"balancer", rotor.balancers.size()},
             {"plane", rotor.planes.size()},
             {"imbalance", rotor.imbalances.size()},
             {"force", rotor.forces.size()},
             {"probe", rotor.probes.size()}}};
        const auto longest =
            std::ranges::max_element(lists, {}, [](auto &list) { return list.second; });
        check.fail(longest->first,
                   fmt::format("expected up to {} places on the shaft where something is attached, "
                               "got {}",
                               most_places, places(rotor)));
    }
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        if (const auto *balls = std::get_if<model::Balls>(&rotor.balancers[i].parts)) {
            double count = 0;
            for (const model::BallRow &row : balls->rows)
                count += row.n;
            if (count > most_parts)
                check.fail(fmt::format("balancer[{}].rows", i),
                           fmt::format("expected up to {} balls in all rows together, got {:.0f}",
                                       most_parts, count));
        }
    if (!scene.map)
        return;
    const double points = points_of(*scene.map);
    if (points > most_points)
        check.fail("map", fmt::format("expected up to {:.0f} points, which take a day at a "
                                      "millisecond each, got {} times {} = {:.0f}",
                                      most_points, scene.map->x.values.size(),
                                      scene.map->y.values.size(), points));
}

double least_memory(const model::Case &scene, const std::string &command) {
    return model_memory(scene, command) + answer * answers_of(scene, command).numbers;
}

void refuse_too_large(const model::Case &scene, const std::string &command, double memory,
                      const Node &tree) {
    if (command == "report") { // one after another: the largest of them decides
        for (const ElementMemory &part : element_memory)
            refuse_too_large(scene, part.command, memory, tree);
        return;
    }
    const double model = model_memory(scene, command);
    if (least_memory(scene, command) <= memory)
        return;
    const Answers answers = answers_of(scene, command);
    const bool shaft = model > answer * answers.numbers;
    Problems problems;
    Check{tree, problems}.fail(
        shaft ? cause_of_elements(scene.rotor.shaft, tree) : answers.key,
        fmt::format("expected what fits into the memory of this machine, {:.3g} GB, got {}, for "
                    "which {} takes {:.3g} GB or more",
                    memory / gigabyte,
                    shaft ? fmt::format("{:.0f} elements of order {}", elements(scene.rotor),
                                        least_order(scene.rotor.shaft))
                          : answers.counted,
                    command, least_memory(scene, command) / gigabyte));
    problems.throw_if_any();
}

} // namespace whirl::input

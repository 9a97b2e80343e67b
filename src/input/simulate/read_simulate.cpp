#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

/// {from, to, duration} of a run-up or run-down, which may begin later.
std::vector<std::pair<double, double>> read_ramp(CheckedTable ramp) {
    const double from = ramp.number_or("from", 0, Quantity::speed);
    const double to = ramp.number("to", Quantity::speed);
    const double duration = ramp.number("duration", Quantity::time, Range::positive());
    const double start = ramp.number_or("start", 0, Quantity::time, Range::not_negative());
    ramp.refuse_unknown();
    return {{start, from}, {start + duration, to}};
}

/// Pairs [time, speed] of a run-up.
std::vector<std::pair<double, double>> read_run_up(CheckedTable &table) {
    const auto list = table.entry("run_up");
    if (!list)
        return {};
    if (list->node.kind == Node::Kind::table)
        return read_ramp(*table.table("run_up"));
    if (list->items().empty())
        list->fail("expected a list of pairs [time, speed] or {from, to, duration}, got " +
                   shown(list->node));
    std::vector<std::pair<double, double>> points;
    for (const CheckedEntry &pair : list->items()) {
        const std::vector<CheckedEntry> numbers = pair.items();
        if (numbers.size() != 2) {
            pair.fail("expected a pair [time, speed], got " + shown(pair.node));
            continue;
        }
        const double time = numbers[0].number(Quantity::time, Range::not_negative());
        const double speed = numbers[1].number(Quantity::speed);
        if (!points.empty() && time <= points.back().first)
            pair.fail(fmt::format("expected times that ascend, got {} s after {} s", time,
                                  points.back().first));
        points.emplace_back(time, speed);
    }
    return points;
}

/// Lists of angles, one for each balancer.
std::vector<std::vector<double>> angles_of(const CheckedEntry &list) {
    if (!list.node.is_list())
        list.fail("expected a list of angles for each balancer, got " + shown(list.node));
    std::vector<std::vector<double>> angles;
    for (const CheckedEntry &item : list.items()) {
        if (!item.node.is_list())
            item.fail("expected a list of angles in rad, got " + shown(item.node));
        angles.push_back(item.numbers(Quantity::angle));
    }
    return angles;
}

void read_starts(CheckedTable &table, model::SimulateSettings &simulate) {
    if (const auto angles = table.entry("ball_angles"))
        simulate.ball_angles = angles_of(*angles);
    const auto others = table.entry("other_starts");
    if (!others)
        return;
    if (!others->node.is_list())
        others->fail("expected a list of starts, each like ball_angles, got " +
                     shown(others->node));
    for (const CheckedEntry &start : others->items()) {
        const auto angles = angles_of(start);
        if (start.node.is_list())
            simulate.other_starts.push_back(angles);
    }
}

/// The motor that drives the rotor, where its speed is not prescribed.
void read_motor(CheckedTable &table, const model::Rotor &rotor, model::SimulateSettings &simulate) {
    simulate.torque = table.optional_number("torque", Quantity::moment);
    simulate.torque_slope =
        table.number_or("torque_slope", 0, Quantity::tilt_damping, Range::not_negative());
    simulate.inertia = table.number_or("inertia", 0, Quantity::inertia, Range::not_negative());
    if (simulate.torque && !simulate.run_up.empty())
        table.fail("torque", "expected either run_up or the torque of a motor, got both");
    for (const model::Balancer &b : rotor.balancers)
        if (const auto *balls = std::get_if<model::Balls>(&b.parts);
            simulate.torque && !b.held && balls && (balls->contact || balls->resists()))
            table.fail("torque", "expected a prescribed speed (run_up, or [speeds]) where balls "
                                 "touch or resist rolling, got the torque of a motor");
    for (const char *key : {"torque_slope", "inertia"})
        if (!simulate.torque && table.has(key))
            table.fail(key, "expected only together with torque, got it alone");
}

/// Over which speeds a limit cycle is followed.
void read_cycle(CheckedTable &table, model::CycleSettings &cycle) {
    if (table.has("from") || table.has("to") || table.has("count")) {
        model::SpeedRange &speeds = cycle.speeds.emplace();
        speeds.from = table.number("from", Quantity::speed, Range::positive());
        speeds.to = table.number("to", Quantity::speed, Range::positive());
        speeds.count = table.whole_or("count", 41, 2, 10000);
        if (speeds.to <= speeds.from)
            table.fail("to",
                       fmt::format("expected more than from = {}, got {}",
                                   as_written(table.find("from"), speeds.from, "rad/s", speeds.to),
                                   as_written(table.find("to"), speeds.to, "rad/s", speeds.from)));
    }
    table.refuse_unknown();
}

/// What the integration keeps and writes.
void read_simulate_options(CheckedTable &table, model::Case &scene) {
    model::SimulateSettings &simulate = scene.simulate;
    simulate.gravity = table.number_or("gravity", 0, Quantity::acceleration);
    simulate.output_points =
        table.whole_or("output_points", simulate.output_points, 400, largest_count);
    simulate.modes = table.whole_or("modes", 0, 0, 10000);
    simulate.reduction_tolerance = table.number_or(
        "reduction_tolerance", simulate.reduction_tolerance, Quantity::number, Range::inside(0, 1));
    if (std::ranges::all_of(scene.rotor.balancers, &model::Balancer::held) &&
        !table.has("reduction_tolerance"))
        simulate.reduction_tolerance = 1e-4; // without balls it is the largest error there is
    if (auto cycle = table.table("cycle")) {
        read_cycle(*cycle, simulate.cycle.emplace());
    }
    if (const auto restart = table.text("restart"))
        simulate.restart = *restart;
}

} // namespace

void read_simulate(CheckedTable &table, model::Case &scene) {
    model::SimulateSettings &simulate = scene.simulate;
    simulate.time = table.number("time", Quantity::time, Range::positive());
    simulate.run_up = read_run_up(table);
    read_starts(table, simulate);
    simulate.tolerance =
        table.number_or("tolerance", simulate.tolerance, Quantity::number, Range::inside(0, 1));
    read_motor(table, scene.rotor, simulate);
    read_outside(table, scene);
    read_simulate_options(table, scene);
}

} // namespace whirl::input

#include "balancers/kind.h"
#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

constexpr int points_a_hold = 120; ///< of the time series: forty tell the motion there
constexpr int most_held = 10000;
constexpr int most_grid = 1000;

/// The speeds of [simulate.sweep], up and down again, behind the motion so far.
void read_sweep_in_time(CheckedTable &table, model::SimulateSettings &simulate) {
    const double from = table.number("from", Quantity::speed, Range::positive());
    const double to = table.number("to", Quantity::speed, Range::positive());
    const int count = table.whole("count", 2, most_held);
    const auto hold = table.optional_number("hold", Quantity::time, Range::positive());
    const auto turns = table.optional_number("turns", Quantity::number, Range::positive());
    const auto ramp = table.optional_number("ramp", Quantity::time, Range::positive());
    const bool down = table.flag_or("down", true);
    table.refuse_unknown();
    if (hold.has_value() == turns.has_value())
        table.fail("hold",
                   "expected either hold (time at each speed) or turns at each speed, got " +
                       std::string(hold ? "both" : "neither"));
    if (to <= from)
        table.fail("to", fmt::format("expected more than from = {} rad/s, got {} rad/s", from, to));
    if (!simulate.run_up.empty() && simulate.run_up.back().first > simulate.time)
        table.fail(fmt::format("expected a run-up that ends before the sweep begins, at time = {} "
                               "s, got one until {} s",
                               simulate.time, simulate.run_up.back().first));
    if (!(to > from) || hold.has_value() == turns.has_value())
        return;
    if (simulate.run_up.empty())
        simulate.run_up = {{0, from}};
    if (simulate.run_up.back().first < simulate.time)
        simulate.run_up.emplace_back(simulate.time, simulate.run_up.back().second);
    for (int k = 0; k < (down ? 2 * count - 1 : count); ++k) {
        const bool up = k < count;
        const int place = up ? k : 2 * count - 2 - k;
        const double speed = from + (to - from) * place / (count - 1);
        const double length = hold ? *hold : *turns * 2 * std::numbers::pi / speed;
        const double reached = simulate.time + ramp.value_or(length / 4);
        simulate.time = reached + length;
        simulate.held.push_back({up, speed, reached, simulate.time});
        simulate.run_up.insert(simulate.run_up.end(), {{reached, speed}, {simulate.time, speed}});
    }
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

/// [simulate.starts]; `angles`: two places among all angles that say where a motion starts.
model::StartsSettings read_many_starts(CheckedTable &table, const model::Rotor &rotor) {
    model::StartsSettings starts;
    std::size_t all = 0;
    for (const model::Balancer &b : rotor.balancers)
        all += b.held ? 0 : balancers::kind_of(b)->start_angles();
    if (all == 0)
        table.fail("expected a case with balancers that are not held, got none");
    starts.grid = table.choice("kind", {"random", "grid"}, 0) == 1;
    starts.count = table.whole("count", 1, starts.grid ? most_grid : largest_count);
    starts.seed = table.whole_or("seed", starts.seed, 0, std::numeric_limits<int>::max());
    const auto list = table.entry("angles");
    if (list && (!list->node.is_list() || list->items().size() != 2))
        list->fail("expected the places of two angles, from 0, got " + shown(list->node));
    else if (list)
        for (std::size_t k = 0; k < 2; ++k)
            starts.angles.at(k) =
                list->items()[k].whole(0, static_cast<int>(std::max<std::size_t>(all, 1)) - 1);
    if (starts.grid && all > 0 &&
        (all < 2 || (list && starts.angles.front() == starts.angles.back())))
        table.fail(list ? "angles" : "kind", "expected two angles that differ, of a balancer or of "
                                             "two, for a grid");
    table.refuse_unknown();
    return starts;
}

void read_starts(CheckedTable &table, const model::Rotor &rotor,
                 model::SimulateSettings &simulate) {
    if (const auto angles = table.entry("ball_angles"))
        simulate.ball_angles = angles_of(*angles);
    const auto others = table.entry("other_starts");
    if (auto many = table.table("starts"))
        simulate.starts = read_many_starts(*many, rotor);
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
            simulate.torque && !b.held && balls &&
            (balls->contact || balls->resists() || balls->release_speed || !balls->walls.empty()))
            table.fail("torque", "expected a prescribed speed (run_up, or [speeds]) where balls "
                                 "touch, resist rolling, meet walls or are released at a speed, "
                                 "got the torque of a motor");
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

/// Points of the time series with which each speed of a sweep has enough of them.
double points_of_sweep(const model::SimulateSettings &simulate) {
    double shortest = simulate.time;
    for (const model::HeldSpeed &held : simulate.held)
        shortest = std::min(shortest, held.until - held.from);
    return simulate.held.empty() ? 400 : std::ceil(points_a_hold * simulate.time / shortest);
}

/// What the integration keeps and writes.
void read_simulate_options(CheckedTable &table, model::Case &scene) {
    model::SimulateSettings &simulate = scene.simulate;
    simulate.gravity = table.number_or("gravity", 0, Quantity::acceleration);
    const double points = points_of_sweep(simulate);
    simulate.output_points = table.whole_or(
        "output_points",
        std::max(simulate.output_points, static_cast<int>(std::min(points, 1.0 * largest_count))),
        400, largest_count);
    if (points > largest_count)
        table.fail("sweep",
                   fmt::format("expected a motion of at most {} points of the time series, "
                               "{} a speed, got {:.0f}",
                               largest_count, points_a_hold, points));
    else if (simulate.output_points < points)
        table.fail("output_points",
                   fmt::format("expected at least {:.0f}, {} a speed of the sweep, "
                               "got {}",
                               points, points_a_hold, simulate.output_points));
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
    if (auto sweep = table.table("sweep")) {
        if (table.has("torque"))
            sweep->fail("expected a prescribed speed, got the torque of a motor");
        read_sweep_in_time(*sweep, simulate);
    }
    read_starts(table, scene.rotor, simulate);
    simulate.tolerance =
        table.number_or("tolerance", simulate.tolerance, Quantity::number, Range::inside(0, 1));
    read_motor(table, scene.rotor, simulate);
    read_outside(table, scene);
    read_simulate_options(table, scene);
}

} // namespace whirl::input

#include "input/sections.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

/// {from, to, duration} of a run-up or run-down, which may begin later.
std::vector<std::pair<double, double>> read_ramp(CheckedTable ramp) {
    const double from = ramp.number_or("from", 0, Quantity::angular_speed);
    const double to = ramp.number("to", Quantity::angular_speed);
    const double duration = ramp.number("duration", Quantity::time, Range::positive());
    const double start = ramp.number_or("start", 0, Quantity::time, Range::not_negative());
    ramp.refuse_unknown();
    return {{start, from}, {start + duration, to}};
}

/// Pairs [time, speed] of a run-up.
std::vector<std::pair<double, double>> read_run_up(CheckedTable &table) {
    const Node *list = table.find("run_up");
    if (!list)
        return {};
    if (list->kind == Node::Kind::table)
        return read_ramp(*table.table("run_up"));
    if (list->kind != Node::Kind::list || list->items.empty()) {
        table.fail("run_up", "expected a list of pairs [time, speed] or {from, to, "
                             "duration}, got " +
                                 shown(*list));
        return {};
    }
    ReadContext &context = table.context();
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
        const Node &item = list->items[i];
        const std::string path = fmt::format("{}[{}]", table.path_of("run_up"), i);
        if (item.kind != Node::Kind::list || item.items.size() != 2) {
            context.problems.add(item.origin, path,
                                 "expected a pair [time, speed], got " + shown(item));
            continue;
        }
        const double time =
            context.number(item.items[0], path + "[0]", Quantity::time, Range::not_negative());
        const double speed =
            context.number(item.items[1], path + "[1]", Quantity::angular_speed, Range::any());
        if (!points.empty() && time <= points.back().first)
            context.problems.add(item.origin, path,
                                 fmt::format("expected times that ascend, got {} s after {} s",
                                             time, points.back().first));
        points.emplace_back(time, speed);
    }
    return points;
}

/// Lists of angles, one for each balancer.
std::vector<std::vector<double>> angles_of(const Node &list, const std::string &of,
                                           ReadContext &context) {
    std::vector<std::vector<double>> angles;
    if (list.kind != Node::Kind::list) {
        context.problems.add(list.origin, of,
                             "expected a list of angles for each balancer, got " + shown(list));
        return angles;
    }
    for (std::size_t i = 0; i < list.items.size(); ++i) {
        const Node &item = list.items[i];
        const std::string path = fmt::format("{}[{}]", of, i);
        angles.emplace_back();
        if (item.kind != Node::Kind::list) {
            context.problems.add(item.origin, path,
                                 "expected a list of angles in rad, got " + shown(item));
            continue;
        }
        for (std::size_t j = 0; j < item.items.size(); ++j)
            angles.back().push_back(context.number(item.items[j], fmt::format("{}[{}]", path, j),
                                                   Quantity::angle, Range::any()));
    }
    return angles;
}

void read_starts(CheckedTable &table, model::SimulateSettings &simulate) {
    ReadContext &context = table.context();
    if (const Node *angles = table.find("ball_angles"))
        simulate.ball_angles = angles_of(*angles, table.path_of("ball_angles"), context);
    const Node *others = table.find("other_starts");
    if (!others)
        return;
    if (others->kind != Node::Kind::list) {
        table.fail("other_starts",
                   "expected a list of starts, each like ball_angles, got " + shown(*others));
        return;
    }
    for (std::size_t i = 0; i < others->items.size(); ++i) {
        const Node &item = others->items[i];
        const auto start =
            angles_of(item, fmt::format("{}[{}]", table.path_of("other_starts"), i), context);
        if (item.kind == Node::Kind::list)
            simulate.other_starts.push_back(start);
    }
}

/// The motor that drives the rotor, where its speed is not prescribed.
void read_motor(CheckedTable &table, const model::Rotor &rotor, model::SimulateSettings &simulate) {
    simulate.torque = table.optional_number("torque", Quantity::torque);
    simulate.torque_slope =
        table.number_or("torque_slope", 0, Quantity::tilt_damping, Range::not_negative());
    simulate.inertia = table.number_or("inertia", 0, Quantity::inertia, Range::not_negative());
    if (simulate.torque && !simulate.run_up.empty())
        table.fail("torque", "expected either run_up or the torque of a motor, got both");
    for (const model::Balancer &b : rotor.balancers)
        if (const auto *balls = std::get_if<model::Balls>(&b.parts);
            simulate.torque && balls && (balls->contact || balls->resists()))
            table.fail("torque", "expected a prescribed speed (run_up, or [speeds]) where balls "
                                 "touch or resist rolling, got the torque of a motor");
    for (const char *key : {"torque_slope", "inertia"})
        if (!simulate.torque && table.has(key))
            table.fail(key, "expected only together with torque, got it alone");
}

/// What the integration keeps and writes.
void read_simulate_options(CheckedTable &table, model::Case &scene) {
    model::SimulateSettings &simulate = scene.simulate;
    simulate.gravity = table.number_or("gravity", 0, Quantity::acceleration);
    simulate.output_points =
        table.whole_or("output_points", simulate.output_points, 400, largest_count);
    simulate.modes = table.whole_or("modes", 0, 0, 10000);
    simulate.reduction_tolerance =
        table.number_or("reduction_tolerance", simulate.reduction_tolerance,
                        Quantity::dimensionless, Range::inside(0, 1));
    if (scene.rotor.balancers.empty() && !table.has("reduction_tolerance"))
        simulate.reduction_tolerance = 1e-4; // without balls it is the largest error there is
    if (const auto restart = table.text("restart"))
        simulate.restart = *restart;
}

} // namespace

void read_simulate(CheckedTable &root, model::Case &scene) {
    auto table = root.table("simulate");
    if (!table)
        return;
    model::SimulateSettings &simulate = scene.simulate;
    simulate.time = table->number("time", Quantity::time, Range::positive());
    simulate.run_up = read_run_up(*table);
    read_starts(*table, simulate);
    simulate.tolerance = table->number_or("tolerance", simulate.tolerance, Quantity::dimensionless,
                                          Range::inside(0, 1));
    read_motor(*table, scene.rotor, simulate);
    read_outside(*table, scene);
    read_simulate_options(*table, scene);
    table->refuse_unknown();
}

} // namespace whirl::input

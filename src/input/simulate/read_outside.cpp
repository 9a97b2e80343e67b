#include "input/csv_table.h"
#include "input/sections.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

void read_imbalance(CheckedTable &table, double end, model::SuddenImbalance &imbalance) {
    read_place(table, imbalance);
    imbalance.time = table.number("time", Quantity::time, Range::not_negative());
    imbalance.mr = table.number("mr", Quantity::imbalance);
    imbalance.phase = table.number_or("phase", 0, Quantity::angle);
    if (imbalance.time >= end)
        table.fail("time", fmt::format("expected a time before the end of the motion, {} s, got {} "
                                       "s",
                                       end, imbalance.time));
}

/// Components, frequency, phases and when it acts: of a force, or of the foundation's acceleration.
void read_harmonic(CheckedTable &table, Quantity quantity, model::StationForce &force) {
    force.x = table.number_or("x", 0, quantity);
    force.y = table.number_or("y", 0, quantity);
    if (!table.has("x") && !table.has("y"))
        table.fail("x", "missing, expected " + describe(quantity) + " in x or in y, or both");
    force.frequency = table.number_or("frequency", 0, Quantity::speed, Range::not_negative());
    force.phase = table.number_or("phase", 0, Quantity::angle);
    force.phase_y = table.number_or("phase_y", force.phase, Quantity::angle);
    force.from = table.number_or("from", 0, Quantity::time, Range::not_negative());
    force.to = table.optional_number("to", Quantity::time, Range::positive());
    if (force.to && *force.to <= force.from)
        table.fail("to",
                   fmt::format("expected more than from = {} s, got {} s", force.from, *force.to));
}

std::vector<model::BaseMotion::Row> read_base_table(const CheckedEntry &asked) {
    std::vector<model::BaseMotion::Row> rows;
    CsvTable csv(
        asked,
        {{"time", Quantity::time}, {"x", Quantity::acceleration}, {"y", Quantity::acceleration}});
    if (!csv.usable())
        return rows;
    for (const CsvRow &row : csv.rows()) {
        const double time = row.number("time", Quantity::time, Range::not_negative());
        if (!rows.empty() && time <= rows.back().time)
            row.fail("time", fmt::format("expected times that ascend, got {} s after {} s", time,
                                         rows.back().time));
        rows.push_back({time, row.number_or("x", 0, Quantity::acceleration),
                        row.number_or("y", 0, Quantity::acceleration)});
    }
    if (rows.size() == 1)
        csv.rows().front().fail("time", "expected two rows or more, got one");
    return rows;
}

model::BaseMotion read_base(CheckedTable &table) {
    model::BaseMotion base;
    if (const auto asked = table.text_entry("table")) {
        for (const char *key : {"x", "y", "frequency", "phase", "phase_y", "from", "to"})
            if (table.has(key))
                table.fail(key, "expected either a table or a harmonic acceleration, got both");
        base.table = read_base_table(*asked);
    } else {
        read_harmonic(table, Quantity::acceleration, base.harmonic.emplace());
    }
    table.refuse_unknown();
    return base;
}

void read_start(CheckedTable &table, model::Case &scene) {
    scene.simulate.steady_start = table.choice("start", {"rest", "steady"}, 0) == 1;
    if (!scene.simulate.steady_start)
        return;
    if (!scene.rotor.balancers.empty() || !scene.rotor.anisotropies.empty())
        table.fail("start",
                   "expected \"rest\" where the rotor has a balancer or an anisotropy, got "
                   "\"steady\"");
    if (scene.simulate.torque)
        table.fail("start", "expected \"rest\" with the torque of a motor, got \"steady\"");
}

} // namespace

void read_outside(CheckedTable &simulate, model::Case &scene) {
    read_start(simulate, scene);
    read_each(simulate, "imbalance", scene.simulate.imbalances,
              [&](CheckedTable &table, model::SuddenImbalance &imbalance) {
                  read_imbalance(table, scene.simulate.time, imbalance);
              });
    read_each(simulate, "force", scene.simulate.forces,
              [](CheckedTable &table, model::StationForce &force) {
                  read_place(table, force);
                  read_harmonic(table, Quantity::force, force);
              });
    if (auto base = simulate.table("base"))
        scene.simulate.base = read_base(*base);
}

} // namespace whirl::input

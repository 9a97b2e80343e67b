#include "input/sections.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

void read_operating_speeds(CheckedTable &table, model::Case &scene) {
    model::Operation operation;
    operation.from = table.number("from", Quantity::angular_speed, Range::not_negative());
    operation.to = table.number("to", Quantity::angular_speed, Range::positive());
    operation.trip = table.optional_number("trip", Quantity::angular_speed, Range::positive());
    if (operation.to <= operation.from)
        table.fail("to", fmt::format("expected more than from = {} rad/s, got {} rad/s",
                                     operation.from, operation.to));
    if (operation.trip && *operation.trip < operation.to)
        table.fail("trip", fmt::format("expected at least to = {} rad/s, got {} rad/s",
                                       operation.to, *operation.trip));
    table.refuse_unknown();
    scene.operation = operation;
}

void read_level1(CheckedTable &table, model::Case &scene) {
    model::Level1Settings level1;
    level1.z = table.number("z", Quantity::length);
    level1.to = table.optional_number("to", Quantity::stiffness, Range::positive());
    level1.count = table.whole_or("count", level1.count, 2, 10000);
    level1.anticipated =
        table.optional_number("anticipated", Quantity::stiffness, Range::positive());
    table.refuse_unknown();
    scene.level1 = level1;
}

} // namespace

void read_operation(CheckedTable &root, model::Case &scene) {
    if (auto table = root.table("operation"))
        read_operating_speeds(*table, scene);
    auto table = root.table("level1");
    if (!table)
        return;
    read_level1(*table, scene);
    if (!root.has("operation"))
        table->context().problems.add(table->node().origin, table->path(),
                                      "expected a section [operation], at whose highest speed "
                                      "cross coupling is added, got none");
}

} // namespace whirl::input

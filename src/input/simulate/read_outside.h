#pragma once

#include "input/checked_table.h"
#include "model/case.h"

namespace whirl::input {

/// Reads of [simulate] what acts on the rotor from outside, and how it starts: start,
/// [[simulate.imbalance]], [[simulate.force]], [simulate.base]. The rotor must be there already.
void read_outside(CheckedTable &simulate, model::Case &scene);

} // namespace whirl::input

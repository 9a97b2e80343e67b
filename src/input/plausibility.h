#pragma once

#include "input/node.h"
#include "model/case.h"

namespace whirl::input {

/// Adds to the remarks of a case what is allowed and looks like a slip: numbers that are a power of
/// ten or a unit away from any machine, speeds outside a bearing table, names given twice, a rotor
/// without bearings.
/// @param tree  the case as it was written: whether numbers have units
void add_remarks(model::Case &scene, const Node &tree);

} // namespace whirl::input

#pragma once

#include "model/rotor.h"

#include <vector>

namespace whirl::rigid {

/// 48 EI/L^3 of the shaft, N/m: EI the mean over the length L. As a beam on two supports at its
/// ends loaded in the middle; a measure, whatever the bearings.
[[nodiscard]] double bending_stiffness(const model::Rotor &rotor);

/// The rotor on its own mesh and on coarser and finer ones, most elements first, down to the
/// fewest: neighbouring segments of one section joined, one element each, and nodes where something
/// is attached. At most `most` elements, or the fewest where those are more.
[[nodiscard]] std::vector<model::Rotor> meshes_to_coarsest(const model::Rotor &rotor, int most);

/// Elements of the shaft.
[[nodiscard]] int element_count(const model::Rotor &rotor);

} // namespace whirl::rigid

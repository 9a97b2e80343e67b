#pragma once

namespace whirl::mesh_error {

/// Order of the finer model for error estimates: four more on the same mesh. Two more would be as
/// good as the truth where the order resolves the mode; four are so where it hardly does, and the
/// functions of both parities about the middle of an element take part.
[[nodiscard]] constexpr int finer_order(int order) { return order + 4; }

/// Safety on the difference to the finer model, for what that one still misses.
inline constexpr double estimate_safety = 1.25;

} // namespace whirl::mesh_error

#pragma once

#include <numbers>

namespace whirl::model {

inline constexpr double rpm = 30 / std::numbers::pi; ///< rev/min in one rad/s

} // namespace whirl::model

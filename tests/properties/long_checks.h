#pragma once

#include "properties/invariance_checks.h"

namespace whirl::properties {

/// Response at vanishing speed against the deflection under the same forces at rest.
[[nodiscard]] std::optional<std::string> static_response(InvarianceScene &s);
[[nodiscard]] std::optional<std::string> turned_response(InvarianceScene &s);
[[nodiscard]] std::optional<std::string> mirrored_response(InvarianceScene &s);

/// Unstable bands of stability.
[[nodiscard]] std::optional<std::string> turned_stability(InvarianceScene &s);
[[nodiscard]] std::optional<std::string> mirrored_stability(InvarianceScene &s);
[[nodiscard]] std::optional<std::string> finer_stability(InvarianceScene &s);

/// Bands of balance, for each plane and for both.
[[nodiscard]] std::optional<std::string> turned_balance(InvarianceScene &s);
[[nodiscard]] std::optional<std::string> mirrored_balance(InvarianceScene &s);

} // namespace whirl::properties

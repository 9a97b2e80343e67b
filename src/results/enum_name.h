#pragma once

#include <string>
#include <vector>

namespace whirl::results {

/// @param names  of all values of an enumeration, in its order
template <class Enum>
[[nodiscard]] std::string enum_name(Enum value, const std::vector<const char *> &names) {
    return names.at(static_cast<std::size_t>(value));
}

} // namespace whirl::results

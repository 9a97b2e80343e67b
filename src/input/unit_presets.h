#pragma once

#include <map>
#include <string>
#include <vector>

namespace whirl::input {

/// Units of results that go together: by the keys of [units].
struct UnitPreset {
    std::string name;
    std::map<std::string, std::string> units;
};

/// "si", "mm-rpm", "us".
[[nodiscard]] const std::vector<UnitPreset> &unit_presets();

} // namespace whirl::input

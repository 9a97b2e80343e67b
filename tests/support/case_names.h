#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace whirl::tests {

/// Names of the folders of cases/, in the order of the alphabet.
inline std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const auto &item :
         std::filesystem::directory_iterator(std::filesystem::path(WHIRL_ROOT) / "cases"))
        if (item.is_directory())
            names.push_back(item.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace whirl::tests

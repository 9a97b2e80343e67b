#pragma once

#include <string>
#include <vector>

namespace whirl::report {

/// SHA-256 (FIPS 180-4) of texts one after another, in hexadecimal digits: as sha256sum prints it
/// of files, `cat case.toml shaft.csv | sha256sum`.
[[nodiscard]] std::string sha256(const std::vector<std::string> &texts);

} // namespace whirl::report

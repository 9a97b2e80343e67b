#pragma once

#include "model/restart.h"

#include <filesystem>

namespace whirl::report {

/// Writes where an interrupted motion stands, with all digits.
/// @throws model::AnalysisFailure where the file cannot be written.
void write_restart(const std::filesystem::path &file, const model::Restart &restart);

/// @throws model::BadInput where the file is missing or is no such file.
[[nodiscard]] model::Restart read_restart(const std::filesystem::path &file);

} // namespace whirl::report

#pragma once

#include "model/case.h"
#include "model/output_units.h"

#include <filesystem>
#include <string>
#include <vector>

namespace whirl::input {

/// Reads a case: a folder (its case.toml) or a .toml file, see docs/case_format.md.
///
/// @param overrides  "path.to.key=value", applied in their order before the case is read; the value
///                   is TOML, or text where it is no TOML ("500 rpm")
/// @throws model::BadInput with one line for each mistake found, all of them at once:
///         `cases/x/case.toml:12: bearing[0].kxx: expected a stiffness in N/m, got "5 kg"`
[[nodiscard]] model::Case load_case(const std::filesystem::path &folder_or_file,
                                    const std::vector<std::string> &overrides = {});

/// The units of what is written, by entries of [units] alone: "units.preset=us".
/// @throws model::BadInput
[[nodiscard]] model::OutputUnits output_units(const std::vector<std::string> &overrides);

/// The case file as TOML: as it stands, or written anew where overrides change it. Read again it is
/// the same case.
/// @throws model::BadInput
[[nodiscard]] std::string case_text(const std::filesystem::path &folder_or_file,
                                    const std::vector<std::string> &overrides = {});

/// A problem that an analysis found in a case, "key: expected ..., got ..." with or without the
/// file before it, with the place where the key stands: "cases/x/case.toml:12: key: ...". Where the
/// file does not have the key the line is left out.
[[nodiscard]] std::string with_place(const std::string &problem,
                                     const std::filesystem::path &folder_or_file,
                                     const std::vector<std::string> &overrides);

} // namespace whirl::input

#pragma once

#include "model/case.h"
#include "model/output_units.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace whirl::input {

class FileTexts;
class Problems;
struct Node;

/// A case file with its tables: each is read once, however often the case is asked for.
class CaseFile {
  public:
    /// Reads a folder (its case.toml) or a .toml file, see docs/case_format.md.
    /// @throws model::BadInput where there is none, or it is no TOML
    explicit CaseFile(const std::filesystem::path &folder_or_file);

    /// The case.
    /// @param overrides  "path.to.key=value", applied in their order before the case is read; the
    ///                   value is TOML, or text where it is no TOML ("500 rpm")
    /// @throws model::BadInput with one line for each mistake found, all of them at once:
    ///         `cases/x/case.toml:12: bearing[0].kxx: expected a stiffness in N/m, got "5 kg"`
    [[nodiscard]] model::Case load(const std::vector<std::string> &overrides = {}) const;

    /// The case file as TOML: as it stands, or written anew where overrides change it. Read again
    /// it is the same case.
    /// @throws model::BadInput
    [[nodiscard]] std::string text(const std::vector<std::string> &overrides = {}) const;

    /// What the file and the tables read so far hold: for processes that ought to read the same.
    [[nodiscard]] std::string all_texts() const;

    /// The case file as it stands and the tables read so far, each with its path from the folder of
    /// the case.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> files() const;

    /// A problem that an analysis found in a case, "key: expected ..., got ..." with or without the
    /// file before it, with the place where the key stands: "cases/x/case.toml:12: key: ...". Where
    /// the file does not have the key the line is left out.
    [[nodiscard]] std::string with_place(const std::string &problem,
                                         const std::vector<std::string> &overrides) const;

  private:
    std::filesystem::path _file;
    std::string _text;
    std::shared_ptr<const Node> _tree;  ///< as it stands
    std::shared_ptr<FileTexts> _tables; ///< read so far

    [[nodiscard]] Node overridden(const std::vector<std::string> &overrides,
                                  Problems &problems) const;
};

/// The case of a file that is asked for once.
/// @throws model::BadInput
[[nodiscard]] inline model::Case load_case(const std::filesystem::path &folder_or_file,
                                           const std::vector<std::string> &overrides = {}) {
    return CaseFile(folder_or_file).load(overrides);
}

/// The units of what is written, by entries of [units] alone: "units.preset=us".
/// @throws model::BadInput
[[nodiscard]] model::OutputUnits output_units(const std::vector<std::string> &overrides);

} // namespace whirl::input

#pragma once

#include "input/problems.h"
#include "model/case.h"
#include "model/output_units.h"
#include "model/quantity.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::input {

class FileTexts;
struct Node;
struct ReadContext;

/// What a number is made of as it is written: 25 and "mm"; in SI where there is no unit.
struct NumberParts {
    double value = 0;
    std::string unit;
};
/// Of a value of a case file or of an override; none where it is no number.
[[nodiscard]] std::optional<NumberParts> number_parts(const std::string &value);

/// A number of a case as it was written.
struct WrittenNumber {
    std::string path;  ///< "bearing[0].k"
    std::string group; ///< what it belongs to, for readers: "bearing 1, drive end"
    std::string text;  ///< "1e6", "25 mm"
    model::Quantity quantity = model::Quantity::number;
    bool whole = false; ///< a count
    int line = 0;       ///< of the file; 0: given on the command line
};

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

    /// What is written in it, with these overrides, as a tree.
    /// @throws model::BadInput where they cannot be applied
    [[nodiscard]] Node tree(const std::vector<std::string> &overrides) const;

    /// The case file as TOML: as it stands, or written anew where overrides change it. Read again
    /// it is the same case.
    /// @throws model::BadInput
    [[nodiscard]] std::string text(const std::vector<std::string> &overrides = {}) const;

    /// The mistakes of the case with these overrides; none where load() would give it.
    [[nodiscard]] std::vector<Problem> problems(const std::vector<std::string> &overrides) const;

    /// All numbers of the case with these overrides, in the order of the file.
    /// @throws model::BadInput where it has mistakes
    [[nodiscard]] std::vector<WrittenNumber>
    numbers(const std::vector<std::string> &overrides) const;

    /// The case file with the overrides written into it: values are put in place of those that
    /// stood there, entries that are new below the header of their table or in a section at the
    /// end; all else is as it was, comments too. Read again it is the case with the overrides.
    /// @throws model::BadInput for mistakes, and where an override cannot be written in this way
    [[nodiscard]] std::string edited(const std::vector<std::string> &overrides) const;

    /// The file itself.
    [[nodiscard]] const std::filesystem::path &path() const { return _file; }

    /// What the file and the tables read so far hold: for processes that ought to read the same.
    [[nodiscard]] std::string all_texts() const;

    /// The case file as it stands and the tables read so far, each with its path from the folder of
    /// the case.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> files() const;

    /// A problem that an analysis found in a case, "key: expected ..., got ..." with or without the
    /// file before it, with the place where the key stands, or where the file does not have it,
    /// what is around it: "cases/x/case.toml:12: key: ...".
    [[nodiscard]] std::string with_place(const std::string &problem,
                                         const std::vector<std::string> &overrides) const;

  private:
    std::filesystem::path _file;
    std::string _text;
    std::shared_ptr<const Node> _tree;  ///< as it stands
    std::shared_ptr<FileTexts> _tables; ///< read so far

    [[nodiscard]] Node overridden(const std::vector<std::string> &overrides,
                                  Problems &problems) const;
    /// The case of a tree; mistakes go to the context.
    [[nodiscard]] model::Case read(const Node &tree, ReadContext &context) const;
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

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace whirl::report {

/// Says before a long run what would keep a folder from being made, or files from being put there;
/// makes nothing.
/// @throws model::BadInput
void check_folder(const std::filesystem::path &folder);

/// The bytes of a file; none where it cannot be read.
[[nodiscard]] std::string content_of(const std::filesystem::path &path);

/// A set of output files that appears as a whole or not at all.
///
/// What they hold is kept here until commit(): however a run ends before, nothing has been made,
/// not even the folder.
class OutputFiles {
  public:
    explicit OutputFiles(std::filesystem::path folder);

    /// A file of the set, in this order. Where no content follows there is none of that name
    /// afterwards: one of an earlier run would be beside results that it does not belong to.
    void announce(const std::string &name);
    /// The content of a file, announced or not.
    void add(const std::string &name, std::string content);
    /// Writes all files and gives them their names; returns the paths of those with content in
    /// their order. Signals wait meanwhile.
    /// @throws model::AnalysisFailure where that is not possible: all is as it was before then
    std::vector<std::filesystem::path> commit();

  private:
    std::filesystem::path _folder;
    std::vector<std::string> _names;
    std::map<std::string, std::string> _contents;
};

/// Writes one file so that readers see the old content or the whole new one, never a part.
/// Makes the folder where needed. @throws model::AnalysisFailure; nothing is left behind then.
void write_file_atomically(const std::filesystem::path &path, std::string content);

} // namespace whirl::report

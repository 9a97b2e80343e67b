#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
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
/// Content goes to temporary names in the output folder; commit() renames all of them. Without
/// commit() the destructor removes the temporary files and the folders made for them.
class OutputFiles {
  public:
    /// Makes the folder, with its parents, where it does not exist.
    /// @throws model::AnalysisFailure where that is not possible.
    explicit OutputFiles(std::filesystem::path folder);
    ~OutputFiles();
    OutputFiles(const OutputFiles &) = delete;
    OutputFiles &operator=(const OutputFiles &) = delete;

    /// Temporary path that commit() will rename to `name`; somebody else writes the content.
    std::filesystem::path reserve(const std::string &name);
    /// Writes the content to a temporary name; commit() renames it to `name`.
    /// @throws model::AnalysisFailure where the file cannot be written.
    void add(const std::string &name, std::string_view content);
    /// Forgets and removes a reserved file that will not come.
    void drop(const std::string &name);
    /// Gives all files their names and returns their paths in the order they were announced.
    std::vector<std::filesystem::path> commit();

  private:
    struct Entry {
        std::filesystem::path temporary;
        std::filesystem::path target;
    };
    std::filesystem::path _folder;
    std::vector<std::filesystem::path> _made; ///< folders made here, outermost first
    std::vector<Entry> _entries;
    bool _committed = false;
};

/// Writes one file so that readers see the old content or the whole new one, never a part.
/// Makes the folder where needed. @throws model::AnalysisFailure; nothing is left behind then.
void write_file_atomically(const std::filesystem::path &path, std::string_view content);

} // namespace whirl::report

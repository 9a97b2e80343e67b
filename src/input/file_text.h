#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace whirl::input {

/// What a text file holds, or why it cannot be taken: "there is no such file".
struct FileText {
    std::string text;    ///< UTF-8 without a byte order mark, where the file is in UTF-16 too
    std::string mistake; ///< empty: none
};

/// The files of a case, each read once: a pipe gives what it holds only once, a file may change
/// while the program is at work, and maps and samples read the case again and again.
class FileTexts {
  public:
    /// Of a regular file, a pipe or a device, up to `largest` bytes.
    const FileText &of(const std::filesystem::path &file, std::size_t largest);

    /// All that were read, one after the other: for processes that ought to have read the same.
    [[nodiscard]] std::string all() const;
    /// The texts by the paths of their files.
    [[nodiscard]] const std::map<std::string, FileText> &texts() const { return _texts; }

  private:
    std::map<std::string, FileText> _texts;
};

/// Larger files are refused: a case that takes some gigabytes of memory once it is read, and a
/// table of more rows than an analysis could go through.
inline constexpr std::size_t largest_case = 10'000'000;   // bytes
inline constexpr std::size_t largest_table = 100'000'000; // bytes

/// False where some bytes are no UTF-8: a table of a spreadsheet in the Windows code page.
[[nodiscard]] bool is_utf8(std::string_view text);

/// The text of ISO 8859-1, which that code page has in common with nearly all others of western
/// Europe, in UTF-8.
[[nodiscard]] std::string from_latin1(std::string_view text);

} // namespace whirl::input

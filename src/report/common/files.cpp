#include "report/common/files.h"

#include "model/errors.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

std::string no_folder(const fs::path &folder, const std::string &why) {
    return fmt::format("cannot make the output folder {}: {}; --out names another one",
                       folder.string(), why);
}

} // namespace

void check_folder(const fs::path &folder) {
    std::error_code error;
    fs::path there = fs::absolute(folder).lexically_normal();
    while (!fs::exists(there, error) && there != there.root_path())
        there = there.parent_path();
    if (!fs::is_directory(there, error))
        throw model::BadInput("whirl: " + no_folder(folder, there.string() + " is not a folder"));
    if (access(there.c_str(), W_OK | X_OK) != 0)
        throw model::BadInput("whirl: " +
                              no_folder(folder, "no permission to write in " + there.string()));
}

std::string content_of(const fs::path &path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

OutputFiles::OutputFiles(fs::path folder) : _folder(std::move(folder)) {
    if (_folder.empty())
        _folder = ".";
    std::error_code error;
    for (fs::path part = fs::absolute(_folder).lexically_normal();
         !part.empty() && !fs::exists(part, error) && part != part.root_path();
         part = part.parent_path())
        if (part.has_filename())
            _made.insert(_made.begin(), part);
    fs::create_directories(_folder, error);
    if (error || !fs::is_directory(_folder))
        throw model::AnalysisFailure(no_folder(_folder, error ? error.message() : "not a folder"));
}

OutputFiles::~OutputFiles() {
    if (_committed)
        return;
    std::error_code ignored;
    for (const Entry &entry : _entries)
        fs::remove(entry.temporary, ignored);
    // Only folders that are still empty go: fs::remove refuses the others.
    for (auto folder = _made.rbegin(); folder != _made.rend(); ++folder)
        fs::remove(*folder, ignored);
}

fs::path OutputFiles::reserve(const std::string &name) {
    const fs::path temporary = _folder / fmt::format(".{}.{}.part", name, getpid());
    _entries.push_back({temporary, _folder / name});
    return temporary;
}

void OutputFiles::add(const std::string &name, std::string_view content) {
    const fs::path temporary = reserve(name);
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file)
        throw model::AnalysisFailure(
            fmt::format("cannot write {}: no space or no permission", (_folder / name).string()));
}

void OutputFiles::drop(const std::string &name) {
    const fs::path target = _folder / name;
    std::error_code ignored;
    std::erase_if(_entries, [&](const Entry &entry) {
        return entry.target == target && (fs::remove(entry.temporary, ignored), true);
    });
}

std::vector<fs::path> OutputFiles::commit() {
    std::vector<fs::path> paths;
    for (const Entry &entry : _entries) {
        std::error_code error;
        fs::rename(entry.temporary, entry.target, error);
        if (error)
            throw model::AnalysisFailure(
                fmt::format("cannot write {}: {}", entry.target.string(), error.message()));
        paths.push_back(entry.target);
    }
    _committed = true;
    return paths;
}

void write_file_atomically(const fs::path &path, std::string_view content) {
    OutputFiles files(path.parent_path());
    files.add(path.filename().string(), content);
    files.commit();
}

} // namespace whirl::report

#include "report/common/files.h"

#include "model/errors.h"
#include "process/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

std::string no_folder(const fs::path &folder, const std::string &why) {
    return fmt::format("cannot make the output folder {}: {}; --out names another one",
                       folder.string(), why);
}

[[noreturn]] void fail(const fs::path &file, int error) {
    throw model::AnalysisFailure(fmt::format("cannot write {}: {}; no results were written",
                                             file.string(), std::strerror(error)));
}

/// The folder with its parents, as far as they are made here: those that are still empty go again
/// unless it is kept.
class MadeFolder {
  public:
    explicit MadeFolder(const fs::path &folder) {
        std::error_code error;
        for (fs::path part = fs::absolute(folder).lexically_normal();
             !part.empty() && !fs::exists(part, error) && part != part.root_path();
             part = part.parent_path())
            if (part.has_filename())
                _made.push_back(part);
        fs::create_directories(folder, error);
        _descriptor = error ? -1 : open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (_descriptor < 0) {
            remove();
            throw model::AnalysisFailure(
                no_folder(folder, error ? error.message() : std::strerror(errno)));
        }
    }
    ~MadeFolder() {
        close(_descriptor);
        if (!_kept)
            remove();
    }
    MadeFolder(const MadeFolder &) = delete;
    MadeFolder &operator=(const MadeFolder &) = delete;
    MadeFolder(MadeFolder &&) = delete;
    MadeFolder &operator=(MadeFolder &&) = delete;

    [[nodiscard]] int descriptor() const { return _descriptor; }
    void keep() { _kept = true; }

  private:
    std::vector<fs::path> _made; ///< innermost first
    int _descriptor = -1;
    bool _kept = false;

    void remove() const {
        std::error_code ignored;
        for (const fs::path &folder : _made)
            fs::remove(folder, ignored); // refuses those that are not empty
    }
};

/// Files of a folder that are exchanged together. Each is written whole under no name, where the
/// file system can do that, or a temporary one; then all get temporary names, and then their own.
/// What had these before is kept under the temporary ones until all have succeeded.
class Exchange {
  public:
    explicit Exchange(const fs::path &folder, int descriptor)
        : _path(folder), _folder(descriptor) {}
    ~Exchange() {
        for (auto change = _changes.rbegin(); change != _changes.rend(); ++change) {
            if (!change->old.empty())
                (void)rename(change->old, change->name);
            else if (change->state == State::in_place)
                unlinkat(_folder, change->name.c_str(), 0);
            if (change->state == State::temporary)
                unlinkat(_folder, change->temporary.c_str(), 0);
            if (change->descriptor >= 0)
                close(change->descriptor);
        }
    }
    Exchange(const Exchange &) = delete;
    Exchange &operator=(const Exchange &) = delete;
    Exchange(Exchange &&) = delete;
    Exchange &operator=(Exchange &&) = delete;

    void write(const std::string &name, std::string_view content) {
        check_target(name);
        Change &change = _changes.emplace_back(Change{name, temporary_name(name)});
        // Without a name nothing is left even where the program is killed.
        if (access("/proc/self/fd", X_OK) == 0)
            change.descriptor = openat(_folder, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
        if (change.descriptor >= 0) {
            change.state = State::nameless;
        } else {
            change.descriptor = openat(_folder, change.temporary.c_str(),
                                       O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
            if (change.descriptor < 0)
                fail(_path / name, errno);
            change.state = State::temporary;
        }
        while (!content.empty()) {
            const ssize_t written = ::write(change.descriptor, content.data(), content.size());
            if (written < 0 && errno != EINTR)
                fail(_path / name, errno);
            content.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
        }
        // Where space is only looked for later (NFS) closing says so. No file is forced to the
        // disc: that takes as long as an analysis, and a result that a power failure takes with it
        // can be computed again.
        if (change.state == State::temporary && close(std::exchange(change.descriptor, -1)) != 0)
            fail(_path / name, errno);
    }

    /// A file of this name, if any, goes.
    void remove(const std::string &name) {
        struct stat there {};
        if (fstatat(_folder, name.c_str(), &there, AT_SYMLINK_NOFOLLOW) != 0)
            return;
        check_target(name);
        _changes.push_back({name, temporary_name(name)});
    }

    /// @throws model::AnalysisFailure; all is as before after the destructor then
    void carry_out() {
        for (Change &change : _changes)
            if (change.state == State::nameless)
                give_temporary_name(change);
        for (Change &change : _changes)
            change.state == State::none ? put_away(change) : put_in_place(change);
        for (const Change &change : _changes)
            if (!change.old.empty())
                unlinkat(_folder, change.old.c_str(), 0);
        _changes.clear();
    }

  private:
    enum class State {
        none,      ///< there is no new file
        nameless,  ///< it is in the descriptor alone
        temporary, ///< it has the temporary name
        in_place   ///< it has its name
    };
    struct Change {
        std::string name, temporary;
        std::string old{}; ///< name of what was there before, while it can be put back
        int descriptor = -1;
        State state = State::none;
    };
    fs::path _path;
    int _folder;
    std::vector<Change> _changes;

    /// That nobody can guess and no other process has, in whatever container.
    static std::string temporary_name(const std::string &name) {
        static std::random_device random;
        return fmt::format(".{}.{:08x}{:08x}.part", name, random(), random());
    }

    /// Said before anything is exchanged.
    void check_target(const std::string &name) const {
        struct stat there {};
        if (fstatat(_folder, name.c_str(), &there, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISDIR(there.st_mode))
            fail(_path / name, EISDIR);
    }

    void give_temporary_name(Change &change) {
        const std::string here = fmt::format("/proc/self/fd/{}", change.descriptor);
        if (linkat(AT_FDCWD, here.c_str(), _folder, change.temporary.c_str(), AT_SYMLINK_FOLLOW) !=
            0)
            fail(_path / change.name, errno);
        change.state = State::temporary;
        if (close(std::exchange(change.descriptor, -1)) != 0)
            fail(_path / change.name, errno);
    }

    [[nodiscard]] bool rename(const std::string &from, const std::string &to,
                              unsigned how = 0) const {
        return renameat2(_folder, from.c_str(), _folder, to.c_str(), how) == 0;
    }

    void put_in_place(Change &change) {
        if (rename(change.temporary, change.name, RENAME_EXCHANGE)) {
            change.old = change.temporary;
            change.state = State::in_place;
            return;
        }
        // None is there, or the file system cannot exchange two.
        if (errno != ENOENT)
            put_away(change);
        if (!rename(change.temporary, change.name))
            fail(_path / change.name, errno);
        change.state = State::in_place;
    }

    void put_away(Change &change) {
        const std::string old = temporary_name(change.name);
        if (!rename(change.name, old))
            fail(_path / change.name, errno);
        change.old = old;
    }
};

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
}

void OutputFiles::announce(const std::string &name) {
    if (std::count(_names.begin(), _names.end(), name) == 0)
        _names.push_back(name);
}

void OutputFiles::add(const std::string &name, std::string content) {
    announce(name);
    _contents.insert_or_assign(name, std::move(content));
}

std::vector<fs::path> OutputFiles::commit() {
    const process::SignalsHeld held;
    MadeFolder folder(_folder);
    Exchange exchange(_folder, folder.descriptor());
    std::vector<fs::path> paths;
    for (const std::string &name : _names) {
        const auto content = _contents.find(name);
        if (content == _contents.end()) {
            exchange.remove(name);
            continue;
        }
        exchange.write(name, content->second);
        paths.push_back(_folder / name);
    }
    exchange.carry_out();
    folder.keep();
    process::results_written();
    return paths;
}

void write_file_atomically(const fs::path &path, std::string content) {
    OutputFiles files(path.parent_path());
    files.add(path.filename().string(), std::move(content));
    files.commit();
}

} // namespace whirl::report

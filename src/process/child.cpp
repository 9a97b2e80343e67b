#include "process/child.h"

#include "model/errors.h"
#include "process/signals.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace whirl::process {

namespace {

[[noreturn]] void fail(const std::string &program, const std::string &what, int error) {
    throw model::AnalysisFailure(
        fmt::format("{} was not started: {}: {}", program, what, std::strerror(error)));
}

/// A file without a name that lives as long as its descriptor; -1 and errno.
int nameless_file() { return memfd_create("whirl", MFD_CLOEXEC); }

/// False, and errno, where not all of it can be written.
bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR)
            return false;
        text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
    }
    return lseek(descriptor, 0, SEEK_SET) == 0;
}

std::string read_all(int descriptor) {
    std::string text;
    std::string piece(1 << 16, '\0');
    for (ssize_t count = 1; count > 0;) {
        count = pread(descriptor, piece.data(), piece.size(), static_cast<off_t>(text.size()));
        if (count > 0)
            text.append(piece, 0, static_cast<std::size_t>(count));
    }
    return text;
}

/// A descriptor that is closed in the end, unless it is handed on.
struct Descriptor {
    int number;

    explicit Descriptor(int of) : number(of) {}
    ~Descriptor() {
        if (number >= 0)
            close(number);
    }
    Descriptor(const Descriptor &) = delete;
    Descriptor &operator=(const Descriptor &) = delete;
    Descriptor(Descriptor &&) = delete;
    Descriptor &operator=(Descriptor &&) = delete;
    int handed_on() { return std::exchange(number, -1); }
};

/// posix_spawn as the leader of a group, with its three streams; 0 or the error.
int spawn(pid_t &process, const std::vector<std::string> &words, int input, int output,
          int errors) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    std::vector<std::string> copies = words; // the library takes them as writable
    std::vector<char *> arguments;
    for (std::string &word : copies)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int error =
        posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

} // namespace

std::optional<Child> Child::start(const std::vector<std::string> &words, std::string_view input) {
    const std::string &program = words.front();
    Descriptor in(nameless_file());
    Descriptor out(nameless_file());
    Descriptor errors(nameless_file());
    if (in.number < 0 || out.number < 0 || errors.number < 0)
        fail(program, "no temporary file", errno);
    if (!write_all(in.number, input))
        fail(program, "cannot hand over what it is to read", errno);
    Child child;
    int error = 0;
    {
        const SignalsHeld held;
        error = spawn(child._process, words, in.number, out.number, errors.number);
        if (error == 0)
            child._noted = note_group(child._process);
        else
            child._process = 0;
    }
    if (error == ENOENT)
        return std::nullopt;
    if (error != 0)
        fail(program, "the system refuses", error);
    child._output = out.handed_on();
    child._errors = errors.handed_on();
    return child;
}

Child::Child(Child &&other) noexcept
    : _process(std::exchange(other._process, 0)), _noted(std::exchange(other._noted, -1)),
      _status(other._status), _output(std::exchange(other._output, -1)),
      _errors(std::exchange(other._errors, -1)) {}

Child &Child::operator=(Child &&other) noexcept {
    std::swap(_process, other._process);
    std::swap(_noted, other._noted);
    std::swap(_status, other._status);
    std::swap(_output, other._output);
    std::swap(_errors, other._errors);
    return *this;
}

Child::~Child() {
    end();
    for (const int descriptor : {_output, _errors})
        if (descriptor >= 0)
            close(descriptor);
}

/// The group first and then the leader: until that has been waited for its number is of no other.
void Child::end() noexcept {
    if (_process == 0)
        return;
    kill(-_process, SIGKILL);
    forget_group(std::exchange(_noted, -1));
    while (waitpid(_process, &_status, 0) < 0 && errno == EINTR) {
    }
    _process = 0;
}

bool Child::ended_within(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto late = Clock::now() + std::chrono::duration<double>(seconds);
    while (_process != 0) {
        siginfo_t state{};
        const int asked =
            waitid(P_PID, static_cast<id_t>(_process), &state, WEXITED | WNOHANG | WNOWAIT);
        // Nobody knows how it ended where this program was started with SIGCHLD ignored.
        if (asked == 0 ? state.si_pid != 0 : errno == ECHILD)
            end(); // what it has left behind in its group
        else if (Clock::now() > late)
            return false;
        else
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

std::string Child::failure() const {
    if (WIFSIGNALED(_status))
        return fmt::format("it was ended by signal {} ({})", WTERMSIG(_status),
                           strsignal(WTERMSIG(_status)));
    return WEXITSTATUS(_status) == 0 ? "" : fmt::format("exit status {}", WEXITSTATUS(_status));
}

std::string Child::output() const { return read_all(_output); }
std::string Child::errors() const { return read_all(_errors); }

} // namespace whirl::process

#include "process/processes.h"

#include "linalg/check.h"
#include "model/errors.h"

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <cstdint>
#include <new>
#include <numeric>

namespace whirl::process {

namespace {

int alone_now = 0; ///< so many of Alone there are

} // namespace

Alone::Alone() { ++alone_now; }

Alone::~Alone() { --alone_now; }

int process_rank() {
    int rank = 0;
    if (alone_now > 0)
        return rank;
    linalg::check(MPI_Comm_rank(MPI_COMM_WORLD, &rank));
    return rank;
}

int process_count() {
    int count = 1;
    if (alone_now > 0)
        return count;
    linalg::check(MPI_Comm_size(MPI_COMM_WORLD, &count));
    return count;
}

namespace {

/// Of what kind is a failure that ends the work of all processes.
enum class Kind : int { none, analysis, input };

struct Ending {
    Kind kind = Kind::none;
    std::string message{};
};

/// Process `root`'s bytes on every process.
void broadcast_from(int root, std::vector<char> &bytes) {
    auto size = static_cast<int>(bytes.size());
    linalg::check(MPI_Bcast(&size, 1, MPI_INT, root, MPI_COMM_WORLD));
    bytes.resize(static_cast<std::size_t>(size));
    linalg::check(MPI_Bcast(bytes.data(), size, MPI_BYTE, root, MPI_COMM_WORLD));
}

std::string of_another(int rank, int count) {
    std::array<char, MPI_MAX_PROCESSOR_NAME> host{};
    int length = 0;
    linalg::check(MPI_Get_processor_name(host.data(), &length));
    return fmt::format("process {} of {}, on {}, fails where process 0 does not: ", rank, count,
                       host.data());
}

/// No std::exception, so that nobody takes it for a failure that can be done without.
struct AnotherEnds {
    Ending ending;
};

/// What the first process that cannot go on says, on all of them. Every collective call begins with
/// this one, so that those who wait meet those who have left.
Ending agreed(const Ending &mine) {
    const int rank = process_rank();
    const int count = process_count();
    int first = mine.kind == Kind::none ? count : rank;
    linalg::check(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD));
    if (first == count)
        return {};
    auto kind = static_cast<int>(mine.kind);
    linalg::check(MPI_Bcast(&kind, 1, MPI_INT, first, MPI_COMM_WORLD));
    const std::string of_me = (rank > 0 ? of_another(rank, count) : "") + mine.message;
    std::vector<char> message(of_me.begin(), of_me.end());
    broadcast_from(first, message);
    return {static_cast<Kind>(kind), {message.begin(), message.end()}};
}

void meet() {
    if (Ending ending = agreed({}); ending.kind != Kind::none)
        throw AnotherEnds{std::move(ending)};
}

[[noreturn]] void throw_as(const Ending &ending) {
    if (ending.kind == Kind::input)
        throw model::BadInput(ending.message);
    throw model::AnalysisFailure(ending.message);
}

} // namespace

void together(const std::function<void()> &work) {
    if (process_count() == 1)
        return work();
    Ending mine;
    try {
        work();
    } catch (const AnotherEnds &other) { // all have met already
        throw_as(other.ending);
    } catch (const model::BadInput &error) {
        mine = {Kind::input, error.what()};
    } catch (const std::bad_alloc &) {
        mine = {Kind::analysis, "not enough memory"};
    } catch (const std::exception &error) {
        mine = {Kind::analysis, error.what()};
    }
    if (const Ending ending = agreed(mine); ending.kind != Kind::none)
        throw_as(ending);
}

bool same_everywhere(const std::string &text) {
    std::vector<char> first(text.begin(), text.end());
    broadcast(first);
    return std::string_view(text) == std::string_view(first.data(), first.size());
}

std::vector<std::vector<char>> gather(const std::vector<char> &bytes) {
    if (process_count() == 1)
        return {bytes};
    meet();
    const int count = process_count();
    const int mine = static_cast<int>(bytes.size());
    std::vector<int> sizes(static_cast<std::size_t>(count));
    linalg::check(MPI_Gather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD));
    std::vector<int> offsets(sizes.size());
    std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), 0);
    std::vector<char> all(static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), 0)));
    linalg::check(MPI_Gatherv(bytes.data(), mine, MPI_BYTE, all.data(), sizes.data(),
                              offsets.data(), MPI_BYTE, 0, MPI_COMM_WORLD));
    std::vector<std::vector<char>> parts;
    if (process_rank() == 0)
        for (std::size_t i = 0; i < sizes.size(); ++i)
            parts.emplace_back(all.begin() + offsets[i], all.begin() + offsets[i] + sizes[i]);
    return parts;
}

void broadcast(std::vector<char> &bytes) {
    if (process_count() == 1)
        return;
    meet();
    broadcast_from(0, bytes);
}

/// Memory of process 0 that the others reach by themselves.
struct SharedCounter::Window {
    MPI_Win window = MPI_WIN_NULL;
    std::int64_t *value = nullptr; ///< on process 0
    std::int64_t step = 1;
    std::int64_t asked = 0; ///< arrives here
    MPI_Request request = MPI_REQUEST_NULL;
    /// Where memory is shared nobody waits for an answer, and what was asked for early would be
    /// left for longer than need be when others have nothing more to do.
    bool ahead = true;

    /// In memory that all processes share, where they do; false: it is not made yet.
    [[nodiscard]] bool in_shared_memory(MPI_Aint size) {
        MPI_Comm here = MPI_COMM_NULL;
        linalg::check(
            MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here));
        linalg::check(MPI_Comm_set_errhandler(here, MPI_ERRORS_RETURN));
        int count = 0;
        linalg::check(MPI_Comm_size(here, &count));
        const bool made = count == process_count() &&
                          MPI_Win_allocate_shared(size, sizeof(std::int64_t), MPI_INFO_NULL, here,
                                                  &value, &window) == MPI_SUCCESS;
        linalg::check(MPI_Comm_free(&here));
        return made;
    }

    /// Lets the library send and answer what waits: where the network cannot reach into memory by
    /// itself, it does so only while it is called.
    static void let_messages_pass() {
        constexpr int often_enough = 20; // each call takes some of them
        int found = 0;
        for (int i = 0; i < often_enough; ++i)
            linalg::check(
                MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, MPI_STATUS_IGNORE));
    }
    void ask() {
        linalg::check(MPI_Rget_accumulate(&step, 1, MPI_INT64_T, &asked, 1, MPI_INT64_T, 0, 0, 1,
                                          MPI_INT64_T, MPI_SUM, window, &request));
    }
};

SharedCounter::SharedCounter() {
    if (process_count() == 1)
        return;
    meet();
    _window = std::make_unique<Window>();
    const MPI_Aint size = process_rank() == 0 ? sizeof(std::int64_t) : 0;
    _window->ahead = !_window->in_shared_memory(size);
    if (_window->ahead)
        linalg::check(MPI_Win_allocate(size, sizeof(std::int64_t), MPI_INFO_NULL, MPI_COMM_WORLD,
                                       &_window->value, &_window->window));
    linalg::check(MPI_Win_lock_all(MPI_MODE_NOCHECK, _window->window));
    if (process_rank() == 0) {
        *_window->value = 0;
        linalg::check(MPI_Win_sync(_window->window));
    }
    linalg::check(MPI_Barrier(MPI_COMM_WORLD));
    if (_window->ahead)
        _window->ask();
}

SharedCounter::~SharedCounter() {
    if (!_window)
        return;
    MPI_Wait(&_window->request, MPI_STATUS_IGNORE);
    MPI_Win_unlock_all(_window->window);
    MPI_Win_free(&_window->window);
}

std::size_t SharedCounter::next() {
    if (!_window)
        return _alone++;
    if (!_window->ahead)
        _window->ask();
    linalg::check(MPI_Wait(&_window->request, MPI_STATUS_IGNORE));
    const auto number = static_cast<std::size_t>(_window->asked);
    if (_window->ahead) {
        Window::let_messages_pass();
        _window->ask();
        Window::let_messages_pass();
    }
    return number;
}

void SharedCounter::skip(std::size_t by) {
    _alone += by;
    if (!_window)
        return;
    const auto step = static_cast<std::int64_t>(by);
    linalg::check(
        MPI_Accumulate(&step, 1, MPI_INT64_T, 0, 0, 1, MPI_INT64_T, MPI_SUM, _window->window));
    linalg::check(MPI_Win_flush(0, _window->window));
}

} // namespace whirl::process

// Work on several processes that fails on one of them: together_test.cpp starts it by mpirun. Exit
// status 1 or 2 after one message, as the program does, or 0. Usage: together_ranks HOW WHO: who
// fails ("all", or a rank) and how.

#include "linalg/check.h"
#include "linalg/session.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "process/processes.h"

#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include <unistd.h>

using namespace whirl;

namespace {

[[noreturn]] void fail(const std::string &how) {
    if (how.starts_with("input"))
        throw model::BadInput("case.toml: broken");
    if (how.starts_with("memory"))
        throw std::bad_alloc();
    if (how.starts_with("solver"))
        throw linalg::SolverError("a step failed");
    throw model::AnalysisFailure("no convergence");
}

void work(const std::string &how, bool mine) {
    const bool within = how.ends_with("-within");
    const bool later = within || how == "dealt" || how == "between" || how == "last";
    if (mine && !later)
        fail(how);
    const auto rows = process::rows_at({1, 2, 3, 4, 5, 6}, [&](double speed) {
        if (mine && within)
            fail(how);
        return std::vector<double>{2 * speed};
    });
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].at(0) != 2.0 * static_cast<double>(i + 1))
            throw model::AnalysisFailure("rows are mixed up");
    const auto pieces = process::deal(20, "pieces", [&](std::size_t piece) {
        usleep(5000); // so that everyone gets some
        if (mine && how == "dealt")
            fail(how);
        return process::Outcome{{static_cast<double>(piece)}, ""};
    });
    if (mine && how == "between")
        fail(how);
    std::vector<char> bytes(3, 'x');
    process::broadcast(bytes);
    if (mine && how == "last")
        fail(how);
}

} // namespace

int main(int argc, char **argv) {
    const std::string how = argc > 1 ? argv[1] : "nothing";
    const std::string who = argc > 2 ? argv[2] : "all";
    const linalg::Session session;
    const int rank = process::process_rank();
    int status = 0;
    std::string message;
    try {
        process::together(
            [&] { work(how, how != "nothing" && (who == "all" || who == std::to_string(rank))); });
    } catch (const model::BadInput &error) {
        status = 2;
        message = error.what();
    } catch (const model::AnalysisFailure &error) {
        status = 1;
        message = error.what();
    } catch (...) {
        status = 3;
        message = "another exception";
    }
    // On every process the same, which they tell here.
    for (const std::vector<char> &other :
         process::gather(std::vector<char>(message.begin(), message.end())))
        if (std::string(other.begin(), other.end()) != message)
            status = 4;
    if (rank == 0)
        std::printf("%d %s\n", status, message.c_str());
    return 0;
}

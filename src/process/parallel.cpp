#include "process/parallel.h"

#include "model/errors.h"
#include "process/processes.h"
#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace whirl::process {

namespace {

void append(std::vector<char> &bytes, const void *data, std::size_t size) {
    const auto *first = static_cast<const char *>(data);
    bytes.insert(bytes.end(), first, first + size);
}

void append_row(std::vector<char> &bytes, const std::vector<double> &row) {
    const std::size_t size = row.size();
    append(bytes, &size, sizeof size);
    append(bytes, row.data(), size * sizeof(double));
}

std::size_t take_size(const std::vector<char> &bytes, std::size_t &next) {
    std::size_t size = 0;
    std::memcpy(&size, bytes.data() + next, sizeof size);
    next += sizeof size;
    return size;
}

/// Reads what append_row wrote, from `next` on.
std::vector<double> take_row(const std::vector<char> &bytes, std::size_t &next) {
    std::vector<double> row(take_size(bytes, next));
    const std::size_t size = row.size();
    if (size > 0) // an empty row has no address to copy to
        std::memcpy(row.data(), bytes.data() + next, size * sizeof(double));
    next += size * sizeof(double);
    return row;
}

void append_outcome(std::vector<char> &bytes, std::size_t piece, const Outcome &outcome) {
    append(bytes, &piece, sizeof piece);
    append_row(bytes, outcome.numbers);
    const std::size_t size = outcome.text.size();
    append(bytes, &size, sizeof size);
    append(bytes, outcome.text.data(), size);
}

/// Puts what append_outcome wrote in its place.
void take_outcomes(const std::vector<char> &bytes, std::vector<Outcome> &outcomes) {
    for (std::size_t next = 0; next < bytes.size();) {
        Outcome &outcome = outcomes.at(take_size(bytes, next));
        outcome.numbers = take_row(bytes, next);
        const std::size_t size = take_size(bytes, next);
        outcome.text.assign(bytes.data() + next, size);
        next += size;
    }
}

/// The first failure message of any process, on every process.
std::string common_failure(const std::string &mine) {
    std::vector<char> first;
    for (const std::vector<char> &message : gather({mine.begin(), mine.end()}))
        if (first.empty())
            first = message;
    broadcast(first);
    return {first.begin(), first.end()};
}

} // namespace

std::vector<std::vector<double>>
rows_at(const std::vector<double> &speeds,
        const std::function<std::vector<double>(double speed)> &row) {
    const auto processes = static_cast<std::size_t>(process_count());
    std::vector<char> mine;
    std::string failure;
    try {
        for (auto i = static_cast<std::size_t>(process_rank()); i < speeds.size(); i += processes)
            append_row(mine, row(speeds[i]));
    } catch (const model::AnalysisFailure &error) {
        failure = error.what();
    }
    failure = common_failure(failure);
    if (!failure.empty())
        throw model::AnalysisFailure(failure);
    const std::vector<std::vector<char>> parts = gather(mine);
    std::vector<std::vector<double>> rows;
    if (parts.empty())
        return rows;
    std::vector<std::size_t> next(processes, 0);
    for (std::size_t i = 0; i < speeds.size(); ++i)
        rows.push_back(take_row(parts[i % processes], next[i % processes]));
    return rows;
}

namespace {

/// Does it; what failed, in words, or nothing.
std::string failure_of(const std::function<void()> &work) {
    try {
        work();
    } catch (const std::exception &error) {
        const std::string what = error.what();
        return what.empty() ? "a piece of the work failed" : what;
    }
    return {};
}

} // namespace

std::vector<Outcome> deal(std::size_t count, const std::string &doing,
                          const std::function<Outcome(std::size_t piece)> &work,
                          const std::function<void()> &first) {
    std::vector<char> mine;
    std::string failure;
    {
        SharedCounter counter;
        if (first && process_rank() == 0)
            failure = failure_of(first);
        const Stage all(doing, 0, 1);
        const double whole = static_cast<double>(count);
        for (std::size_t piece = 0; failure.empty() && (piece = counter.next()) < count;) {
            const Stage one(doing, static_cast<double>(piece) / whole,
                            static_cast<double>(piece + 1) / whole);
            failure = failure_of([&] { append_outcome(mine, piece, work(piece)); });
        }
        if (!failure.empty())
            counter.skip(count); // the others end after what they have asked for
    }
    failure = common_failure(failure);
    if (!failure.empty())
        throw model::AnalysisFailure(failure);
    std::vector<Outcome> outcomes;
    const std::vector<std::vector<char>> parts = gather(mine);
    if (!parts.empty())
        outcomes.resize(count);
    for (const std::vector<char> &part : parts)
        take_outcomes(part, outcomes);
    return outcomes;
}

} // namespace whirl::process

#include "process/parallel.h"

#include "model/errors.h"
#include "process/processes.h"

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

/// Reads what append_row wrote, from `next` on.
std::vector<double> take_row(const std::vector<char> &bytes, std::size_t &next) {
    std::size_t size = 0;
    std::memcpy(&size, bytes.data() + next, sizeof size);
    next += sizeof size;
    std::vector<double> row(size);
    std::memcpy(row.data(), bytes.data() + next, size * sizeof(double));
    next += size * sizeof(double);
    return row;
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

} // namespace whirl::process

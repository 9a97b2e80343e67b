#include "process/parallel.h"

#include "model/errors.h"
#include "process/bytes.h"
#include "process/processes.h"
#include "process/progress.h"

#include <string>

namespace whirl::process {

void agree_on_failure(const std::string &mine) {
    std::vector<char> first;
    for (const std::vector<char> &message : gather(std::vector<char>(mine.begin(), mine.end())))
        if (first.empty())
            first = message;
    broadcast(first);
    if (!first.empty())
        throw model::AnalysisFailure({first.begin(), first.end()});
}

std::vector<std::vector<double>>
rows_at(const std::vector<double> &speeds,
        const std::function<std::vector<double>(double speed)> &row) {
    const auto processes = static_cast<std::size_t>(process_count());
    Bytes mine;
    std::string failure;
    try {
        for (auto i = static_cast<std::size_t>(process_rank()); i < speeds.size(); i += processes)
            mine.put_list(row(speeds[i]));
    } catch (const model::AnalysisFailure &error) {
        failure = error.what();
    }
    agree_on_failure(failure);
    std::vector<Bytes> parts = gather(mine);
    std::vector<std::vector<double>> rows(parts.empty() ? 0 : speeds.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        parts[i % processes].get_list(rows[i]);
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
    Bytes mine;
    std::string failure;
    {
        SharedCounter counter;
        if (first && process_rank() == 0)
            failure = failure_of(first);
        const Stage all(model::Sentence(doing), 0, 1);
        const double whole = static_cast<double>(count);
        for (std::size_t piece = 0; failure.empty() && (piece = counter.next()) < count;) {
            const Stage one(model::Sentence(doing), static_cast<double>(piece) / whole,
                            static_cast<double>(piece + 1) / whole);
            failure = failure_of([&] {
                const Outcome outcome = work(piece);
                mine.put(piece);
                mine.put_list(outcome.numbers);
                mine.put_list(outcome.text);
            });
        }
        if (!failure.empty())
            counter.skip(count); // the others end after what they have asked for
    }
    agree_on_failure(failure);
    std::vector<Bytes> parts = gather(mine);
    std::vector<Outcome> outcomes(parts.empty() ? 0 : count);
    for (Bytes &part : parts)
        while (!part.at_end()) {
            Outcome &outcome = outcomes.at(part.get<std::size_t>());
            part.get_list(outcome.numbers);
            part.get_list(outcome.text);
        }
    return outcomes;
}

} // namespace whirl::process

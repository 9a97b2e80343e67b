#include "studio/computations.h"

#include "model/errors.h"
#include "process/child.h"

#include <optional>

namespace whirl::studio {

namespace {

/// How often a run is asked whether it is still wanted. A fifteenth of what a picture may take.
constexpr double look_every = 0.02; // s

/// Panels that are remembered; each open page has a handful.
constexpr std::size_t most_panels = 1000;

std::string without_line_end(std::string text) {
    while (text.ends_with('\n'))
        text.pop_back();
    return text;
}

} // namespace

bool Computations::is_newest(const std::string &panel, long long number) {
    const std::lock_guard guard(_lock);
    const auto found = _newest.find(panel);
    return found != _newest.end() && found->second == number;
}

Computations::Answer Computations::run(const std::string &panel, long long number,
                                       const std::vector<std::string> &words,
                                       const std::function<bool()> &gone) {
    {
        const std::lock_guard guard(_lock);
        if (_newest.size() > most_panels)
            _newest.clear(); // what still runs for them ends as superseded
        const auto [place, first] = _newest.try_emplace(panel, number);
        if (!first && place->second >= number)
            return {.superseded = true};
        place->second = number;
    }
    // This very program, also where its file was replaced since it was started.
    std::vector<std::string> line{"/proc/self/exe"};
    line.insert(line.end(), words.begin(), words.end());
    try {
        std::optional<process::Child> child = process::Child::start(line, "");
        if (!child)
            return {.failed = true, .errors = "whirl cannot start itself: /proc is not there"};
        while (!child->ended_within(look_every))
            if (!is_newest(panel, number) || gone())
                return {.superseded = true};
        const std::string how = child->failure();
        const std::string errors = without_line_end(child->errors());
        return {.failed = !how.empty(),
                .output = child->output(),
                .errors = how.empty() || !errors.empty() ? errors : "the analysis ended: " + how};
    } catch (const model::AnalysisFailure &failure) {
        return {.failed = true, .errors = failure.what()};
    }
}

void Computations::leave(const std::string &panels) {
    const std::lock_guard guard(_lock);
    std::erase_if(_newest, [&](const auto &entry) { return entry.first.starts_with(panels); });
}

} // namespace whirl::studio

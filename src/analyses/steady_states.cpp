#include "analyses/steady_states.h"

#include "model/errors.h"
#include "process/progress.h"
#include "states/state_search.h"

#include <fmt/format.h>

#include <utility>

namespace whirl::analyses {

std::optional<results::SteadyStates> steady_states_of(const model::Case &scene,
                                                      std::vector<results::Sentence> &notes,
                                                      const CaseWith &with) {
    if (!scene.states)
        return std::nullopt;
    try {
        const process::Stage stage("steady states", 0.95, 1.0);
        const std::vector<double> speeds = scene.states->speeds.empty()
                                               ? model::required_speeds(scene).values()
                                               : scene.states->speeds;
        if (!with || !scene.map || !scene.map->y.values.empty())
            return states::steady_states(scene, speeds);
        const model::SweepAxis &over = scene.map->x;
        return states::steady_states_over(
            over, speeds.front(), [&](double value) { return with(overrides_at(over, value)); });
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    } catch (const model::BadInput &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    }
    return std::nullopt;
}

std::vector<std::string> overrides_at(const model::SweepAxis &axis, double value,
                                      std::vector<std::string> others) {
    for (const model::SweptEntry &entry : axis.entries)
        others.push_back(fmt::format("{}={}", entry.path, axis.at(entry, value)));
    return others;
}

} // namespace whirl::analyses

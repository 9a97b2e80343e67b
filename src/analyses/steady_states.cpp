#include "analyses/steady_states.h"

#include "model/errors.h"
#include "process/progress.h"
#include "states/state_search.h"

namespace whirl::analyses {

std::optional<results::SteadyStates> steady_states_of(const model::Case &scene,
                                                      std::vector<results::Sentence> &notes) {
    if (!scene.states)
        return std::nullopt;
    try {
        const process::Stage stage("steady states", 0.95, 1.0);
        return states::steady_states(scene, scene.states->speeds.empty()
                                                ? model::required_speeds(scene).values()
                                                : scene.states->speeds);
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    } catch (const model::BadInput &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    }
    return std::nullopt;
}

} // namespace whirl::analyses

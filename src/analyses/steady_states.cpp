#include "analyses/steady_states.h"

#include "analyses/axes.h"
#include "model/errors.h"
#include "process/progress.h"
#include "states/state_search.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <utility>

namespace whirl::analyses {

namespace {

results::SteadyStates states_over(const model::SweepAxis &over, double speed,
                                  const RotorsOver &rotors) {
    std::map<double, double> changes; // by values at which there is such a rotor
    results::SteadyStates found = states::steady_states_over(over, speed, [&](double value) {
        RotorsOver::Rotor rotor = rotors.at({value});
        changes[value] = rotor.changes.front();
        return std::move(rotor.scene);
    });
    for (const double value : over.dimensionless ? over.values : std::vector<double>{}) {
        const auto change = changes.find(value);
        found.changes.push_back(change != changes.end() ? change->second
                                                        : std::numeric_limits<double>::quiet_NaN());
    }
    if (!found.refused.empty())
        found.notes.emplace_back("no steady states with {} = {}, there is no such rotor: {}",
                                 over.dimensionless ? over.dimensionless->name : over.label,
                                 model::ValueOf{over.quantity}.list(found.refused),
                                 found.why_refused);
    return found;
}

} // namespace

std::optional<results::SteadyStates> steady_states_of(const model::Case &scene,
                                                      std::vector<results::Sentence> &notes,
                                                      const CaseWith &with) {
    if (!scene.states)
        return std::nullopt;
    try {
        const process::Stage stage("steady states", 0.95, 1.0);
        const auto with_notes = [&notes](results::SteadyStates found) {
            notes.insert(notes.end(), found.notes.begin(), found.notes.end());
            return found;
        };
        const std::vector<double> speeds = scene.states->speeds.empty()
                                               ? model::required_speeds(scene).values()
                                               : scene.states->speeds;
        if (!with || !scene.map || !scene.map->y.values.empty())
            return with_notes(states::steady_states(scene, speeds));
        if (speeds.front() == 0)
            throw model::BadInput(fmt::format(
                "{}: {}: expected a spin speed other than 0 to follow states over {}, got 0: at "
                "rest every position of the balls is steady",
                scene.file.generic_string(),
                scene.states->speeds.empty() ? "speeds.from" : "states.speeds",
                scene.map->x.label));
        const RotorsOver rotors({scene.map->x}, with);
        return with_notes(states_over(scene.map->x, speeds.front(), rotors));
    } catch (const model::AnalysisFailure &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    } catch (const model::BadInput &failure) {
        notes.emplace_back("no steady states: {}", failure.sentence());
    }
    return std::nullopt;
}

} // namespace whirl::analyses

#include "analyses/notes/resolved_ends.h"

#include "balancers/arrangement.h"
#include "ends/finer_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::analyses {

namespace {

/// By finer elements, of ends that are roots.
void add_errors(const ends::AllMotions &motions, const stability::StabilityModel &model,
                const std::vector<ends::WholeMotion> &roots,
                std::vector<results::StabilityEnd> &ends) {
    std::optional<ends::FinerEnds> finer;
    for (results::StabilityEnd &end : ends) {
        const auto root = std::find_if(roots.begin(), roots.end(), [&end](const auto &known) {
            return known.speed == end.speed;
        });
        if (root == roots.end())
            continue;
        if (!finer)
            finer.emplace(motions.discretization(), model.form,
                          balancers::arrangement_at_balance(model.rotor));
        constexpr double reach = 0.1; // of the speed: farther away it is another one
        end.resolved.error = finer->error(*root, end.growing_above > end.growing_below ? 1 : -1,
                                          reach * std::abs(end.speed));
    }
}

} // namespace

bool drives_every_frequency(const model::Rotor &rotor) {
    if (rotor.shaft.rigid)
        return false;
    return !rotor.shaft.torque_has_potential() ||
           std::any_of(rotor.bearings.begin(), rotor.bearings.end(), [](const auto &bearing) {
               return std::any_of(
                   bearing.rows.begin(), bearing.rows.end(),
                   [](const model::BearingCoefficients &at) { return model::pushes_away(at.c); });
           });
}

void tell_resolved_apart(const ends::AllMotions &motions, const stability::StabilityModel &model,
                         const std::vector<ends::WholeMotion> &roots,
                         results::StabilityResult &result) {
    const double top = motions.resolved_up_to();
    if (!std::isfinite(top))
        return;
    result.resolved_up_to = top;
    for (const double speed : result.speeds)
        result.resolved_growth.push_back(motions.fastest_growing(speed, top).real());
    const auto fast = std::stable_partition(result.ends.begin(), result.ends.end(),
                                            [](const auto &end) { return end.resolved.motion; });
    result.unresolved_ends.assign(fast, result.ends.end());
    result.ends.erase(fast, result.ends.end());
    for (results::StabilityEnd &end : result.ends)
        if (end.resolved.below >= 0) {
            end.growing_below = end.resolved.below;
            end.growing_above = end.resolved.above;
        }
    add_errors(motions, model, roots, result.ends);
    result.model.notes.push_back(fmt::format(
        "growing motions are counted up to {:.6g} rad/s, at every speed: the modes at rest have "
        "their frequencies to 1 % up to there with these elements. What drives the rotor drives "
        "faster ones too, as many as there are elements for: the growth is that of all of them, "
        "{}",
        top,
        result.unresolved_ends.empty() ? "none of which begins or ceases to grow in the range"
                                       : fmt::format("{} ends are listed apart (unresolved_ends)",
                                                     result.unresolved_ends.size())));
}

} // namespace whirl::analyses

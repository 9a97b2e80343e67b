#include "analyses/notes/drive.h"

#include "analyses/notes/resolved_ends.h"
#include "balancers/arrangement.h"
#include "ends/all_motions.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "stability/motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

void note_negative_damping(const model::Rotor &rotor, results::StabilityResult &result) {
    const bool grows = std::ranges::any_of(result.growth, [](double value) { return value > 0; });
    if (grows && !rotor.shaft.rigid && has_negative_damping(rotor))
        result.model.notes.emplace_back(
            "a bearing or seal has negative damping, which drives motions of every frequency: "
            "growth can be that of a motion as fast as the elements resolve, and rises with their "
            "number and order; campbell has the growth of the slow modes");
}

/// Growth at a speed, 1/s.
double growth_at(const stability::StabilityModel &model, double speed) {
    const auto arrangement = balancers::arrangement_at_balance(model.rotor);
    if (model.form == results::Form::hill)
        return stability::growth_of(stability::MotionSolver(model, arrangement).at(speed));
    const assembly::Discretization d(model.rotor, model.order);
    return ends::AllMotions(d, model.form, arrangement, nullptr, speed, speed)
        .fastest_growing(speed)
        .value.real();
}

void note_torque(const stability::StabilityModel &model, results::StabilityResult &result) {
    const auto fastest = std::ranges::max_element(result.growth);
    if (model.rotor.shaft.torque_has_potential() || fastest == result.growth.end() ||
        !(*fastest > 0))
        return;
    const double speed = result.speeds[static_cast<std::size_t>(fastest - result.growth.begin())];
    stability::StabilityModel other = model;
    other.rotor.shaft.torque_kind = model::TorqueKind::semitangential;
    other.top = std::abs(speed);
    try {
        const double left = std::max(0.0, growth_at(other, speed));
        if (left > 0.9 * *fastest)
            return;
        result.model.notes.push_back(fmt::format(
            "an axial torque of this kind has no potential and does work on a shaft whose ends "
            "tilt: it drives motions that grow by {:.4g} 1/s at {:.6g} rad/s; with torque_kind = "
            "\"semitangential\", which has a potential, {}. Damping of the shaft (beta, "
            "internal_damping) holds fast motions; without it how many grow, and ends of growth of "
            "motions as fast as the elements resolve, change with their number and order: campbell "
            "has the slow modes",
            *fastest, speed,
            left > 0 ? fmt::format("{:.4g} 1/s are left there", left) : "none grows there"));
    } catch (const model::AnalysisFailure &) { // no more than a note
    } catch (const linalg::SolverError &) {
    }
}

} // namespace

void note_drives(const stability::StabilityModel &model, results::StabilityResult &result) {
    note_negative_damping(model.rotor, result);
    note_torque(model, result);
}

} // namespace whirl::analyses

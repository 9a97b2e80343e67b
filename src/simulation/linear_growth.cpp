#include "simulation/linear_growth.h"

#include "balancers/arrangement.h"
#include "balancers/balance_family.h"
#include "balancers/balanced_position.h"
#include "ends/growth.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "stability/rotor_at_speeds.h"

#include <algorithm>
#include <cmath>

namespace whirl::simulation {

namespace {

bool balanced_position_exists(const model::Rotor &rotor) {
    const bool others =
        std::ranges::any_of(rotor.imbalances, [](const model::Imbalance &i) { return i.mr != 0; });
    const bool pendulums = std::ranges::any_of(rotor.balancers, [](const model::Balancer &b) {
        return balancers::kind_of(b)->circled().empty() && b.imbalance > 0;
    });
    return !others && !pendulums && !balancers::has_eccentric_race(rotor.balancers) &&
           !balancers::has_obstructed_race(rotor.balancers);
}

/// The masses cancel the imbalances of their balancers to a twentieth.
bool balances(const model::Rotor &rotor, const std::vector<std::vector<double>> &angles) {
    if (angles.size() != rotor.balancers.size())
        return false;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const model::Balancer &b = rotor.balancers[i];
        const auto kind = balancers::kind_of(b);
        const auto circled = kind->circled();
        const double moment = std::abs(balancers::defect_of(
            circled, b.imbalance, balancers::turned(angles[i], -b.imbalance_phase)));
        if (!circled.empty() && moment > 0.05 * kind->reach().side_by_side)
            return false;
    }
    return true;
}

/// Angles of the circled masses alone, which come first.
balancers::Arrangement of_masses(const model::Rotor &rotor, balancers::Arrangement angles) {
    for (std::size_t i = 0; i < angles.size(); ++i)
        angles[i].resize(balancers::kind_of(rotor.balancers[i])->circled().size());
    return angles;
}

} // namespace

std::optional<double> linear_growth(const model::Case &scene, double speed,
                                    const std::vector<std::vector<double>> &angles) {
    if (!balanced_position_exists(scene.rotor))
        return std::nullopt;
    model::Case at = scene;
    at.formulation = model::FormChoice::automatic;
    at.speeds = model::SpeedRange{speed, speed, 1};
    try {
        const stability::StabilityModel model = stability::stability_model(at, {speed});
        const balancers::Arrangement arrangement =
            balances(scene.rotor, angles) ? of_masses(scene.rotor, angles)
                                          : balancers::arrangement_at_balance(scene.rotor);
        const double growth = ends::Growth(model, arrangement, {speed}).at(speed);
        return std::isnan(growth) ? std::nullopt : std::optional(growth);
    } catch (const model::BadInput &) { // no balanced position
        return std::nullopt;
    } catch (const model::AnalysisFailure &) {
        return std::nullopt;
    } catch (const linalg::SolverError &) {
        return std::nullopt;
    }
}

} // namespace whirl::simulation

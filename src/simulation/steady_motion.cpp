#include "simulation/steady_motion.h"

#include "forced/response_places.h"
#include "linalg/check.h"
#include "modes/orbits.h"
#include "simulation/scene_outside.h"

#include <algorithm>
#include <utility>

namespace whirl::simulation {

model::Rotor rotor_at_end(const model::Case &scene, const results::SimulateResult &result) {
    model::Rotor rotor = rotor_with_nodes(scene);
    for (const model::SuddenImbalance &imbalance : scene.simulate.imbalances)
        if (imbalance.time < result.time)
            rotor.imbalances.push_back(
                {imbalance.name, imbalance.z, imbalance.mr, imbalance.phase});
    return rotor;
}

model::Case driven(const model::Case &scene, model::Rotor rotor,
                   const results::SimulateResult &result) {
    model::Case steady = scene;
    steady.rotor = std::move(rotor);
    const auto [low, high] = std::ranges::minmax_element(result.series.speed);
    steady.speeds = model::SpeedRange{*low, *high, 2};
    if (!scene.rotor.balancers.empty()) // they may have asked for a form of their own
        steady.formulation = model::FormChoice::automatic;
    return steady;
}

SteadyMotion::SteadyMotion(const assembly::Discretization &d, results::Form form, double speed)
    : _d(d), _motion(d, form) {
    _motion.solve(speed);
    if (_motion.rounding() > forced::resonance_rounding)
        throw linalg::SolverError("a resonance without damping");
}

double SteadyMotion::amplitude(double z) const {
    const forced::Phasor u = _motion.motion(_d.deflection_at(z));
    return modes::ellipse_of(u.x, u.y).major;
}

std::complex<double> SteadyMotion::in_rotor(double z) const {
    return forced::WhirlParts(_motion.motion(_d.deflection_at(z))).a;
}

double SteadyMotion::largest(const results::SimulateResult &result) const {
    double out = 0;
    for (const results::BalancerMotion &b : result.balancers)
        out = std::max(out, amplitude(b.z));
    for (const results::StationMotion &station : result.stations)
        out = std::max(out, amplitude(station.z));
    return out;
}

} // namespace whirl::simulation

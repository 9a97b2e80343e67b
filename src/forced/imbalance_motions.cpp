#include "forced/imbalance_motions.h"

#include "forced/response_places.h"

namespace whirl::forced {

namespace {

/// The rotor with nodes where imbalances are.
model::Rotor with_places(model::Rotor rotor,
                         const std::vector<ImbalanceMotions::Imbalances> &sets) {
    for (const ImbalanceMotions::Imbalances &set : sets)
        for (const model::Imbalance &imbalance : set)
            rotor.stations.push_back({imbalance.z});
    return rotor;
}

} // namespace

ImbalanceMotions::ImbalanceMotions(const model::Rotor &rotor, int order, results::Form form,
                                   const std::vector<Imbalances> &sets, int parts)
    : _mesh(std::make_unique<assembly::Discretization>(with_places(rotor, sets), order, parts)),
      _motion(*_mesh, form, {.sets = sets}) {}

bool ImbalanceMotions::solve(double speed) {
    if (!solves(_motion, speed))
        return false;
    _rounding = _motion.rounding();
    return _rounding <= resonance_rounding;
}

bool ImbalanceMotions::solve_unjudged(double speed) { return solves(_motion, speed); }

} // namespace whirl::forced

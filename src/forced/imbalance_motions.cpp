#include "forced/imbalance_motions.h"

#include "forced/response_places.h"

#include <algorithm>

namespace whirl::forced {

ImbalanceMotions::ImbalanceMotions(const model::Rotor &rotor, int order, results::Form form,
                                   const std::vector<Imbalances> &sets) {
    model::Rotor on_one_mesh = rotor;
    for (const Imbalances &set : sets)
        for (const model::Imbalance &imbalance : set)
            on_one_mesh.stations.push_back({imbalance.z});
    for (const Imbalances &set : sets) {
        on_one_mesh.imbalances = set;
        _discretizations.push_back(std::make_unique<assembly::Discretization>(on_one_mesh, order));
    }
    for (const auto &discretization : _discretizations)
        _motions.emplace_back(*discretization, form);
}

bool ImbalanceMotions::solve(double speed) {
    return std::ranges::all_of(_motions, [speed](ForcedMotion &motion) {
        return solves(motion, speed) && motion.rounding() <= resonance_rounding;
    });
}

} // namespace whirl::forced

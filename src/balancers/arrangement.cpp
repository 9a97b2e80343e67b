#include "balancers/arrangement.h"

#include "balancers/balanced_position.h"
#include "model/errors.h"

#include <algorithm>

namespace whirl::balancers {

namespace {

/// Before anything is asked of balanced positions that there are not.
void refuse_obstructed(const model::Rotor &rotor) {
    if (has_obstructed_race(rotor.balancers))
        throw model::AnalysisFailure(
            "small motions about the balanced position are those of balls in round races across "
            "the shaft without walls; others stand elsewhere: `simulate` and `balance` with "
            "[states] find where");
}

bool has_positions(const model::Balancer &balancer) {
    return !kind_of(balancer)->circled().empty();
}

/// @param angles  of the circled masses in the rotor (not from the imbalance), rad; none of
///                pendulums
BalancerElement balancer_element(const model::Balancer &balancer,
                                 const std::vector<double> &angles) {
    const auto kind = kind_of(balancer);
    const AddedInertias added = added_inertias(balancer);
    BalancerElement out;
    out.z = balancer.z;
    out.mass = mass_of(balancer);
    out.polar_inertia = added.polar();
    if (balancer.tilt_inertia) {
        const std::vector<CircledMass> circled = kind->circled();
        for (std::size_t j = 0; j < circled.size(); ++j)
            out.anisotropy += std::polar(0.5 * circled[j].inertia, 2 * angles[j]);
        out.anisotropy += 0.5 * added.imbalance * std::polar(1.0, 2 * balancer.imbalance_phase);
    }
    out.parts = kind->small_motions(angles);
    return out;
}

} // namespace

Arrangement arrangement_at_balance(const model::Rotor &rotor) {
    refuse_obstructed(rotor);
    Arrangement out;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        out.push_back(has_positions(rotor.balancers[i])
                          ? turned(angles_at_balance(rotor.balancers[i], rotor.balancer_path(i)),
                                   rotor.balancers[i].imbalance_phase)
                          : std::vector<double>{});
    return out;
}

std::vector<BalancerElement> balancer_elements(const model::Rotor &rotor,
                                               const Arrangement &arrangement) {
    refuse_obstructed(rotor);
    std::vector<BalancerElement> out;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        out.push_back(balancer_element(rotor.balancers[i], arrangement[i]));
    return out;
}

std::vector<Arrangement> sampled_arrangements(const model::Rotor &rotor, int count) {
    std::vector<Arrangement> choices; // of each balancer
    std::size_t most = 1;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        choices.push_back(has_positions(rotor.balancers[i])
                              ? sampled_positions(rotor.balancers[i], count, rotor.balancer_path(i))
                              : Arrangement{{}});
        most = std::max(most, choices.back().size());
    }
    // Each balancer runs through its own list with its own stride, so that several balancers do
    // not always stand at the same place of the family together.
    std::vector<Arrangement> out;
    for (std::size_t k = 0; k < most; ++k) {
        Arrangement arrangement;
        for (std::size_t i = 0; i < choices.size(); ++i)
            arrangement.push_back(turned(choices[i][k * (2 * i + 1) % choices[i].size()],
                                         rotor.balancers[i].imbalance_phase));
        out.push_back(std::move(arrangement));
    }
    return out;
}

} // namespace whirl::balancers

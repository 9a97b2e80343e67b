#include "balancers/linear_element.h"

#include "balancers/balanced_position.h"

namespace whirl::balancers {

BalancerElement balancer_element(const model::Balancer &balancer,
                                 const std::vector<double> &angles) {
    const auto kind = kind_of(balancer);
    const PartsInertia inertia = kind->inertia();
    const std::vector<CircledMass> circled = kind->circled();
    BalancerElement out;
    out.z = balancer.z;
    out.mass = inertia.mass;
    out.polar_inertia = inertia.on_circle + inertia.own;
    for (std::size_t j = 0; j < circled.size(); ++j)
        out.anisotropy += std::polar(0.5 * circled[j].inertia, 2 * angles[j]);
    out.mass += imbalance_mass(balancer);
    out.polar_inertia += imbalance_inertia(balancer);
    out.anisotropy += std::polar(0.5 * imbalance_inertia(balancer), 2 * balancer.imbalance_phase);
    if (!balancer.tilt_inertia) {
        out.polar_inertia = 0;
        out.anisotropy = 0;
    }
    out.diametral_inertia = out.polar_inertia / 2;
    out.parts = kind->small_motions(angles);
    return out;
}

int unknowns_of(const std::vector<BalancerElement> &elements) {
    int sum = 0;
    for (const BalancerElement &element : elements)
        sum += element.unknowns();
    return sum;
}

} // namespace whirl::balancers

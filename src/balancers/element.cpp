#include "balancers/element.h"

namespace whirl::balancers {

namespace {

/// Four hinged arms seen as one body: their masses stand on two perpendicular lines, which makes
/// them axisymmetric.
BalancerElement pendulum_element(const model::Balancer &balancer) {
    BalancerElement out;
    const double reach = balancer.pivot + balancer.arm;
    out.moving_mass = 4 * balancer.mass;
    out.polar_inertia = out.moving_mass * reach * reach;
    out.damping = balancer.damping / (balancer.mass * balancer.arm * balancer.arm);
    out.restoring = balancer.pivot / balancer.arm;
    return out;
}

BalancerElement ball_element(const model::Balancer &balancer, std::complex<double> D) {
    BalancerElement out;
    out.moving_mass = balancer.n * balancer.mass;
    out.polar_inertia = out.moving_mass * balancer.radius * balancer.radius;
    out.anisotropy = 0.5 * out.polar_inertia * D;
    out.second_harmonic = D;
    out.damping = balancer.damping / balancer.mass;
    return out;
}

} // namespace

BalancerElement balancer_element(const model::Balancer &balancer,
                                 std::complex<double> second_harmonic) {
    const bool balls = balancer.kind == model::BalancerKind::ball;
    BalancerElement out =
        balls ? ball_element(balancer, second_harmonic) : pendulum_element(balancer);
    out.z = balancer.z;
    out.mass = out.moving_mass;
    if (balancer.imbalance_radius) { // a point mass m0 at R0
        out.mass += balancer.imbalance / *balancer.imbalance_radius;
        const double inertia = balancer.imbalance * *balancer.imbalance_radius;
        out.polar_inertia += inertia;
        out.anisotropy += std::polar(0.5 * inertia, 2 * balancer.imbalance_phase);
    }
    if (!balancer.tilt_inertia) {
        out.polar_inertia = 0;
        out.anisotropy = 0;
    }
    out.diametral_inertia = out.polar_inertia / 2;
    return out;
}

} // namespace whirl::balancers

#pragma once

#include "analyses/stability.h"
#include "balancers/arrangement.h"
#include "support/balancer_parts.h"
#include "support/balancer_scenes.h"

#include <cmath>
#include <complex>

namespace whirl::tests {

/// The rotor's imbalance: eccentricity at the phase beta = 1 against the tilt of its principal
/// axis.
struct Imbalance {
    double eccentricity = 0; ///< eps
    double tilt = 0;         ///< chi, rad
    double phase = 0;        ///< beta, rad
};

/// What the race at z, one of two at +-z, has to balance: half of the static part, and half of the
/// couple chi (Jt - Jp) over z.
inline std::complex<double> share_of(const Imbalance &imbalance, double z) {
    constexpr double Jt = 3.25;
    constexpr double Jp = 0.5;
    return 0.5 *
           (std::polar(imbalance.eccentricity, imbalance.phase) + imbalance.tilt * (Jt - Jp) / z);
}

inline model::Case rotor_with(const Imbalance &imbalance, double ball_mass, double race_damping) {
    model::Case scene = rodrigues_rotor(1, imbalance.eccentricity, ball_mass);
    scene.rotor.imbalances.clear();
    double z = -2;
    for (model::Balancer &balancer : scene.rotor.balancers) {
        const std::complex<double> share = share_of(imbalance, z);
        balancer.imbalance = std::abs(share);
        balancer.imbalance_phase = std::arg(share);
        tests::row(balancer).damping = race_damping * ball_mass;
        balancer.tilt_inertia = false;
        z = 2;
    }
    return scene;
}

/// The speed above which the balanced position is stable up to `to`.
inline double stable_above(model::Case scene, double from, double to) {
    scene.speeds = model::SpeedRange{from, to, 81};
    const auto bands =
        analyses::unstable_bands_of(scene, balancers::arrangement_at_balance(scene.rotor), false)
            .bands;
    return bands.empty() ? from : bands.back().to;
}

} // namespace whirl::tests

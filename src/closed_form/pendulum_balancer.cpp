#include "closed_form/pendulum_balancer.h"

#include <cmath>

namespace whirl::closed_form {

using namespace std::complex_literals;

double exact_efficiency(const PendulumRotor &rotor, const PendulumMotion &motion,
                        double speed_ratio) {
    const double R = speed_ratio;
    const std::complex<double> held = rotor.mass_ratio * R * R * rotor.imbalance /
                                      (1.0 - R * R + 1i * R * rotor.external_damping);
    return std::abs(motion.position) / std::abs(held);
}

double approximate_efficiency(const PendulumRotor &rotor, double speed_ratio) {
    const double R2 = speed_ratio * speed_ratio;
    const double damping = speed_ratio * rotor.external_damping;
    return std::hypot(1.0 - R2, damping) /
           std::hypot(1.0 - R2 * (1.0 + rotor.effectiveness()), damping);
}

double efficiency_threshold(const PendulumRotor &rotor) {
    return 1.0 / std::sqrt(1.0 + 0.5 * rotor.effectiveness());
}

double efficiency_limit(const PendulumRotor &rotor) { return 1.0 / (1.0 + rotor.effectiveness()); }

} // namespace whirl::closed_form

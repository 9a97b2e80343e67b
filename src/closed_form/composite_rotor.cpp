#include "closed_form/composite_rotor.h"

#include <cmath>

namespace whirl::closed_form {

double CompositeRotor::mean_inertia() const {
    return base_inertia + 0.5 * (imbalance_inertia + ball_inertia);
}

std::complex<double> CompositeRotor::anisotropy() const {
    return 0.5 * (imbalance_inertia + ball_inertia * second_harmonic);
}

double CompositeRotor::inertia_about(double angle) const {
    return mean_inertia() - (anisotropy() * std::polar(1.0, -2.0 * angle)).real();
}

CompositeRotor CompositeRotor::with_unsigned_harmonic() const {
    CompositeRotor other = *this;
    other.second_harmonic = std::abs(second_harmonic);
    return other;
}

CompositeRotor composite_rotor(const BareRotor &rotor, const BallSet &balls,
                               const PlaneImbalance &imbalance,
                               std::complex<double> second_harmonic) {
    const double ball_mass = balls.count * balls.mass;
    const double added = imbalance.mass + ball_mass;
    CompositeRotor composite;
    composite.mass = rotor.mass + added;
    composite.balancer_position = rotor.mass * rotor.balancer_distance / composite.mass;
    composite.rotor_position = -added * rotor.balancer_distance / composite.mass;
    composite.base_inertia = rotor.diametral_inertia +
                             rotor.mass * std::pow(composite.rotor_position, 2) +
                             added * std::pow(composite.balancer_position, 2);
    composite.ball_inertia = ball_mass * balls.radius * balls.radius;
    composite.imbalance_inertia = imbalance.inertia();
    composite.polar_inertia =
        rotor.polar_inertia + composite.imbalance_inertia + composite.ball_inertia;
    composite.second_harmonic = second_harmonic;
    return composite;
}

} // namespace whirl::closed_form

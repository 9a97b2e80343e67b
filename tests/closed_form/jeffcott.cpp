#include "closed_form/jeffcott.h"

#include <cmath>
#include <limits>

namespace whirl::closed_form {

using namespace std::complex_literals;

double jeffcott_critical_speed(const JeffcottRotor &rotor) {
    return std::sqrt(rotor.stiffness / rotor.mass);
}

std::complex<double> jeffcott_response(const JeffcottRotor &rotor, double spin_speed) {
    const double inertia = rotor.mass * spin_speed * spin_speed;
    return rotor.eccentricity * inertia /
           (rotor.stiffness - inertia + 1i * spin_speed * rotor.external_damping);
}

JeffcottRoots jeffcott_roots(const JeffcottRotor &rotor, double spin_speed) {
    const double half_damping =
        0.5 * (rotor.external_damping + rotor.internal_damping) / rotor.mass;
    const std::complex<double> constant =
        (rotor.stiffness - 1i * spin_speed * rotor.internal_damping) / rotor.mass;
    // The branch with a positive imaginary part is the forward one (constant has Im <= 0 for Omega
    // >= 0).
    std::complex<double> root = std::sqrt(half_damping * half_damping - constant);
    if (root.imag() < 0.0)
        root = -root;
    return {-half_damping + root, -half_damping - root};
}

double internal_damping_threshold(const JeffcottRotor &rotor) {
    if (rotor.internal_damping <= 0.0)
        return std::numeric_limits<double>::infinity();
    return jeffcott_critical_speed(rotor) * (1.0 + rotor.external_damping / rotor.internal_damping);
}

} // namespace whirl::closed_form

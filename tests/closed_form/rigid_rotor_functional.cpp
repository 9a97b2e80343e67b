#include "closed_form/rigid_rotor_functional.h"

#include <cmath>

namespace whirl::closed_form {

TwoSupportRotor two_support_rotor(double mass, double diametral_inertia, double polar_inertia,
                                  double k1, double k2, double l1, double l2) {
    return {mass,    diametral_inertia, polar_inertia,
            k1 + k2, k2 * l2 - k1 * l1, k1 * l1 * l1 + k2 * l2 * l2};
}

double frequency_determinant(const TwoSupportRotor &rotor, double spin_speed) {
    const double x = spin_speed * spin_speed;
    const double slenderness = rotor.diametral_inertia - rotor.polar_inertia;
    return (rotor.k11 - rotor.mass * x) * (rotor.k33 - slenderness * x) - rotor.k14 * rotor.k14;
}

Eigen::Matrix2d criterion_matrix(const TwoSupportRotor &rotor, double spin_speed) {
    const double x = spin_speed * spin_speed;
    const double slenderness = rotor.diametral_inertia - rotor.polar_inertia;
    Eigen::Matrix2d form;
    form << rotor.k11 - rotor.mass * x, -rotor.k14, -rotor.k14, rotor.k33 - slenderness * x;
    return form / frequency_determinant(rotor, spin_speed);
}

std::optional<double> largest_plane_distance(const TwoSupportRotor &rotor) {
    if (rotor_type(rotor.diametral_inertia, rotor.polar_inertia) != RotorType::short_rotor)
        return std::nullopt;
    return std::sqrt((rotor.polar_inertia - rotor.diametral_inertia) / rotor.mass);
}

} // namespace whirl::closed_form

#include "rigid/tilt_motion.h"

#include "closed_form/anisotropic_rotor.h"
#include "model/case.h"
#include "process/parallel.h"
#include "rigid/projection.h"

#include <cmath>

namespace whirl::rigid {

std::optional<double> rigid_permissible_anisotropy(const model::Rotor &rotor, double from,
                                                   double to) {
    if (!rotor.balancers.empty() || rotor.anisotropies.size() != 1 || rotor.shaft.asymmetric() ||
        rotor.bearings_depend_on_speed())
        return std::nullopt;
    const std::optional<RigidRotor> body = rigid_projection(rotor);
    if (!body || body->k33 <= 0)
        return std::nullopt;
    // Tilt must not move the centre of mass.
    constexpr double rounding = 1e-9;
    if (std::abs(body->k14) > rounding * std::sqrt(body->k11 * body->k33) ||
        std::abs(body->h14) > rounding * std::sqrt(body->h11 * body->h33))
        return std::nullopt;
    closed_form::AnisotropicRotor tilt;
    tilt.polar_inertia = body->C / body->A;
    tilt.frequency = std::sqrt(body->k33 / body->A);
    tilt.damping = body->h33 / body->A;
    const auto [least, largest] = model::range_of_moduli(from, to);
    return body->A * closed_form::permissible_anisotropy(tilt, least, largest).anisotropy;
}

} // namespace whirl::rigid

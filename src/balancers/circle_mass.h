#pragma once

#include "balancers/parts_motion.h"

#include <cmath>
#include <optional>

namespace whirl::balancers {

/// A point on a circle about the axis: a ball (angle free), or a mass fixed in the rotor. Its
/// energy, to second order in slopes, c = Re(phi exp(-i g)):
///     T = m |w' + i R g' exp(i g)|^2 / 2 + mu (c'^2 - g'^2 c^2) / 2,  mu = m R^2 (0: no tilt).
/// docs/theory.md, "Motion in time".
struct CircleMass {
    double moment = 0;  ///< m R, kg m
    double inertia = 0; ///< m R^2, kg m2
    double tilt = 0;    ///< mu, kg m2: inertia, or 0 where the tilt inertia is left out
    double weight = 0;  ///< m g R, N m

    /// Writes u, a, b, force, tilt and weight of the equation; the others are not its own.
    /// @param cosine,sine,rate  of g (fixed frame), and g'
    void write_equation(const PlaneMotion &plane, double cosine, double sine, double rate,
                        MassEquation &out) const;
    [[nodiscard]] MassEquation equation(const PlaneMotion &plane, double angle, double rate) const {
        MassEquation out;
        write_equation(plane, std::cos(angle), std::sin(angle), rate, out);
        return out;
    }
    /// At rest in the rotor at an angle: adds what it does (parts_motion.h).
    /// @param index  of its angle among the unknowns, >= 4; none: it is fixed in the rotor
    void add_at_rest(const PlaneVector &place, double speed, double angle,
                     std::optional<Eigen::Index> index, AtRest &out) const;
    [[nodiscard]] MassMomenta momenta(const PlaneMotion &plane, double angle, double rate) const;
};

} // namespace whirl::balancers

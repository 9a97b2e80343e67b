#pragma once

#include "mesh/shaft_mesh.h"
#include "model/rotor.h"

#include <complex>
#include <string>

namespace whirl::rigid {

/// Moments of the mass over z = 0 with the parts' inertias about their own centres: they add up
/// over the parts of a rotor.
struct Inertia {
    double mass = 0;   ///< kg
    double first = 0;  ///< sum of m z, kg m
    double second = 0; ///< sum of m z^2 + own mean diametral inertia, kg m2
    double polar = 0;  ///< kg m2
    /// Anisotropy: modulus (half the difference of the diametral inertias), twice the direction.
    std::complex<double> a; ///< kg m2

    Inertia &operator+=(const Inertia &other);
    Inertia &operator-=(const Inertia &other);
    /// z of the centre of mass, m.
    [[nodiscard]] double center() const { return first / mass; }
    /// Mean diametral inertia about the centre of mass, kg m2.
    [[nodiscard]] double diametral() const { return second - mass * center() * center(); }
};

[[nodiscard]] Inertia inertia_of(const model::Shaft &shaft, const mesh::ShaftMesh &mesh);
/// Balls, or pendulums at rest, with the imbalance where it is a point mass. Their anisotropy,
/// which depends on the position, is left out.
[[nodiscard]] Inertia inertia_of(const model::Balancer &balancer);
/// All that turns.
[[nodiscard]] Inertia inertia_of(const model::Rotor &rotor);

/// "long", "spherical" or "short", by diametral and polar inertia (kg m2); equal within 1e-9.
[[nodiscard]] std::string rigid_type(double Id, double Ip);

} // namespace whirl::rigid

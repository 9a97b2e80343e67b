#pragma once

#include "oracles/criterion.h"

namespace whirl::oracles {

/// The case as one rigid body on its (isotropic) supports, about its centre of mass.
struct RigidRotor {
    Real mass = 0;   ///< kg
    Real centre = 0; ///< z of the centre of mass, m
    Real A = 0;      ///< mean diametral inertia about it, kg m2
    Real C = 0;      ///< polar inertia, kg m2
    Complex a = 0;   ///< anisotropy, |a| exp(2 i angle of the axis of smaller inertia), kg m2
    /// Moments of the supports' coefficients: sum k, sum k z, sum k z^2 with z from the centre.
    Real k0 = 0, k1 = 0, k2 = 0;
    Real c0 = 0, c1 = 0, c2 = 0;
};

/// Shaft, discs and `[[anisotropy]]`, without balancers.
[[nodiscard]] RigidRotor bare_rotor(const CaseRotor &rotor);
/// With the balls and point masses of the balancers at their symmetric balanced positions, whose
/// mass and inertia count (Gorbenko, composite rotor); balancers without imbalance_radius: m0 = 0.
[[nodiscard]] RigidRotor composite_rotor(const CaseRotor &rotor);

/// Forward critical speeds (rad/s), ascending, of a body without anisotropy:
/// M (A - C) w^4 - [(A - C) k0 + M k2] w^2 + k0 k2 - k1^2 = 0 (Filimonikhin et al.).
[[nodiscard]] std::vector<Real> resonances(const RigidRotor &body);
/// The same with anisotropy on supports alike in all directions: A -+ |a| in place of A.
[[nodiscard]] std::vector<Real> split_resonances(const RigidRotor &body);
/// Forward critical speed of the body pinned at a plane (z of the case):
/// w^2 = (k2 + k0 z^2 - 2 k1 z)/(A + M z^2 - C), z from the centre; none where negative.
[[nodiscard]] std::vector<Real> additional_speeds(const RigidRotor &body, double plane);
/// The same with anisotropy, of both principal axes.
[[nodiscard]] std::vector<Real> split_additional_speeds(const RigidRotor &body, double plane);

/// Bands of the empirical criterion for one plane: (w1, w^) and above w2, ended by `to`.
[[nodiscard]] std::vector<Band> rigid_bands(const RigidRotor &body, double plane, Real to);
/// For two planes or more: above w2 of a long rotor, nowhere of another one.
[[nodiscard]] std::vector<Band> rigid_joint_bands(const RigidRotor &body, Real to);
/// Number of independent imbalances among the planes: the rank of J with columns (1, z).
[[nodiscard]] int rigid_rank(const RigidRotor &body, const std::vector<double> &planes);

/// Rotor with unequal diametral inertias A - |a|, A + |a|, symmetric on its supports, in terms of
/// p^2 = k2/A, h = c2/A, C/A and |a|/A (Gorbenko, permissible inertial anisotropy).
struct AnisotropicRotor {
    Real p = 0, h = 0, C = 0, a = 0;
    Real A = 0;

    explicit AnisotropicRotor(const RigidRotor &body);
    [[nodiscard]] std::vector<Real> critical_speeds() const; ///< p/sqrt(1 - C +- a)
    /// Between the roots of [(1-C)^2 - a^2] x^2 - [2 p^2 (1-C) - h^2] x + p^4, x squared speed.
    [[nodiscard]] std::vector<Real> unstable() const;
    [[nodiscard]] Real permissible() const;       ///< (h/p) sqrt(1 - C - h^2/(4 p^2)), of a/A
    [[nodiscard]] Real permissible_speed() const; ///< p/sqrt(1 - C - h^2/(2 p^2))
};

} // namespace whirl::oracles

#pragma once

#include "oracles/rigid_rotor.h"

#include <vector>

namespace whirl::oracles {

/// A ball in its race, or a ring that hangs with clearance on a journal of the rotor.
struct Bead {
    std::size_t balancer = 0;
    Real z = 0;       ///< of its plane, from the rotor's centre of mass, m
    Real mass = 0;    ///< kg
    Real radius = 0;  ///< of the circle its centre moves on, m
    Real damping = 0; ///< N s/m, against sliding
    bool ring = false;
    Real bore = 0;     ///< radius of a ring's bore, m
    Real inertia = 0;  ///< of a ring about its own axis, kg m2
    Real drag = 0;     ///< against its turning in the rotor, N m s
    bool held = false; ///< fixed in the rotor: a point mass, or a ring, without motions of its own
    Real angle = 0;    ///< where it is held, rad
};

/// The beads of a case, balancer after balancer, row after row; then the point masses that
/// imbalances are, held.
[[nodiscard]] std::vector<Bead> beads_of(const CaseRotor &rotor);
/// Angles (rad) of those that are free in the balanced position in which every row takes the same
/// share.
[[nodiscard]] std::vector<Real> balanced_angles(const CaseRotor &rotor);

/// A rigid rotor at constant speed on isotropic supports with all its beads, in axes that turn with
/// it: Re u, Im u, Re p, Im p (displacement of the centre of mass, slopes), then the angle of each
/// bead, a ring's turning about itself behind it. The equations are those of Lagrange, from
/// kinetic energy T, potential V and dissipation F / 2 as they stand in carried.cpp, differentiated
/// by machine.
class CarriedRotor {
  public:
    /// @param speed  rad/s
    CarriedRotor(const CaseRotor &rotor, Real speed);

    [[nodiscard]] const std::vector<Bead> &beads() const { return _beads; }
    [[nodiscard]] Eigen::Index unknowns() const { return _unknowns; }
    /// Place of a bead's angle among the unknowns; negative: held.
    [[nodiscard]] Eigen::Index place(std::size_t bead) const { return _places[bead]; }

    /// Of small motions about the balanced position of the free beads, 1/s; without any about any
    /// motion, the equations being linear.
    [[nodiscard]] std::vector<Complex> eigenvalues(const std::vector<Real> &angles) const;

    /// Accelerations from unknowns q and rates r.
    [[nodiscard]] Eigen::VectorXd acceleration(const Eigen::VectorXd &q,
                                               const Eigen::VectorXd &r) const;
    /// Largest deflection at a bead's plane, m.
    [[nodiscard]] double amplitude(const Eigen::VectorXd &q) const;
    /// The same of the steady motion under the imbalances alone, m.
    [[nodiscard]] double amplitude_without_beads() const;

  private:
    RigidRotor _body;
    Real _speed;
    std::vector<Bead> _beads;
    std::vector<Eigen::Index> _places;
    Eigen::Index _unknowns = 4;
    Real _force = 0, _moment = 0; ///< sums of m0 R0 and m0 R0 z, kg m and kg m2
};

} // namespace whirl::oracles

#pragma once

#include "balancers/pendulum4.h"
#include "model/rotor.h"
#include "synchronous/receptance.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::criterion {

/// A steady motion in the rotating frame: one entry for each balancer.
struct PendulumSteadyMotion {
    Eigen::VectorXcd deflection; ///< of the shaft, m
    Eigen::VectorXd phi;         ///< pendulum angles, rad
    Eigen::VectorXd psi;
};

/// Steady motions of a flexible rotor with four-pendulum balancers, isotropic bearings:
///
///     u = R(Omega) [s + sum 2 m l (x/sqrt(a^2 + x^2) + i y/sqrt(a^2 + y^2))],
///     a tan phi = y, a tan psi = -x at each balancer, u = x + i y,
///
/// R the forward receptance of the rotor with the pendulums' masses as rings of radius a + l. One
/// balancer: the shaft acts through its dynamic stiffness 1/R alone, and the closed form's search
/// for all motions applies.
class PendulumShaft {
  public:
    /// @param rotor      isotropic bearings, without balancers
    /// @param pendulums  of kind pendulum4, pivot > 0
    PendulumShaft(model::Rotor rotor, int order, std::vector<balancers::PlacedPendulums> pendulums,
                  std::vector<model::Imbalance> drive);

    /// Deflections with the pendulums held at phi = psi = 0.
    [[nodiscard]] Eigen::VectorXcd held(double speed);

    /// Steady motions at a speed (rad/s), by Newton's method from the linear motion, from all
    /// motions of the closed form (one balancer) and from those given; ascending in deflection.
    [[nodiscard]] std::vector<PendulumSteadyMotion>
    motions(double speed, const std::vector<PendulumSteadyMotion> &starts);

    /// Rotor with the pendulums' rings, as it is discretised.
    [[nodiscard]] const assembly::Discretization &rotor() const { return _d; }
    [[nodiscard]] const std::vector<balancers::PlacedPendulums> &pendulums() const {
        return _pendulums;
    }
    [[nodiscard]] const std::vector<model::Imbalance> &drive() const { return _drive; }

  private:
    std::vector<balancers::PlacedPendulums> _pendulums;
    std::vector<model::Imbalance> _drive;
    assembly::Discretization _d;
    synchronous::ForwardReceptance _receptance;
    Eigen::MatrixXcd _R;    ///< at the speed looked at, between the balancers
    Eigen::VectorXcd _held; ///< there

    void solve_at(double speed);
    [[nodiscard]] bool newton(Eigen::VectorXcd &u) const;
    [[nodiscard]] std::vector<Eigen::VectorXcd> closed_form_starts() const;
    [[nodiscard]] PendulumSteadyMotion motion_of(const Eigen::VectorXcd &u) const;
};

/// Small motions about a steady one, in the rotating frame: the rotor in its lowest modes at rest
/// and the static deflections under forces at the balancers and bearings, two unknowns a balancer.
class PendulumStability {
  public:
    /// @param bearing_speed  at which the bearings are read, rad/s
    /// @param modes          at rest, that the rotor keeps
    /// @throws linalg::SolverError where the supports leave the rotor free
    PendulumStability(const PendulumShaft &shaft, double bearing_speed, int modes = 8);

    /// Largest real part of the eigenvalues, 1/s.
    [[nodiscard]] double growth(double speed, const PendulumSteadyMotion &motion) const;
    /// Growth below this is rounding, 1/s.
    [[nodiscard]] double rounding(double speed) const;

  private:
    std::vector<balancers::PlacedPendulums> _pendulums;
    Eigen::MatrixXd _M, _G, _K, _Ce, _Ci; ///< of the kept motions
    Eigen::MatrixXd _places;              ///< their deflections at the balancers, rows
    double _stiffest = 0;                 ///< highest frequency kept, rad/s
};

} // namespace whirl::criterion

#pragma once

#include "oracles/case_rotor.h"
#include "oracles/criterion.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::oracles {

/// What stands still in axes that turn with a rotor, axisymmetric or not, under imbalances, which
/// stand still there too: two-node elements (dense_rotor.h), full matrices, real unknowns w and phi
/// of every node along the rotor's x, then the same along its y.
///
/// From the energy: springs store 1/2 EI phi'^2 along each principal axis of a section, and the
/// spin stores -1/2 speed^2 J, J the moment of inertia about the axis of rotation. A mass at w adds
/// m |w|^2. A body whose axis tilts by the slope phi along its principal axis 1 adds (I_1 - I_p)
/// phi^2: the axis 1 gets a component phi along the axis of rotation, where the body had I_p.
class RotorAxes {
  public:
    /// @param rotor  bearings the same from every direction, without pedestals and tables
    /// @param parts  of each element that the case asks for
    explicit RotorAxes(const CaseRotor &rotor, int parts = 1);

    /// Symmetric part of speed^2 x (static receptance), 1/kg: s^T (this) s is the work of the
    /// imbalances s, the rotor's x and y of each place.
    [[nodiscard]] Eigen::MatrixXd form(double speed, const std::vector<double> &places) const;
    /// Its largest eigenvalue.
    [[nodiscard]] double largest(double speed, const std::vector<double> &places) const;

    /// Speeds (rad/s) at which something stands still without a force, with the places held; no
    /// damping.
    [[nodiscard]] std::vector<double> critical_speeds(double from, double to,
                                                      const std::vector<double> &held = {}) const;

    /// Where every imbalance at the places does negative work: signs between all speeds at which an
    /// eigenvalue of the form has a pole or a zero, each end by bisection.
    [[nodiscard]] std::vector<Band> bands(double from, double to,
                                          const std::vector<double> &places) const;

  private:
    std::vector<double> _z;
    Eigen::MatrixXd _springs, _inertia; ///< potential 1/2 q^T (springs - speed^2 inertia) q
    Eigen::MatrixXd _drag;              ///< forces -speed drag q of dampers at rest
    bool _conservative = true;

    [[nodiscard]] Eigen::Index nodes() const { return static_cast<Eigen::Index>(_z.size()); }
    [[nodiscard]] Eigen::Index deflection(double place) const;
    [[nodiscard]] Eigen::MatrixXd loads(const std::vector<double> &places) const;
    [[nodiscard]] std::vector<double> sign_changes(double from, double to,
                                                   const std::vector<double> &places) const;
};

} // namespace whirl::oracles

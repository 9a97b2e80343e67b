#pragma once

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/quadratic_resolvent.h"
#include "results/formulation.h"

#include <Eigen/Core>

namespace whirl::forced {

/// The equations of steady motion P(s) u = f, P = P0 + s P1 + s^2 P2, on planar shapes; in forms
/// other than planar the unknowns are pairs (x, y) of them.
class ShapeTerms {
  public:
    /// @param drive   what s is: the spin speed, or the place along the sweep of forces
    /// @param shapes  a column each, planar unknowns; all must outlive this
    ShapeTerms(const assembly::Discretization &discretization, results::Form form,
               const Drive &drive, const Eigen::MatrixXd &shapes)
        : _discretization(discretization), _form(form), _weight(drive.weight()),
          _sweep(drive.sweep), _V(shapes) {}

    /// Unknowns of a shape.
    [[nodiscard]] Eigen::Index planes() const { return _form == results::Form::planar ? 1 : 2; }
    /// @param bearing_speed  spin speed that the bearings are as at
    [[nodiscard]] QuadraticTerms at(double bearing_speed) const;
    /// Adds a share of what the bearings at a speed are in the terms.
    void add_bearings(double bearing_speed, double share, QuadraticTerms &out) const;

    /// Part of a stiffness k (N/m) and a damping c (N s/m) on (x, y) in P0, and of the damping in
    /// P1.
    [[nodiscard]] Eigen::Matrix2cd constant_block(const Eigen::Matrix2d &k,
                                                  const Eigen::Matrix2d &c) const;
    [[nodiscard]] Eigen::Matrix2cd linear_block(const Eigen::Matrix2d &c) const;
    /// Unknowns to a combination of planar unknowns: a column in each plane.
    [[nodiscard]] Eigen::MatrixXd columns_of(const assembly::Combination &combination) const;

  private:
    const assembly::Discretization &_discretization;
    results::Form _form;
    bool _weight;
    Sweep _sweep;
    const Eigen::MatrixXd &_V;
};

} // namespace whirl::forced

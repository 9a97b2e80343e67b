#pragma once

#include "linalg/dense/products.h"
#include "periodic/system.h"

#include <Eigen/Core>

#include <optional>

namespace whirl::periodic {

/// The maps of steps of one length (collocation.h), s = stages: the state at the end of one is R x
/// + L f, displacements and rates at the places and points (or displacements alone) Y x + Z f, of
/// the state x at its beginning and forces -f at places and points (points one after the other).
class StepMaps {
  public:
    /// @param system  kept by reference
    /// @throws linalg::SolverError where a step meets a singular matrix
    StepMaps(const System &system, double speed, double length);

    /// What a step that begins at a time makes of (q, q'), 2n x 2n.
    void set_map(double from, Eigen::Ref<linalg::Rows> out) const;
    /// The ends of these states, a column each.
    void set_end(double from, const linalg::Rows &states, linalg::Rows &out) const;

  private:
    const System &_system;
    double _speed, _length;
    linalg::Rows _R;    ///< 2n x 2n
    linalg::Rows _L;    ///< 2n x sm
    linalg::Rows _Y;    ///< 2sm x 2n, or sm x 2n
    linalg::Rows _away; ///< -Z, 2sm x sm, or sm x sm

    [[nodiscard]] linalg::Rows forces_onto(double from, const linalg::Rows &observed) const;
};

/// The matrix of half a turn in many steps. The map of so many steps at once is a smooth periodic
/// function of where the first one begins, as long as they take no longer than the rate of a motion
/// takes to show that it differs from place to place: known at even places it is known everywhere,
/// by its Fourier terms, and that of twice as many steps is the product of two. So the number of
/// products grows with that of such windows and the logarithm of that of the steps.
/// @param steps  at least
/// @returns nothing where there are too few steps for that, or they differ too much
[[nodiscard]] std::optional<Eigen::MatrixXd> half_turn_by_windows(const System &system,
                                                                  double speed, int steps);

} // namespace whirl::periodic

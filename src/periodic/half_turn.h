#pragma once

// What the parts of monodromy.h share.

#include "linalg/lanes/row_products.h"
#include "periodic/monodromy.h"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::periodic {

/// Of the supports as they stand in the rotor, s: half a turn.
[[nodiscard]] inline double period(double speed) { return std::numbers::pi / std::abs(speed); }

/// As monodromy().
/// @param along  where to put the states at the beginning of each step, or none
[[nodiscard]] Eigen::MatrixXd half_turn(const System &system, double speed, int steps,
                                        std::vector<linalg::Rows> *along);

/// (q, q') of a motion without its growth and turn at the beginnings of the steps, a column each.
[[nodiscard]] Eigen::MatrixXcd along_half_turn(const System &system, double speed, int steps,
                                               const FloquetMotion &motion);

/// As floquet_motions(), of that matrix.
[[nodiscard]] std::vector<FloquetMotion> motions_of(const System &system, double speed,
                                                    const Eigen::MatrixXd &monodromy);

/// Entries of (q, q') become of one size by them.
[[nodiscard]] Eigen::VectorXd weights_of(const System::Steady &steady, double speed);

} // namespace whirl::periodic

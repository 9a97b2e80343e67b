#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace whirl::assembly {

/// The motions for which every row times the unknowns is zero, a column each; a matrix of the rotor
/// held there is T^T A T. One unknown of each row, that with the largest coefficient, follows from
/// the others, so the columns stay sparse.
/// @param rows   places x unknowns; those that depend on others are dropped
/// @param scale  of each unknown: coefficients times theirs are comparable
[[nodiscard]] Eigen::SparseMatrix<double> constrained_motions(Eigen::MatrixXd rows,
                                                              const Eigen::VectorXd &scale);

} // namespace whirl::assembly

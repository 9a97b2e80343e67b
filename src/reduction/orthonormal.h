#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace whirl::reduction {

/// Takes into the shapes what is new of some columns (Gram-Schmidt, twice for the rounding).
/// @param shapes   orthonormal under H
/// @param H        symmetric, positive definite on the columns
/// @param newness  part of a column that the shapes must lack, of its length under H; a column
///                 that has less adds nothing
void take_in(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
             const Eigen::MatrixXd &columns, double newness);

/// The same, always next the longest of what is left of the columns, down to a length under H.
void take_in_longest_first(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
                           Eigen::MatrixXd columns, double shortest);

/// The same, always next the column of which most is new: few shapes for many columns alike.
void take_in_newest_first(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
                          Eigen::MatrixXd columns, double newness);

} // namespace whirl::reduction

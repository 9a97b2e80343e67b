#pragma once

#include "linalg/matrix.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace whirl::linalg {

/// Powers of two s such that unknowns q = s q' of different kinds (deflections in m, slopes in rad)
/// are of one size: diagonal entries of s K s as large as the first of K, within a factor of 4;
/// of s M s where K has none. In other units of length, mass and time (a power of
/// two apart) the scaled matrices have the same digits, so that pivots, norms and shares do not
/// depend on units.
[[nodiscard]] Eigen::VectorXd unit_scales(const Matrix &K, const Matrix &M);

/// Scales of the unknowns that make the diagonal |K| + shift^2 |M| of a quadratic problem 1.
/// Deflections and slopes have different units, and a short element is far stiffer than a long one:
/// without it the pivots of the factorisation are chosen by units, and several digits are lost.
/// @param M,K  diagonals
[[nodiscard]] Eigen::VectorXd scales_at(double shift, const Eigen::VectorXd &M,
                                        const Eigen::VectorXd &K);

/// S A S, S the diagonal matrix of these scales.
[[nodiscard]] Eigen::SparseMatrix<double> scaled(const Eigen::SparseMatrix<double> &A,
                                                 const Eigen::VectorXd &scales);

} // namespace whirl::linalg

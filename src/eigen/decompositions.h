#pragma once

// Eigen with the decompositions that many rooms use compiled once, in decompositions.cpp: each
// takes seconds, and without this every room would compile its own. One that is not listed works as
// well. Comes with the precompiled header.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

// `what` is "extern template" or "template".
#define WHIRL_DECOMPOSITIONS(what)                                                                 \
    what class Eigen::PartialPivLU<Eigen::MatrixXd>;                                               \
    what class Eigen::PartialPivLU<Eigen::MatrixXcd>;                                              \
    what class Eigen::FullPivLU<Eigen::MatrixXd>;                                                  \
    what class Eigen::FullPivLU<Eigen::MatrixXcd>;                                                 \
    what class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;                                        \
    what class Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>;                                       \
    what class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXcd>;                           \
    what class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;                                     \
    what class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;                                    \
    what class Eigen::EigenSolver<Eigen::MatrixXd>;                                                \
    what class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;                                        \
    what class Eigen::JacobiSVD<Eigen::MatrixXd>;                                                  \
    what class Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower,                     \
                                    Eigen::NaturalOrdering<int>>;                                  \
    what class Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>

WHIRL_DECOMPOSITIONS(extern template);

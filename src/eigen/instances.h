#pragma once

// Eigen with its decompositions instantiated once: every source of the program sees these extern
// templates (through the precompiled header), src/eigen/*.cpp are the only ones that compile them.
// A decomposition that is not listed works as well; it only compiles for longer.

#include "eigen/kernels.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <complex>

namespace whirl::eigen {
using SparseReal = Eigen::SparseMatrix<double>;
using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;
using LowerCholesky = Eigen::SimplicialLLT<SparseReal, Eigen::Lower, Eigen::NaturalOrdering<int>>;
} // namespace whirl::eigen

// `what` is "extern template" or "template".
#define WHIRL_EIGEN_SOLVES(what, Dense)                                                            \
    what class Eigen::PartialPivLU<Dense>;                                                         \
    what class Eigen::FullPivLU<Dense>;                                                            \
    what class Eigen::LLT<Dense>;                                                                  \
    what class Eigen::ColPivHouseholderQR<Dense>;                                                  \
    what class Eigen::CompleteOrthogonalDecomposition<Dense>;                                      \
    what void Eigen::CompleteOrthogonalDecomposition<Dense>::_solve_impl(const Dense &, Dense &)   \
        const

#define WHIRL_EIGEN_SYMMETRIC(what, Dense)                                                         \
    what class Eigen::Tridiagonalization<Dense>;                                                   \
    what class Eigen::SelfAdjointEigenSolver<Dense>;                                               \
    what Eigen::SelfAdjointEigenSolver<Dense> &Eigen::SelfAdjointEigenSolver<Dense>::compute(      \
        const Eigen::EigenBase<Dense> &, int);                                                     \
    what class Eigen::GeneralizedSelfAdjointEigenSolver<Dense>

#define WHIRL_EIGEN_GENERAL(what)                                                                  \
    what class Eigen::HessenbergDecomposition<Eigen::MatrixXd>;                                    \
    what class Eigen::RealSchur<Eigen::MatrixXd>;                                                  \
    what class Eigen::EigenSolver<Eigen::MatrixXd>;                                                \
    what Eigen::EigenSolver<Eigen::MatrixXd> &Eigen::EigenSolver<Eigen::MatrixXd>::compute(        \
        const Eigen::EigenBase<Eigen::MatrixXd> &, bool);                                          \
    what class Eigen::HessenbergDecomposition<Eigen::MatrixXcd>;                                   \
    what class Eigen::ComplexSchur<Eigen::MatrixXcd>;                                              \
    what class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;                                        \
    what Eigen::ComplexEigenSolver<Eigen::MatrixXcd>                                               \
        &Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(                                     \
            const Eigen::EigenBase<Eigen::MatrixXcd> &, bool)

#define WHIRL_EIGEN_SINGULAR(what) what class Eigen::JacobiSVD<Eigen::MatrixXd>

// Not the whole class: it has members that complex numbers cannot have.
#define WHIRL_EIGEN_SPARSE_LU(what, Sparse)                                                        \
    what void Eigen::SparseLU<Sparse>::analyzePattern(const Sparse &);                             \
    what void Eigen::SparseLU<Sparse>::factorize(const Sparse &);                                  \
    WHIRL_EIGEN_SPARSE_SOLVE(what, Sparse::Scalar, Eigen::Dynamic);                                \
    WHIRL_EIGEN_SPARSE_SOLVE(what, Sparse::Scalar, 1)

// The solves with a factor, and with its transposed one.
#define WHIRL_EIGEN_SPARSE_SOLVE(what, Scalar, columns)                                            \
    what void Eigen::internal::MappedSuperNodalMatrix<Scalar, int>::solveInPlace(                  \
        Eigen::MatrixBase<Eigen::Matrix<Scalar, Eigen::Dynamic, columns>> &) const;                \
    what void Eigen::internal::MappedSuperNodalMatrix<Scalar, int>::solveTransposedInPlace<false>( \
        Eigen::MatrixBase<Eigen::Matrix<Scalar, Eigen::Dynamic, columns>> &) const;                \
    what void Eigen::internal::MappedSuperNodalMatrix<Scalar, int>::solveTransposedInPlace<true>(  \
        Eigen::MatrixBase<Eigen::Matrix<Scalar, Eigen::Dynamic, columns>> &) const

#define WHIRL_EIGEN_SPARSE_CHOLESKY(what)                                                          \
    what class Eigen::SimplicialCholeskyBase<Eigen::SimplicialLDLT<whirl::eigen::SparseReal>>;     \
    what class Eigen::SimplicialLDLT<whirl::eigen::SparseReal>;                                    \
    what class Eigen::SimplicialCholeskyBase<whirl::eigen::LowerCholesky>;                         \
    what class Eigen::SimplicialLLT<whirl::eigen::SparseReal, Eigen::Lower,                        \
                                    Eigen::NaturalOrdering<int>>

#ifndef WHIRL_EIGEN_INSTANCES
WHIRL_EIGEN_KERNELS(extern template);
WHIRL_EIGEN_SOLVES(extern template, Eigen::MatrixXd);
WHIRL_EIGEN_SOLVES(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_SYMMETRIC(extern template, Eigen::MatrixXd);
WHIRL_EIGEN_SYMMETRIC(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_GENERAL(extern template);
WHIRL_EIGEN_SINGULAR(extern template);
WHIRL_EIGEN_SPARSE_LU(extern template, whirl::eigen::SparseReal);
WHIRL_EIGEN_SPARSE_LU(extern template, whirl::eigen::SparseComplex);
WHIRL_EIGEN_SPARSE_CHOLESKY(extern template);
#endif

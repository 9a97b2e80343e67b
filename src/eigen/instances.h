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

#include <complex>

namespace whirl::eigen {
using SparseReal = Eigen::SparseMatrix<double>;
using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using LowerCholesky = Eigen::SimplicialLLT<SparseReal, Eigen::Lower, Eigen::NaturalOrdering<int>>;
} // namespace whirl::eigen

// `what` is "extern template" or "template". Of each class the members that do the work and that
// the program calls: whole classes compile twice as long.
#define WHIRL_EIGEN_SOLVES(what, Dense)                                                            \
    what void Eigen::PartialPivLU<Dense>::compute();                                               \
    what const Eigen::Inverse<Eigen::PartialPivLU<Dense>> Eigen::PartialPivLU<Dense>::inverse()    \
        const;                                                                                     \
    what void Eigen::FullPivLU<Dense>::computeInPlace();                                           \
    what void Eigen::ColPivHouseholderQR<Dense>::computeInPlace()

#define WHIRL_EIGEN_LEAST_SQUARES(what, Dense)                                                     \
    what void Eigen::CompleteOrthogonalDecomposition<Dense>::computeInPlace();                     \
    what void Eigen::CompleteOrthogonalDecomposition<Dense>::_solve_impl(const Dense &, Dense &)   \
        const

#define WHIRL_EIGEN_SYMMETRIC(what, Dense)                                                         \
    what Eigen::SelfAdjointEigenSolver<Dense> &Eigen::SelfAdjointEigenSolver<Dense>::compute(      \
        const Eigen::EigenBase<Dense> &, int)

#define WHIRL_EIGEN_SYMMETRIC_PAIR(what, Dense)                                                    \
    what Eigen::GeneralizedSelfAdjointEigenSolver<Dense> &                                         \
    Eigen::GeneralizedSelfAdjointEigenSolver<Dense>::compute(const Dense &, const Dense &, int)

#define WHIRL_EIGEN_GENERAL(what)                                                                  \
    what Eigen::EigenSolver<Eigen::MatrixXd> &Eigen::EigenSolver<Eigen::MatrixXd>::compute(        \
        const Eigen::EigenBase<Eigen::MatrixXd> &, bool);                                          \
    what Eigen::ComplexEigenSolver<Eigen::MatrixXcd>                                               \
        &Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(                                     \
            const Eigen::EigenBase<Eigen::MatrixXcd> &, bool)

#define WHIRL_EIGEN_SINGULAR(what)                                                                 \
    what Eigen::JacobiSVD<Eigen::MatrixXd> &Eigen::JacobiSVD<Eigen::MatrixXd>::compute(            \
        const Eigen::MatrixXd &, unsigned int)

#define WHIRL_EIGEN_SPARSE_CHOLESKY(what)                                                          \
    what class Eigen::SimplicialCholeskyBase<Eigen::SimplicialLDLT<whirl::eigen::SparseReal>>;     \
    what class Eigen::SimplicialLDLT<whirl::eigen::SparseReal>;                                    \
    what class Eigen::SimplicialCholeskyBase<whirl::eigen::LowerCholesky>;                         \
    what class Eigen::SimplicialLLT<whirl::eigen::SparseReal, Eigen::Lower,                        \
                                    Eigen::NaturalOrdering<int>>

// Copies of sparse matrices, and between their orders.
#define WHIRL_EIGEN_SPARSE_COPY(what, To, ...)                                                     \
    what void Eigen::internal::assign_sparse_to_sparse<To, __VA_ARGS__>(To &, const __VA_ARGS__ &)

#define WHIRL_EIGEN_SPARSE_TURN(what, To, ...)                                                     \
    what To &To::operator=<__VA_ARGS__>(const Eigen::SparseMatrixBase<__VA_ARGS__> &)

#define WHIRL_EIGEN_SPARSE_COPIES(what)                                                            \
    WHIRL_EIGEN_SPARSE_COPY(what, whirl::eigen::SparseReal, whirl::eigen::SparseReal);             \
    WHIRL_EIGEN_SPARSE_COPY(what, whirl::eigen::SparseComplex, whirl::eigen::SparseComplex);       \
    WHIRL_EIGEN_SPARSE_COPY(                                                                       \
        what, whirl::eigen::SparseComplex,                                                         \
        Eigen::CwiseUnaryOp<Eigen::internal::scalar_cast_op<double, std::complex<double>>,         \
                            const whirl::eigen::SparseReal>);                                      \
    WHIRL_EIGEN_SPARSE_COPY(                                                                       \
        what, whirl::eigen::SparseReal,                                                            \
        Eigen::CwiseBinaryOp<Eigen::internal::scalar_sum_op<double, double>,                       \
                             const whirl::eigen::SparseReal, const whirl::eigen::SparseReal>);     \
    WHIRL_EIGEN_SPARSE_TURN(what, whirl::eigen::SparseReal,                                        \
                            Eigen::Map<const whirl::eigen::SparseRows, 0, Eigen::Stride<0, 0>>);   \
    WHIRL_EIGEN_SPARSE_TURN(what, whirl::eigen::SparseReal,                                        \
                            Eigen::Transpose<const whirl::eigen::SparseReal>);                     \
    WHIRL_EIGEN_SPARSE_TURN(what, whirl::eigen::SparseReal, whirl::eigen::SparseRows)

#ifndef WHIRL_EIGEN_INSTANCES
WHIRL_EIGEN_KERNELS(extern template);
WHIRL_EIGEN_SOLVES(extern template, Eigen::MatrixXd);
WHIRL_EIGEN_SOLVES(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_LEAST_SQUARES(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_SYMMETRIC(extern template, Eigen::MatrixXd);
WHIRL_EIGEN_SYMMETRIC(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_SYMMETRIC_PAIR(extern template, Eigen::MatrixXcd);
WHIRL_EIGEN_GENERAL(extern template);
WHIRL_EIGEN_SINGULAR(extern template);
WHIRL_EIGEN_SPARSE_CHOLESKY(extern template);
WHIRL_EIGEN_SPARSE_COPIES(extern template);
#endif

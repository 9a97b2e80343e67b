#pragma once

// The inner loops of Eigen's products and triangular solves, instantiated once like its
// decompositions (instances.h): the combinations of scalars, orders and conjugates that several
// folders of the program use. One that is not listed works as well.

#include <Eigen/Core>

#include <complex>

namespace whirl::eigen {
using Real = double;
using Complex = std::complex<double>;
template <class Scalar, int order>
using Map = Eigen::internal::const_blas_data_mapper<Scalar, Eigen::Index, order>;
template <class Left, class Right> using Traits = Eigen::internal::gebp_traits<Left, Right>;
template <class Scalar> using Result = Eigen::internal::blas_data_mapper<Scalar, Eigen::Index, 0>;
} // namespace whirl::eigen

// A matrix stored by `order` times a vector; "conjugate" is true where the factor is conjugated.
#define WHIRL_EIGEN_VECTOR(what, Left, order, conjugate, Right, right_order, right_conjugate,      \
                           version)                                                                \
    what struct Eigen::internal::general_matrix_vector_product<                                    \
        Eigen::Index, whirl::eigen::Left, whirl::eigen::Map<whirl::eigen::Left, Eigen::order>,     \
        Eigen::order, conjugate, whirl::eigen::Right,                                              \
        whirl::eigen::Map<whirl::eigen::Right, Eigen::right_order>, right_conjugate, version>

#define WHIRL_EIGEN_PANEL(what, Left, Right, Scalar, left_conjugate, right_conjugate)              \
    what struct Eigen::internal::gebp_kernel<                                                      \
        whirl::eigen::Left, whirl::eigen::Right, Eigen::Index,                                     \
        whirl::eigen::Result<whirl::eigen::Scalar>,                                                \
        whirl::eigen::Traits<whirl::eigen::Left, whirl::eigen::Right>::mr,                         \
        whirl::eigen::Traits<whirl::eigen::Left, whirl::eigen::Right>::nr, left_conjugate,         \
        right_conjugate>

#define WHIRL_EIGEN_PRODUCT(what, Scalar, order, right_order)                                      \
    what struct Eigen::internal::general_matrix_matrix_product<                                    \
        Eigen::Index, whirl::eigen::Scalar, Eigen::order, false, whirl::eigen::Scalar,             \
        Eigen::right_order, false, Eigen::ColMajor, 1>

#define WHIRL_EIGEN_SOLVE(what, Scalar, mode)                                                      \
    what struct Eigen::internal::triangular_solve_matrix<whirl::eigen::Scalar, Eigen::Index,       \
                                                         Eigen::OnTheLeft, mode, false,            \
                                                         Eigen::ColMajor, Eigen::ColMajor, 1>

// Panels of a matrix stored by `order`, laid out for the kernel.
#define WHIRL_EIGEN_PACKED_LEFT(what, Scalar, order)                                               \
    what struct Eigen::internal::gemm_pack_lhs<                                                    \
        whirl::eigen::Scalar, Eigen::Index, whirl::eigen::Map<whirl::eigen::Scalar, Eigen::order>, \
        whirl::eigen::Traits<whirl::eigen::Scalar, whirl::eigen::Scalar>::mr,                      \
        whirl::eigen::Traits<whirl::eigen::Scalar, whirl::eigen::Scalar>::LhsProgress,             \
        whirl::eigen::Traits<whirl::eigen::Scalar, whirl::eigen::Scalar>::LhsPacket4Packing,       \
        Eigen::order>

#define WHIRL_EIGEN_PACKED_RIGHT(what, Scalar, order)                                              \
    what struct Eigen::internal::gemm_pack_rhs<                                                    \
        whirl::eigen::Scalar, Eigen::Index, whirl::eigen::Map<whirl::eigen::Scalar, Eigen::order>, \
        whirl::eigen::Traits<whirl::eigen::Scalar, whirl::eigen::Scalar>::nr, Eigen::order>

// Sizes of the blocks of a product, of which `depth` parts of a panel are worked on at once.
#define WHIRL_EIGEN_BLOCKS(what, Scalar, depth)                                                    \
    what void Eigen::internal::evaluateProductBlockingSizesHeuristic<                              \
        whirl::eigen::Scalar, whirl::eigen::Scalar, depth, Eigen::Index>(                          \
        Eigen::Index &, Eigen::Index &, Eigen::Index &, Eigen::Index)

#define WHIRL_EIGEN_KERNELS(what)                                                                  \
    WHIRL_EIGEN_VECTOR(what, Real, RowMajor, false, Real, ColMajor, false, 0);                     \
    WHIRL_EIGEN_VECTOR(what, Real, ColMajor, false, Real, RowMajor, false, 0);                     \
    WHIRL_EIGEN_VECTOR(what, Real, ColMajor, false, Real, ColMajor, false, 0);                     \
    WHIRL_EIGEN_VECTOR(what, Real, RowMajor, false, Real, RowMajor, false, 1);                     \
    WHIRL_EIGEN_VECTOR(what, Complex, RowMajor, true, Complex, ColMajor, false, 0);                \
    WHIRL_EIGEN_VECTOR(what, Complex, RowMajor, false, Complex, ColMajor, false, 0);               \
    WHIRL_EIGEN_VECTOR(what, Complex, RowMajor, false, Complex, ColMajor, true, 0);                \
    WHIRL_EIGEN_VECTOR(what, Complex, RowMajor, false, Complex, RowMajor, true, 1);                \
    WHIRL_EIGEN_VECTOR(what, Complex, ColMajor, false, Complex, ColMajor, false, 0);               \
    WHIRL_EIGEN_VECTOR(what, Complex, ColMajor, false, Complex, RowMajor, false, 0);               \
    WHIRL_EIGEN_VECTOR(what, Real, RowMajor, false, Complex, ColMajor, false, 0);                  \
    WHIRL_EIGEN_VECTOR(what, Real, ColMajor, false, Complex, RowMajor, false, 0);                  \
    WHIRL_EIGEN_VECTOR(what, Complex, RowMajor, false, Real, ColMajor, false, 0);                  \
    WHIRL_EIGEN_PANEL(what, Real, Real, Real, false, false);                                       \
    WHIRL_EIGEN_PANEL(what, Real, Complex, Complex, false, false);                                 \
    WHIRL_EIGEN_PANEL(what, Complex, Complex, Complex, false, false);                              \
    WHIRL_EIGEN_PANEL(what, Complex, Complex, Complex, true, false);                               \
    WHIRL_EIGEN_PANEL(what, Complex, Complex, Complex, false, true);                               \
    WHIRL_EIGEN_PRODUCT(what, Real, ColMajor, ColMajor);                                           \
    WHIRL_EIGEN_PRODUCT(what, Real, RowMajor, ColMajor);                                           \
    WHIRL_EIGEN_PRODUCT(what, Real, ColMajor, RowMajor);                                           \
    WHIRL_EIGEN_PRODUCT(what, Complex, ColMajor, ColMajor);                                        \
    WHIRL_EIGEN_PRODUCT(what, Complex, RowMajor, ColMajor);                                        \
    WHIRL_EIGEN_SOLVE(what, Real, Eigen::Upper);                                                   \
    WHIRL_EIGEN_SOLVE(what, Real, Eigen::UnitLower);                                               \
    WHIRL_EIGEN_SOLVE(what, Complex, Eigen::Upper);                                                \
    WHIRL_EIGEN_SOLVE(what, Complex, Eigen::UnitLower);                                            \
    WHIRL_EIGEN_PACKED_LEFT(what, Real, ColMajor);                                                 \
    WHIRL_EIGEN_PACKED_LEFT(what, Real, RowMajor);                                                 \
    WHIRL_EIGEN_PACKED_LEFT(what, Complex, ColMajor);                                              \
    WHIRL_EIGEN_PACKED_LEFT(what, Complex, RowMajor);                                              \
    WHIRL_EIGEN_PACKED_RIGHT(what, Real, ColMajor);                                                \
    WHIRL_EIGEN_PACKED_RIGHT(what, Real, RowMajor);                                                \
    WHIRL_EIGEN_PACKED_RIGHT(what, Complex, ColMajor);                                             \
    WHIRL_EIGEN_BLOCKS(what, Real, 1);                                                             \
    WHIRL_EIGEN_BLOCKS(what, Real, 4);                                                             \
    WHIRL_EIGEN_BLOCKS(what, Complex, 1);                                                          \
    WHIRL_EIGEN_BLOCKS(what, Complex, 4)

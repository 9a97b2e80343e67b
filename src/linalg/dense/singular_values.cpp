#include "linalg/dense/singular_values.h"

#include <Eigen/SVD>

#include <algorithm>
#include <limits>

namespace whirl::linalg {

// Eigen's and not LAPACK's zgesvd: for a few rows, the matrix-vector product of Debian's OpenBLAS
// that it calls reads beyond the matrix on processors with AVX-512.
SingularValues singular_values(const Eigen::MatrixXcd &A) {
    const Eigen::Index least = std::min(A.rows(), A.cols());
    if (least == 0 || !A.allFinite()) {
        constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
        return {Eigen::MatrixXcd::Constant(A.rows(), least, no_number),
                Eigen::VectorXd::Constant(least, no_number),
                Eigen::MatrixXcd::Constant(A.cols(), least, no_number)};
    }
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

} // namespace whirl::linalg

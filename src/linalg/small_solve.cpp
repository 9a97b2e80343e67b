#include "linalg/small_solve.h"

#include <Eigen/LU>

namespace whirl::linalg {

Eigen::VectorXcd solve_small(const Eigen::MatrixXcd &A, const Eigen::VectorXcd &b) {
    return A.partialPivLu().solve(b);
}

} // namespace whirl::linalg

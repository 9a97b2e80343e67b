#include "reduction/orthonormal.h"

#include <algorithm>
#include <cmath>

namespace whirl::reduction {

void take_in(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
             const Eigen::MatrixXd &columns, double newness) {
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
        Eigen::VectorXd v = columns.col(j);
        const double before = std::sqrt(v.dot(H * v));
        if (!(before > 0))
            continue;
        double after = before;
        for (int twice = 0; twice < 2 && after > 0; ++twice) {
            v -= shapes * (shapes.transpose() * (H * v)).eval();
            after = std::sqrt(std::max(0.0, v.dot(H * v)));
        }
        if (!(after > newness * before))
            continue; // already spanned by the others
        shapes.conservativeResize(Eigen::NoChange, shapes.cols() + 1);
        shapes.rightCols<1>() = v / after;
    }
}

} // namespace whirl::reduction

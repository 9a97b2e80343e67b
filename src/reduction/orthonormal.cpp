#include "reduction/orthonormal.h"

#include "linalg/dense/products.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

namespace {

Eigen::RowVectorXd lengths(const Eigen::MatrixXd &columns, const Eigen::SparseMatrix<double> &H) {
    return columns.cwiseProduct(H * columns).colwise().sum().cwiseMax(0).cwiseSqrt();
}

} // namespace

void take_in_longest_first(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
                           Eigen::MatrixXd columns, double shortest) {
    const Eigen::MatrixXd forces = H * columns;
    columns -= linalg::times(shapes, linalg::transposed_times(shapes, forces));
    Eigen::RowVectorXd squares = lengths(columns, H).cwiseAbs2();
    for (Eigen::Index left = columns.cols(); left > 0; --left) {
        Eigen::Index longest = 0;
        if (!(squares.maxCoeff(&longest) > shortest * shortest))
            return;
        const Eigen::Index known = shapes.cols();
        take_in(shapes, H, columns.col(longest), 0.5); // of what is left of it nothing is known
        columns.col(longest).setZero();
        squares(longest) = 0;
        if (shapes.cols() == known)
            continue;
        const Eigen::VectorXd v = shapes.rightCols<1>();
        const Eigen::VectorXd force = H * v;
        const Eigen::RowVectorXd along = force.transpose() * columns;
        columns -= v * along;
        squares -= along.cwiseAbs2();
    }
}

void take_in_newest_first(Eigen::MatrixXd &shapes, const Eigen::SparseMatrix<double> &H,
                          Eigen::MatrixXd columns, double newness) {
    const Eigen::RowVectorXd before = lengths(columns, H);
    for (Eigen::Index j = 0; j < columns.cols(); ++j)
        columns.col(j) /= before(j) > 0 ? before(j) : 1;
    take_in_longest_first(shapes, H, std::move(columns), newness);
}

} // namespace whirl::reduction

#include "reduction/projection.h"

#include "linalg/dense/products.h"

#include <Eigen/SparseCore>

#include <stdexcept>

namespace whirl::reduction {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Every entry of the planar shapes times the identity of (x, y); below the unknowns of what is
/// attached.
Eigen::MatrixXd in_pairs(const Eigen::MatrixXd &shapes, Eigen::Index unknowns) {
    const Eigen::Index n = shapes.rows();
    const Eigen::Index r = shapes.cols();
    const Eigen::Index attached = unknowns - 2 * n;
    if (attached < 0)
        throw std::invalid_argument("a system over pairs of planar unknowns is to be projected");
    Eigen::MatrixXd W = Eigen::MatrixXd::Zero(unknowns, 2 * r + attached);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < r; ++j)
            W(2 * i, 2 * j) = W(2 * i + 1, 2 * j + 1) = shapes(i, j);
    W.bottomRightCorner(attached, attached).setIdentity();
    return W;
}

} // namespace

linalg::Matrix Projection::of(const linalg::Matrix &A) const {
    return linalg::Matrix::from_sparse(of(Sparse(A.view())).sparseView());
}

Eigen::MatrixXd Projection::loads(const Eigen::MatrixXd &columns) const {
    return linalg::transposed_times(in_pairs(_shapes, columns.rows()), columns);
}

Eigen::VectorXcd Projection::lifted(const Eigen::VectorXcd &reduced) const {
    const Eigen::Index attached = reduced.size() - 2 * _shapes.cols();
    return in_pairs(_shapes, 2 * _shapes.rows() + attached) * reduced;
}

Eigen::MatrixXd Projection::of(const Sparse &full) const {
    const Sparse transposed = full.transpose();
    const Eigen::MatrixXd W = in_pairs(_shapes, full.rows());
    const auto product = [&W](const Sparse &half) -> Eigen::MatrixXd {
        const Eigen::MatrixXd forces = half * W;
        return linalg::transposed_times(W, forces);
    };
    const Eigen::MatrixXd symmetric = product((full + transposed) / 2);
    const Eigen::MatrixXd skew = product((full - transposed) / 2);
    return (symmetric + symmetric.transpose()) / 2 + (skew - skew.transpose()) / 2;
}

assembly::FixedSystem Projection::of(const assembly::FixedSystem &s) const {
    return {of(s.M), of(s.C), of(s.G), of(s.K), of(s.Kc)};
}

assembly::RotatingSystem Projection::of(const assembly::RotatingSystem &s) const {
    return {of(s.M), of(s.C), of(s.Cs), of(s.K), of(s.Ks), of(s.Kss)};
}

assembly::PeriodicSupports Projection::of(const assembly::PeriodicSupports &s) const {
    return {{of(s.C.cosine), of(s.C.sine)},
            {of(s.K.cosine), of(s.K.sine)},
            {of(s.Ks.cosine), of(s.Ks.sine)}};
}

} // namespace whirl::reduction

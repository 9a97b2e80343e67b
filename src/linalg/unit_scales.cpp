#include "linalg/unit_scales.h"

#include <cmath>

namespace whirl::linalg {

namespace {

/// Ratio to the first entry; 0 where either is.
Eigen::VectorXd to_first(const Matrix &A) {
    Eigen::VectorXd ratio = Eigen::VectorXd::Zero(A.size());
    const SparseView view = A.view();
    const double first = view.coeff(0, 0);
    for (Eigen::Index i = 0; i < ratio.size() && first != 0; ++i)
        ratio(i) = std::abs(view.coeff(i, i) / first);
    return ratio;
}

} // namespace

Eigen::VectorXd unit_scales(const Matrix &K, const Matrix &M) {
    const Eigen::Index size = K.size();
    const Eigen::VectorXd stiffness = to_first(K);
    const Eigen::VectorXd mass = to_first(M);
    Eigen::VectorXd scales = Eigen::VectorXd::Ones(size);
    for (Eigen::Index i = 0; i < size; ++i) {
        const double ratio = stiffness(i) != 0 ? stiffness(i) : mass(i);
        if (ratio != 0)
            scales(i) = std::ldexp(1.0, -static_cast<int>(std::floor(std::ilogb(ratio) / 2.0)));
    }
    return scales;
}

Eigen::VectorXd scales_at(double shift, const Eigen::VectorXd &M, const Eigen::VectorXd &K) {
    const Eigen::VectorXd diagonal = K.cwiseAbs() + shift * shift * M.cwiseAbs();
    const double mean = diagonal.mean();
    return diagonal.unaryExpr([mean](double d) { return 1 / std::sqrt(d > 0 ? d : mean); });
}

Eigen::SparseMatrix<double> scaled(const Eigen::SparseMatrix<double> &A,
                                   const Eigen::VectorXd &scales) {
    return scales.asDiagonal() * A * scales.asDiagonal();
}

} // namespace whirl::linalg

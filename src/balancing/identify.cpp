#include "balancing/identify.h"

#include "linalg/dense/singular_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::balancing {

namespace {

/// Ones before the weights, these over their largest.
Eigen::MatrixXcd design(const Eigen::MatrixXcd &weights, double size) {
    Eigen::MatrixXcd X(weights.rows(), 1 + weights.cols());
    X.col(0).setOnes();
    X.rightCols(weights.cols()) = weights / size;
    return X;
}

double size_of(const Eigen::MatrixXcd &weights) {
    const double size = weights.size() > 0 ? weights.cwiseAbs().maxCoeff() : 1;
    return size > 0 ? size : 1;
}

/// Trial weights are known to three digits or so: what is smaller is no difference between them.
constexpr double no_difference = 1e-6;

} // namespace

bool tells_apart(const Eigen::MatrixXcd &weights) {
    Eigen::MatrixXcd X = design(weights, size_of(weights));
    for (Eigen::Index p = 1; p < X.cols(); ++p)
        if (const double length = X.col(p).norm(); length > 0)
            X.col(p) /= length;
    const Eigen::VectorXd s = linalg::singular_values(X).s;
    return s.size() == X.cols() && s(s.size() - 1) > no_difference * s(0);
}

Identified Identification::of(const std::vector<Reading> &readings, std::size_t looks) const {
    const auto n = static_cast<Eigen::Index>(readings.size());
    const double size = size_of(_weights);
    const Eigen::MatrixXcd of_runs = design(_weights, size);
    Eigen::MatrixXcd X(n, of_runs.cols());
    Eigen::VectorXcd values(n);
    for (Eigen::Index i = 0; const Reading &reading : readings) {
        X.row(i) = of_runs.row(static_cast<Eigen::Index>(reading.run));
        values(i++) = reading.value;
    }
    const linalg::SingularValues svd = linalg::singular_values(X);
    Identified out;
    out.M = svd.V * svd.s.cwiseInverse().asDiagonal() * svd.U.adjoint();
    const Eigen::MatrixXcd hat = X * out.M;
    out.M.bottomRows(_weights.cols()) /= size;
    out.x = out.M * values;
    const Eigen::VectorXcd apart = values - hat * values;
    out.squares = apart.squaredNorm();
    out.freedom = static_cast<double>(n - X.cols());
    // Readings that were copied, or computed, say nothing of how they scatter.
    constexpr double copied = 1e-20; // of their squares: rounding
    if (out.squares <= copied * values.squaredNorm())
        out.freedom = 0;
    // Each reading against the scatter of the others: what it adds to the sum of squares is
    // |apart|^2 / (1 - its share in its own fit).
    constexpr double rare = 0.01; // in one of a hundred tables by chance
    for (Eigen::Index i = 0; i < n && out.freedom >= 2; ++i) {
        const double own = 1 - hat(i, i).real();
        if (!(own > 1e-9))
            continue; // it is fitted alone
        const double adds = std::norm(apart(i)) / own;
        const double others = std::max(0.0, out.squares - adds);
        const double left = out.freedom - 1;
        // F = adds over others / left, with 2 and 2 left degrees of freedom.
        const double probability = adds > 0 ? std::pow(others / (others + adds), left) : 1.0;
        if (probability < rare / static_cast<double>(looks))
            out.outliers.push_back({static_cast<std::size_t>(i), apart(i) / own, probability});
    }
    return out;
}

Scatter sum_of(const std::vector<Scatter> &parts) {
    Scatter sum;
    double over = 0;
    for (const Scatter &part : parts) {
        sum.square += part.square;
        if (part.square > 0)
            over += part.square * part.square / part.freedom;
    }
    sum.freedom =
        over > 0 ? sum.square * sum.square / over : std::numeric_limits<double>::infinity();
    return sum;
}

double radius_of(const Scatter &scatter, double probability) {
    const double outside = 1 - probability;
    const double times = std::isinf(scatter.freedom)
                             ? -std::log(outside)
                             : scatter.freedom * (std::pow(outside, -1 / scatter.freedom) - 1);
    return std::sqrt(times * scatter.square);
}

} // namespace whirl::balancing

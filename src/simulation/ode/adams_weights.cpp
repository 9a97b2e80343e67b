#include "simulation/ode/adams_weights.h"

#include "elements/quadrature.h"

#include <cmath>

namespace whirl::simulation {

namespace {

/// Of the quadrature of the weights: so many hold fourteen digits up to |h a| = adams_reach, and so
/// many up to 8, which takes a series of the exponential of 26 terms.
constexpr int points = 40;
constexpr int points_of_slow = 20;

} // namespace

AdamsWeights adams_weights(const Eigen::VectorXcd &a, double h, int count, double share) {
    const bool slow = std::abs(h) * a.cwiseAbs().maxCoeff() < 8;
    const elements::Quadrature &rule = elements::gauss_legendre(slow ? points_of_slow : points);
    AdamsWeights out;
    const double from = share < 1 ? -1 : 0;
    const double way = share * h;
    out.h = way;
    out.growth = (way * a.array()).exp();
    out.modal.setZero(a.size(), count);
    out.own.assign(static_cast<std::size_t>(count), 0.0);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
        const double s = rule.points[i];
        const Eigen::ArrayXcd part = ((1 - s) * way * a.array()).exp();
        double term = way * rule.weights[i];
        for (int j = 0; j < count; ++j) {
            out.modal.col(j) += term * part;
            out.own[static_cast<std::size_t>(j)] += term;
            term *= (from + share * s + j) / (j + 1);
        }
    }
    return out;
}

Eigen::MatrixXd rescaled_differences(double ratio, int count) {
    // 1 - (1 - D)^ratio as a series in D.
    Eigen::VectorXd base = Eigen::VectorXd::Zero(count);
    double binomial = 1;
    for (int i = 1; i < count; ++i) {
        binomial *= -(ratio - (i - 1)) / i;
        base(i) = -binomial;
    }
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(count, count);
    T(0, 0) = 1;
    for (int j = 1; j < count; ++j)
        for (int i = 0; i < count; ++i)
            for (int k = 1; i + k < count; ++k)
                T(i + k, j) += T(i, j - 1) * base(k);
    return T;
}

} // namespace whirl::simulation

#include "closed_form/floquet.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

namespace whirl::closed_form {

namespace {

constexpr int stages = 4;

struct Collocation {
    std::array<double, stages> nodes;                   ///< c_i in (0, 1)
    Eigen::Matrix<double, stages, stages> coefficients; ///< a_ij
    Eigen::Matrix<double, 1, stages> weights;           ///< b_j
};

/// a_ij and b_j from sum_j a_ij c_j^k = c_i^(k+1)/(k+1), sum_j b_j c_j^k = 1/(k+1).
Collocation gauss_legendre() {
    // Zeros of the Legendre polynomial of degree four, x^2 = 3/7 -+ (2/7) sqrt(6/5).
    const double inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2));
    const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2));
    Collocation rule{
        {0.5 - 0.5 * outer, 0.5 - 0.5 * inner, 0.5 + 0.5 * inner, 0.5 + 0.5 * outer}, {}, {}};
    Eigen::MatrixXd powers(stages, stages);
    Eigen::Matrix4d integrals;
    Eigen::RowVector4d whole;
    for (int k = 0; k < stages; ++k) {
        whole[k] = 1.0 / (k + 1);
        for (int i = 0; i < stages; ++i) {
            powers(i, k) = std::pow(rule.nodes[i], k);
            integrals(i, k) = std::pow(rule.nodes[i], k + 1) / (k + 1);
        }
    }
    const Eigen::MatrixXd inverse = powers.partialPivLu().inverse();
    rule.coefficients = integrals * inverse;
    rule.weights = whole * inverse;
    return rule;
}

} // namespace

Eigen::MatrixXd monodromy_matrix(const std::function<Eigen::MatrixXd(double)> &state_matrix,
                                 double period, int steps) {
    const Collocation rule = gauss_legendre();
    const double h = period / steps;
    const Eigen::Index n = state_matrix(0.0).rows();
    Eigen::MatrixXd transition = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd system(stages * n, stages * n);
    Eigen::MatrixXd start(stages * n, n);
    for (int step = 0; step < steps; ++step) {
        // Stage slopes F: F_i - h S_i sum_j a_ij F_j = S_i z.
        system.setIdentity();
        for (int i = 0; i < stages; ++i) {
            const Eigen::MatrixXd S = state_matrix((step + rule.nodes[i]) * h);
            start.middleRows(i * n, n) = S * transition;
            for (int j = 0; j < stages; ++j)
                system.block(i * n, j * n, n, n) -= h * rule.coefficients(i, j) * S;
        }
        const Eigen::MatrixXd slopes = system.partialPivLu().solve(start);
        for (int j = 0; j < stages; ++j)
            transition += h * rule.weights[j] * slopes.middleRows(j * n, n);
    }
    return transition;
}

std::vector<std::complex<double>>
floquet_multipliers(const std::function<Eigen::MatrixXd(double)> &state_matrix, double period,
                    int steps) {
    const Eigen::VectorXcd values = monodromy_matrix(state_matrix, period, steps).eigenvalues();
    return {values.begin(), values.end()};
}

} // namespace whirl::closed_form

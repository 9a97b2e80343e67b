#include "elements/quadrature.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <map>

namespace whirl::elements {

namespace {

/// Golub and Welsch (1969): points are the eigenvalues of the Jacobi matrix of the Legendre
/// polynomials; one Newton step then removes the rounding of the eigensolver.
Quadrature compute(int n) {
    Eigen::VectorXd sub(n > 1 ? n - 1 : 0);
    for (int k = 1; k < n; ++k)
        sub(k - 1) = k / std::sqrt(4.0 * k * k - 1);
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::VectorXd::Zero(n), sub, Eigen::EigenvaluesOnly);
    Quadrature rule;
    for (int i = 0; i < n; ++i) {
        double x = solver.eigenvalues()(i);
        double slope = 1;
        for (int step = 0; step < 2; ++step) {
            double p0 = 1;
            double p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        rule.points.push_back((1 + x) / 2);
        rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

} // namespace

const Quadrature &gauss_legendre(int n) {
    static std::map<int, Quadrature> rules;
    const auto found = rules.find(n);
    return found != rules.end() ? found->second : rules.emplace(n, compute(n)).first->second;
}

} // namespace whirl::elements

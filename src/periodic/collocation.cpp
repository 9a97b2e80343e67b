#include "periodic/collocation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace whirl::periodic {

namespace {

using Real = long double; // the transformation costs some four digits
using LongMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using LongComplexMatrix = Eigen::Matrix<std::complex<Real>, Eigen::Dynamic, Eigen::Dynamic>;

/// P_s - P_(stages-1), Legendre polynomials on [-1, 1], and its derivative; its zeros are the
/// points.
std::pair<Real, Real> radau_polynomial(Real x) {
    Real before = 1;
    Real now = x;
    Real slope_before = 0;
    Real slope = 1;
    for (int k = 1; k < stages; ++k) {
        const Real next = ((2 * k + 1) * x * now - k * before) / (k + 1);
        const Real slope_next = slope_before + (2 * k + 1) * now;
        before = now;
        now = next;
        slope_before = slope;
        slope = slope_next;
    }
    return {now - before, slope - slope_before};
}

std::vector<Real> points() {
    std::vector<Real> out;
    for (int k = stages - 1; k > 0; --k) { // all but the one at 1, ascending
        Real x = std::cos(std::numbers::pi_v<Real> * (2 * k) / (2 * stages - 1));
        for (int step = 0; step < 100; ++step) {
            const auto [value, slope] = radau_polynomial(x);
            x -= value / slope;
        }
        out.push_back((x + 1) / 2);
    }
    out.push_back(1);
    return out;
}

/// Integrals from 0 to each point of the polynomials that are 1 at one point and 0 at the others.
LongMatrix butcher_matrix(const std::vector<Real> &c) {
    LongMatrix powers(stages, stages);
    LongMatrix integrals(stages, stages);
    for (int i = 0; i < stages; ++i)
        for (int k = 0; k < stages; ++k) {
            powers(i, k) = std::pow(c[static_cast<std::size_t>(i)], static_cast<Real>(k));
            integrals(i, k) =
                std::pow(c[static_cast<std::size_t>(i)], static_cast<Real>(k + 1)) / (k + 1);
        }
    return integrals * powers.inverse();
}

Collocation made() {
    const std::vector<Real> c = points();
    const LongMatrix inverse = butcher_matrix(c).inverse();
    const Eigen::EigenSolver<LongMatrix> solver(inverse);
    const LongComplexMatrix vectors = solver.eigenvectors();
    const LongComplexMatrix rows = vectors.inverse();
    Collocation out{Eigen::VectorXd(stages), inverse.cast<double>(), Eigen::VectorXcd(stages / 2),
                    Eigen::MatrixXcd(stages, stages / 2), Eigen::MatrixXcd(stages / 2, stages)};
    for (int i = 0; i < stages; ++i)
        out.nodes(i) = static_cast<double>(c[static_cast<std::size_t>(i)]);
    int pair = 0;
    for (int j = 0; j < stages; ++j) {
        if (solver.eigenvalues()(j).imag() <= 0) // of an even number of stages none is real
            continue;
        out.roots(pair) = std::complex<double>(solver.eigenvalues()(j));
        out.T.col(pair) = vectors.col(j).cast<std::complex<double>>();
        out.left.row(pair) = rows.row(j).cast<std::complex<double>>();
        ++pair;
    }
    return out;
}

} // namespace

const Collocation &collocation() {
    static const Collocation once = made();
    return once;
}

} // namespace whirl::periodic

#include "forced/quadratic_resolvent.h"

#include "linalg/check.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace whirl::forced {

namespace {

/// (m - T)^-1 v of an upper triangular T, column by column.
void solve_shifted_triangle(const Eigen::MatrixXcd &T, std::complex<double> m,
                            Eigen::VectorXcd &v) {
    for (Eigen::Index k = T.rows() - 1; k >= 0; --k) {
        v(k) /= m - T(k, k);
        v.head(k) += v(k) * T.col(k).head(k);
    }
}

} // namespace

QuadraticResolvent::QuadraticResolvent(const QuadraticTerms &terms, const Eigen::VectorXcd &b,
                                       double from, double to)
    : _width(std::max(to - from, 0.1 * std::max(std::abs(from), std::abs(to)))),
      _shift((from + to) / 2, 0.3 * _width) {
    const Eigen::PartialPivLU<Eigen::MatrixXcd> at_shift(terms.at(_shift));
    const Eigen::Index m = b.size();
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * m, 2 * m);
    companion.topLeftCorner(m, m) = -_width * at_shift.solve(terms.P1 + 2.0 * _shift * terms.P2);
    companion.topRightCorner(m, m) = -_width * _width * at_shift.solve(terms.P2);
    companion.bottomLeftCorner(m, m).setIdentity();
    const Eigen::ComplexSchur<Eigen::MatrixXcd> schur(companion, true);
    if (schur.info() != Eigen::Success)
        throw linalg::SolverError("the poles of a small quadratic problem were not found");
    _T = schur.matrixT();
    _lower = schur.matrixU().bottomRows(m);
    _h = schur.matrixU().topRows(m).adjoint() * at_shift.solve(b);
}

std::vector<std::complex<double>> QuadraticResolvent::poles() const {
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &root : _T.diagonal())
        if (std::abs(root) > 1e-9) // else farther than any s
            out.push_back(_shift + _width / root);
    return out;
}

QuadraticResolvent::Solution QuadraticResolvent::at(double s) const {
    const std::complex<double> m = _width / (s - _shift);
    Eigen::VectorXcd v = _h;
    solve_shifted_triangle(_T, m, v);
    Eigen::VectorXcd w = v;
    solve_shifted_triangle(_T, m, w);
    // u = m^2 L v; d(m^2 v)/dm = 2 m v - m^2 w, dm/ds = -m^2 / width.
    const std::complex<double> square = m * m;
    return {_lower * (square * v), _lower * ((-square / _width) * (2.0 * m * v - square * w))};
}

} // namespace whirl::forced

#include "linalg/quadratic_problem.h"

#include "linalg/check.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace whirl::linalg {

QuadraticProblem::QuadraticProblem(const Matrix &M, const Matrix &D, const Matrix &K, double shift)
    : _M(M.view()), _D(D.view()), _K(K.view()), _shift(shift) {
    const Sparse Q = shift * shift * _M + shift * _D + _K;
    _lu.compute(Q);
    if (_lu.info() != Eigen::Success)
        throw SolverError("the matrix at the shift is singular");
}

void QuadraticProblem::assess(ComplexPair &pair) const {
    const std::complex<double> l = pair.value;
    Eigen::Index largest = 0;
    pair.vector.cwiseAbs().maxCoeff(&largest);
    pair.vector /= pair.vector(largest);
    const Eigen::VectorXcd &x = pair.vector;
    const Eigen::VectorXcd Mx = _M.cast<std::complex<double>>() * x;
    const Eigen::VectorXcd Dx = _D.cast<std::complex<double>>() * x;
    const Eigen::VectorXcd Kx = _K.cast<std::complex<double>>() * x;
    const Eigen::VectorXcd r = l * l * Mx + l * Dx + Kx;
    const Eigen::VectorXcd slope = l * (2.0 * l * Mx + Dx);
    const auto preconditioned = [this](const Eigen::VectorXcd &v) {
        const Eigen::VectorXd re = _lu.solve(Eigen::VectorXd(v.real()));
        const Eigen::VectorXd im = _lu.solve(Eigen::VectorXd(v.imag()));
        return std::hypot(re.norm(), im.norm());
    };
    const double scale = preconditioned(slope);
    pair.residual = scale > 0 ? preconditioned(r) / scale : 0;
    const Eigen::VectorXd a = x.cwiseAbs();
    const double size = std::abs(l);
    const double entries = a.dot(_K.cwiseAbs() * a) + size * a.dot(_D.cwiseAbs() * a) +
                           size * size * a.dot(_M.cwiseAbs() * a);
    const double derivative = std::abs(x.dot(slope));
    pair.rounding =
        derivative > 0 ? std::numeric_limits<double>::epsilon() * entries / derivative : 0;
}

std::vector<ComplexPair> QuadraticProblem::dense() const {
    const Eigen::Index n = _M.rows();
    // mu^2 Q(shift) + mu Q'(shift) + M = 0, mu = 1/(l - shift).
    const Eigen::MatrixXd A = _lu.solve(Eigen::MatrixXd(2 * _shift * _M + _D));
    const Eigen::MatrixXd B = _lu.solve(Eigen::MatrixXd(_M));
    const double s = std::sqrt(std::max(B.norm(), A.squaredNorm()));
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    companion.topLeftCorner(n, n) = -A / s;
    companion.topRightCorner(n, n) = -B / (s * s);
    companion.bottomLeftCorner(n, n).setIdentity();
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion);
    if (solver.info() != Eigen::Success)
        throw SolverError("the dense eigensolver did not converge");
    const Eigen::VectorXcd mu = solver.eigenvalues();
    const Eigen::MatrixXcd vectors = solver.eigenvectors();
    const double smallest = 1e-14 * mu.cwiseAbs().maxCoeff(); // below: infinite eigenvalues
    std::vector<ComplexPair> pairs;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        if (std::abs(mu(i)) <= smallest)
            continue;
        const std::complex<double> l = _shift + 1.0 / (s * mu(i));
        if (l.imag() < 0)
            continue;
        pairs.push_back({l, vectors.col(i).head(n), 0, 0});
        assess(pairs.back());
    }
    return pairs;
}

} // namespace whirl::linalg

#include "linalg/quadratic_problem.h"

#include "linalg/check.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace whirl::linalg {

QuadraticProblem::QuadraticProblem(const Sparse &M, const Sparse &D, const Sparse &K, double shift)
    : _M(M), _D(D), _K(K), _absM(_M.cwiseAbs()), _absD(_D.cwiseAbs()), _absK(_K.cwiseAbs()),
      _shift(shift) {
    const Sparse Q = shift * shift * _M + shift * _D + _K;
    _lu.compute(Q);
    if (_lu.info() != Eigen::Success)
        throw SolverError("the matrix at the shift is singular");
}

double QuadraticProblem::preconditioned_norm(const Eigen::MatrixX2d &v) const {
    return Eigen::MatrixX2d(_lu.solve(v)).norm();
}

void QuadraticProblem::assess(ComplexPair &pair) const {
    constexpr double blurred = 1e-5; // of the shift; a double zero blurs to the root of rounding
    const bool beside_zero = std::abs(pair.value) < blurred * std::abs(_shift);
    const double of_left = beside_zero ? polish_beside_zero(pair) : 0;
    const std::complex<double> l = pair.value;
    Eigen::Index largest = 0;
    pair.vector.cwiseAbs2().maxCoeff(&largest);
    pair.vector /= pair.vector(largest);
    // Complex vectors as two real columns: real matrices times them without complex products.
    Eigen::MatrixX2d x(pair.vector.size(), 2);
    x << pair.vector.real(), pair.vector.imag();
    const Eigen::MatrixX2d Mx = _M * x;
    const Eigen::MatrixX2d Dx = _D * x;
    const Eigen::MatrixX2d Kx = _K * x;
    const auto times = [](std::complex<double> c, const Eigen::MatrixX2d &v) {
        Eigen::MatrixX2d out(v.rows(), 2);
        out << c.real() * v.col(0) - c.imag() * v.col(1), c.imag() * v.col(0) + c.real() * v.col(1);
        return out;
    };
    const Eigen::MatrixX2d r = times(l * l, Mx) + times(l, Dx) + Kx;
    const Eigen::MatrixX2d slope = times(2.0 * l * l, Mx) + times(l, Dx); // l Q'(l) x
    const double scale = preconditioned_norm(slope);
    pair.residual = scale > 0 ? preconditioned_norm(r) / scale : 0;
    const Eigen::VectorXd a = x.rowwise().norm();
    const double size = std::abs(l);
    const double entries =
        a.dot(_absK * a) + size * a.dot(_absD * a) + size * size * a.dot(_absM * a);
    const std::complex<double> derivative(x.col(0).dot(slope.col(0)) + x.col(1).dot(slope.col(1)),
                                          x.col(0).dot(slope.col(1)) - x.col(1).dot(slope.col(0)));
    const double size_of_derivative = std::abs(derivative);
    const double of_right = size_of_derivative > 0 ? std::numeric_limits<double>::epsilon() *
                                                         entries / size_of_derivative
                                                   : 0;
    pair.rounding = std::max(of_right, of_left);
}

double QuadraticProblem::polish_beside_zero(ComplexPair &pair) const {
    using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;
    constexpr double unknown = 1;
    const auto at = [this](std::complex<double> l) {
        return SparseComplex(l * l * _M + l * _D + _K.cast<std::complex<double>>());
    };
    const std::complex<double> l = pair.value;
    Eigen::SparseLU<SparseComplex> lu(at(l));
    if (lu.info() != Eigen::Success)
        return unknown;
    Eigen::VectorXcd right = pair.vector;
    Eigen::VectorXcd left = right.conjugate();
    for (int k = 0; k < 3; ++k) { // inverse iteration
        right = lu.solve(right).eval().normalized();
        left = lu.transpose().solve(left).eval().normalized();
    }
    if (!right.allFinite() || !left.allFinite())
        return unknown;
    const Eigen::VectorXcd slope = 2.0 * l * (_M * right) + _D * right;
    const std::complex<double> y_slope = (left.transpose() * slope).value();
    const Eigen::VectorXd a = left.cwiseAbs();
    const Eigen::VectorXd b = right.cwiseAbs();
    const double size = std::abs(l);
    const double entries =
        a.dot(_absK * b) + size * a.dot(_absD * b) + size * size * a.dot(_absM * b);
    const double noise = std::numeric_limits<double>::epsilon() * entries;
    const std::complex<double> step = (left.transpose() * (at(l) * right)).value() / y_slope;
    if (!(std::abs(y_slope) * size > noise) || !(std::abs(step) < 0.5 * size))
        return unknown;
    pair = {l - step, right, 0, 0};
    if (l.imag() == 0) // so are the equations
        pair.value.imag(0);
    return noise / (std::abs(y_slope) * size);
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
    // Eigen's QR keeps small eigenvalues beside large ones (creeping motions between strong
    // dampers) where LAPACK's dgeev, faster from a hundred unknowns on, loses them.
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion);
    if (solver.info() != Eigen::Success)
        throw SolverError("the dense eigensolver did not converge");
    const Eigen::VectorXcd &mu = solver.eigenvalues();
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

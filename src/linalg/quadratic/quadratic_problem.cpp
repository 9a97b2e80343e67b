#include "linalg/quadratic/quadratic_problem.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/unit_scales.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::linalg {

QuadraticProblem::QuadraticProblem(const Sparse &M, const Sparse &D, const Sparse &K, double shift)
    : _M(M), _D(D), _K(K), _absM(_M.cwiseAbs()), _absD(_D.cwiseAbs()), _absK(_K.cwiseAbs()),
      _shift(shift) {
    const Sparse Q = shift * shift * _M + shift * _D + _K;
    if (!_lu.factorize(Q))
        throw SolverError("the matrix at the shift is singular");
}

namespace {

/// Of the shift: below, a double zero blurs to the root of rounding.
constexpr double blurred = 1e-5;

using Columns = Eigen::MatrixX2d; ///< real and imaginary part of a complex vector

/// What rounding of matrix entries, which add up to `entries`, changes in l, over l: with x as its
/// own left vector. 0 where l Q'(l) x is orthogonal to x.
double rounding_over(const Columns &x, const Columns &slope, double entries) {
    const std::complex<double> derivative(x.col(0).dot(slope.col(0)) + x.col(1).dot(slope.col(1)),
                                          x.col(0).dot(slope.col(1)) - x.col(1).dot(slope.col(0)));
    const double size = std::abs(derivative);
    return size > 0 ? std::numeric_limits<double>::epsilon() * entries / size : 0;
}

Columns columns_of(const Eigen::VectorXcd &x) {
    Columns out(x.size(), 2);
    out.col(0) = x.real();
    out.col(1) = x.imag();
    return out;
}

Eigen::VectorXcd vector_of(const Columns &x) {
    Eigen::VectorXcd out(x.rows());
    out.real() = x.col(0);
    out.imag() = x.col(1);
    return out;
}

/// Adds c v to a complex vector.
void add(std::complex<double> c, const Eigen::Ref<const Columns> &v, Eigen::Ref<Columns> out) {
    out.col(0) += c.real() * v.col(0) - c.imag() * v.col(1);
    out.col(1) += c.imag() * v.col(0) + c.real() * v.col(1);
}

} // namespace

void QuadraticProblem::assess(std::vector<ComplexPair> &pairs) const {
    const Eigen::Index n = _M.rows();
    const auto count = static_cast<Eigen::Index>(pairs.size());
    // Complex vectors as two real columns: real matrices times them without complex products. All
    // pairs at once: the factors are read once.
    Eigen::MatrixXd x(n, 2 * count);
    Eigen::MatrixXd a(n, count);
    std::vector<double> of_left;
    for (Eigen::Index i = 0; i < count; ++i) {
        ComplexPair &pair = pairs[static_cast<std::size_t>(i)];
        const bool beside_zero = std::abs(pair.value) < blurred * std::abs(_shift);
        of_left.push_back(beside_zero ? polish_near_zero(pair) : 0);
        Eigen::Index largest = 0;
        pair.vector.cwiseAbs2().maxCoeff(&largest);
        pair.vector /= pair.vector(largest);
        x.col(2 * i) = pair.vector.real();
        x.col(2 * i + 1) = pair.vector.imag();
        a.col(i) = x.middleCols<2>(2 * i).rowwise().norm();
    }
    const Eigen::MatrixXd Mx = _M * x;
    const Eigen::MatrixXd Dx = _D * x;
    Eigen::MatrixXd r = _K * x;          // Q(l) x
    Eigen::MatrixXd slope(n, 2 * count); // l Q'(l) x
    slope.setZero();
    for (Eigen::Index i = 0; i < count; ++i) {
        const std::complex<double> l = pairs[static_cast<std::size_t>(i)].value;
        add(l * l, Mx.middleCols<2>(2 * i), r.middleCols<2>(2 * i));
        add(l, Dx.middleCols<2>(2 * i), r.middleCols<2>(2 * i));
        add(2.0 * l * l, Mx.middleCols<2>(2 * i), slope.middleCols<2>(2 * i));
        add(l, Dx.middleCols<2>(2 * i), slope.middleCols<2>(2 * i));
    }
    _lu.solve(r);
    _lu.solve(slope);
    const Eigen::MatrixXd m = _absM * a;
    const Eigen::MatrixXd d = _absD * a;
    const Eigen::MatrixXd k = _absK * a;
    for (Eigen::Index i = 0; i < count; ++i) {
        ComplexPair &pair = pairs[static_cast<std::size_t>(i)];
        const double scale = slope.middleCols<2>(2 * i).norm();
        pair.residual = scale > 0 ? r.middleCols<2>(2 * i).norm() / scale : 0;
        const double size = std::abs(pair.value);
        const double entries = a.col(i).dot(k.col(i) + size * d.col(i) + size * size * m.col(i));
        const double of_right =
            rounding_over(x.middleCols<2>(2 * i), slope.middleCols<2>(2 * i), entries);
        pair.rounding = std::max(of_right, of_left[static_cast<std::size_t>(i)]);
    }
}

namespace {

/// Distance from the eigenvalue: of those that are nearer together, which rounding distinguishes by
/// chance alone, one inverse iteration takes all parts alike, and hardly any of others.
constexpr double offset = 1e-8;

} // namespace

Eigen::VectorXcd QuadraticProblem::left_vector(std::complex<double> l, Eigen::VectorXcd start) {
    if (!_near.factorize(_on_pattern->at(l * (1 + offset))))
        return {};
    _near.solve_transposed(start);
    const Columns y = columns_of(start.normalized());
    Columns next = _D.transpose() * y;
    add(2.0 * l, _M * y, next);
    Eigen::VectorXcd out = vector_of(next);
    _near.solve_transposed(out);
    out.normalize();
    return out.allFinite() ? out : Eigen::VectorXcd();
}

void QuadraticProblem::measure_condition(ComplexPair &pair) {
    // An entry is a sum of some four terms, rounded by half an epsilon each and in its product.
    constexpr double unit = std::numeric_limits<double>::epsilon();
    const std::complex<double> l = pair.value;
    const Columns x = columns_of(pair.vector);
    const Columns Mx = _M * x;
    Columns slope = _D * x;    // Q'(l) x = 2 l M x + D x
    Columns residual = _K * x; // Q(l) x
    add(l, slope, residual);
    add(l * l, Mx, residual);
    add(2.0 * l, Mx, slope);
    Eigen::VectorXcd left = left_vector(l, vector_of(slope).conjugate());
    if (left.size() == 0)
        return; // nothing is known beyond what the right vector says
    const double size = std::abs(l);
    const double derivative = size * std::abs((left.transpose() * vector_of(slope)).value());
    if (!(derivative > 0))
        return;
    pair.rounding =
        std::max(pair.rounding, unit * _on_pattern->size(left, size, pair.vector) / derivative);
    const double off = std::abs((left.transpose() * vector_of(residual)).value());
    pair.residual = std::max(pair.residual, off / derivative);
    pair.left = std::move(left);
}

void QuadraticProblem::assess_condition(std::vector<ComplexPair> &pairs) {
    if (!_on_pattern)
        _on_pattern.emplace(_M, _D, _K);
    for (ComplexPair &pair : pairs) // of those beside zero assess() has used both vectors
        if (std::abs(pair.value) >= blurred * std::abs(_shift))
            measure_condition(pair);
}

double QuadraticProblem::polish_near_zero(ComplexPair &pair) const {
    using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;
    constexpr double unknown = 1; // relative error: not one digit is known
    const auto at = [this](std::complex<double> l) {
        return SparseComplex(l * l * _M + l * _D + _K.cast<std::complex<double>>());
    };
    const std::complex<double> l = pair.value;
    SparseFactor<std::complex<double>> lu;
    if (!lu.factorize(at(l)))
        return unknown;
    Eigen::VectorXcd right = pair.vector;
    Eigen::VectorXcd left = right.conjugate();
    for (int k = 0; k < 3; ++k) { // inverse iteration
        lu.solve(right);
        right.normalize();
        lu.solve_transposed(left);
        left.normalize();
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

namespace {

/// mu^2 + mu A + B = 0, mu = 1/(l - shift): all l with Im l >= 0.
std::vector<ComplexPair> inverted_pairs(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                                        double shift, bool otherwise) {
    const Eigen::Index n = A.rows();
    const double s = std::sqrt(std::max(B.norm(), A.squaredNorm()));
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    companion.topLeftCorner(n, n) = -A / s;
    companion.topRightCorner(n, n) = -B / (s * s);
    companion.bottomLeftCorner(n, n).setIdentity();
    const GeneralEigen found = otherwise ? general_eigen_otherwise(companion)
                                         : general_eigen(std::move(companion), Vectors::right);
    const double smallest = 1e-14 * found.values.cwiseAbs().maxCoeff(); // below: infinite roots
    std::vector<ComplexPair> pairs;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const std::complex<double> mu = found.values(i);
        if (std::abs(mu) <= smallest || mu.imag() < 0)
            continue;
        std::complex<double> l = shift + 1.0 / (s * mu);
        Eigen::VectorXcd vector = found.right.col(i).head(n);
        if (found.is_pair(i)) { // the one with Im l > 0
            l = std::conj(l);
            vector.imag() = -found.right.col(i + 1).head(n);
        }
        pairs.push_back({l, std::move(vector), 0, 0});
    }
    return pairs;
}

} // namespace

const std::vector<ComplexPair> &QuadraticProblem::dense(bool otherwise) {
    std::optional<std::vector<ComplexPair>> &all = _all[otherwise ? 1 : 0];
    if (all)
        return *all;
    // mu^2 Q(shift) + mu Q'(shift) + M = 0, mu = 1/(l - shift).
    Eigen::MatrixXd A = 2 * _shift * _M + _D;
    Eigen::MatrixXd B = _M;
    _lu.solve(A);
    _lu.solve(B);
    std::vector<ComplexPair> pairs = inverted_pairs(A, B, _shift, otherwise);
    assess(pairs);
    return all.emplace(std::move(pairs));
}

std::vector<ComplexPair> all_pairs(const Eigen::MatrixXd &M, const Eigen::MatrixXd &D,
                                   const Eigen::MatrixXd &K, double shift) {
    const Eigen::VectorXd d = scales_at(shift, M.diagonal(), K.diagonal());
    const auto scaled = [&d](const Eigen::MatrixXd &A) -> Eigen::MatrixXd {
        return d.asDiagonal() * A * d.asDiagonal();
    };
    const Eigen::MatrixXd mass = scaled(M);
    const Eigen::MatrixXd slope = 2 * shift * mass + scaled(D);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(scaled(shift * (shift * M + D) + K));
    const Eigen::MatrixXd A = lu.solve(slope);
    const Eigen::MatrixXd B = lu.solve(mass);
    if (!A.allFinite() || !B.allFinite())
        throw SolverError("the matrix at the shift is singular");
    std::vector<ComplexPair> pairs = inverted_pairs(A, B, shift, false);
    for (ComplexPair &pair : pairs)
        pair.vector = d.asDiagonal() * pair.vector;
    return pairs;
}

} // namespace whirl::linalg

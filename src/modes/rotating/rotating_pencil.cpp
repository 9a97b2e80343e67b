#include "modes/rotating/rotating_pencil.h"

#include "linalg/sparse_sum.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

/// Of an accepted pair: by how much its vector makes the eigenvalue uncertain, to the first order;
/// with both vectors the eigenvalue is known to the square of it. Next to zero it is known to a
/// part of the shift; rounding may leave more, and steps no longer make it less.
constexpr double settled = 1e-11;
constexpr double acceptable = 1e-6;

/// Small eigenvalues are blurred beside large ones: parts of the speed or of the motions on the
/// supports.
constexpr double blurred = 1e-6;

void normalize(Eigen::VectorXcd &x) { x /= std::sqrt(x.cwiseAbs2().maxCoeff()); }

} // namespace

bool RotatingPencil::set_speed(double speed) {
    const QuadraticAt problem = _matrices.at(speed);
    _speed = speed;
    _shift = 0.31 * std::max(std::abs(speed), _slow);
    _scales = linalg::scales_at(_shift, problem.M.diagonal(), _stiffness);
    _M = linalg::scaled(problem.M, _scales);
    _D = linalg::scaled(problem.D, _scales);
    _K = linalg::scaled(problem.K, _scales);
    _values.emplace(_M, _D, _K);
    return _shifted.factorize(linalg::sum(_shift * _shift, _M, _shift, _D, 1, _K));
}

RotatingPencil::Products RotatingPencil::times(Complex l, const Eigen::VectorXcd &x) const {
    const Eigen::VectorXcd heavy = l * (_M * x);
    const Eigen::VectorXcd damped = _D * x;
    return {2.0 * heavy + damped, l * (heavy + damped) + _K * x};
}

bool RotatingPencil::factorize(Complex l) {
    if (l.imag() != 0)
        return _complex.factorize(_values->at(l));
    const double real = l.real();
    return _real.factorize(linalg::sum(real * real, _M, real, _D, 1, _K));
}

void RotatingPencil::solve(bool real, bool transposed, Eigen::VectorXcd &b) const {
    if (!real) {
        transposed ? _complex.solve_transposed(b) : _complex.solve(b);
        return;
    }
    Eigen::VectorXd of_real = b.real();
    transposed ? _real.solve_transposed(of_real) : _real.solve(of_real);
    b = of_real.cast<Complex>();
}

/// A step of inverse iteration of both vectors; of a left one that is none yet two.
bool RotatingPencil::iterate(Complex l, bool first, linalg::ComplexPair &pair) {
    if (!factorize(l) && !factorize(l * (1 + 1e-14)))
        return false;
    const bool real = l.imag() == 0;
    const Eigen::VectorXcd slope = times(l, pair.vector).slope;
    if (first)
        pair.left = slope.conjugate();
    pair.vector = slope;
    solve(real, false, pair.vector);
    normalize(pair.vector);
    if (first) {
        solve(real, true, pair.left);
        normalize(pair.left);
    }
    pair.left = 2.0 * l * (_M.transpose() * pair.left) + _D.transpose() * pair.left;
    solve(real, true, pair.left);
    normalize(pair.left);
    return pair.vector.allFinite() && pair.left.allFinite();
}

double RotatingPencil::shifted_norm(const Eigen::VectorXcd &b) const {
    Eigen::MatrixXd columns(b.size(), 2);
    columns << b.real(), b.imag();
    _shifted.solve(columns);
    return columns.norm();
}

std::optional<linalg::ComplexPair> RotatingPencil::refined(const linalg::ComplexPair &guess,
                                                           double farthest) {
    if (std::optional<linalg::ComplexPair> found = iterated(guess, farthest))
        return found;
    _complex.forget_pivots(); // those of another matrix may not have been good for this one
    _real.forget_pivots();
    return iterated(guess, farthest);
}

std::optional<linalg::ComplexPair> RotatingPencil::iterated(const linalg::ComplexPair &guess,
                                                            double farthest) {
    // Cubic: guesses 1e-3 off (`farthest`) need two or three, those that need more lead
    // elsewhere.
    constexpr int most_steps = 6;
    const bool real = guess.value.imag() == 0;
    linalg::ComplexPair pair = guess;
    pair.vector = _scales.cwiseInverse().cwiseProduct(guess.vector);
    double last = HUGE_VAL;
    for (int step = 0; step < most_steps; ++step) {
        if (!iterate(pair.value, step == 0, pair))
            return std::nullopt;
        const Products before = times(pair.value, pair.vector);
        const Complex derivative = pair.left.cwiseProduct(before.slope).sum();
        Complex change = -pair.left.cwiseProduct(before.residual).sum() / derivative;
        if (real)
            change = change.real();
        pair.value += change;
        const double size = std::abs(pair.value);
        const double reach = std::max(farthest * size, blurred * std::max(std::abs(_speed), _slow));
        if (!std::isfinite(size) || !(std::abs(pair.value - guess.value) <= reach))
            return std::nullopt;
        const Products now = times(pair.value, pair.vector);
        const Complex slope = pair.left.cwiseProduct(now.slope).sum();
        pair.residual = shifted_norm(now.residual) / (size * shifted_norm(now.slope));
        // What a further step with the same vectors would change: much, where the pair is not
        // simple or, real, has no root before it.
        const double next =
            std::abs(pair.left.cwiseProduct(now.residual).sum()) / (size * std::abs(slope));
        pair.rounding = std::numeric_limits<double>::epsilon() *
                        _values->size(pair.left, size, pair.vector) / (size * std::abs(slope));
        const double before_it = std::exchange(last, pair.residual);
        const double enough = settled * std::max(1.0, _shift / size);
        const bool there = pair.residual <= enough ||
                           (pair.residual <= acceptable && pair.residual >= 0.1 * before_it);
        if (!there || !(next <= std::max(enough, 10 * pair.rounding)))
            continue;
        if (!real && pair.value.imag() <= 1e-8 * size)
            return std::nullopt; // come to be real
        pair.residual = std::max(pair.residual, next);
        pair.vector = _scales.cwiseProduct(pair.vector);
        Eigen::Index largest = 0;
        pair.vector.cwiseAbs2().maxCoeff(&largest);
        pair.vector /= pair.vector(largest);
        pair.left = _scales.cwiseProduct(pair.left);
        return pair;
    }
    return std::nullopt;
}

} // namespace whirl::modes

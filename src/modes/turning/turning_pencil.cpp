#include "modes/turning/turning_pencil.h"

#include "linalg/unit_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

/// Of a pair that is handed on: by how much its vector makes the eigenvalue uncertain, to the
/// first order; with both vectors the eigenvalue is known to the square of it. Next to zero it is
/// known to a part of the shift; rounding may leave more, and steps no longer make it less.
constexpr double settled = 1e-11;
constexpr double acceptable = 1e-6;

/// Small eigenvalues are blurred beside large ones: parts of the speed or of the motions on the
/// supports.
constexpr double blurred = 1e-6;

void normalize(Eigen::VectorXcd &x) { x /= std::sqrt(x.cwiseAbs2().maxCoeff()); }

} // namespace

TurningPencil::TurningPencil(const assembly::RotatingSystem &system, double slow) : _slow(slow) {
    const std::array<Sparse, parts> matrices{system.M.view(), system.C.view(),  system.Cs.view(),
                                             system.K.view(), system.Ks.view(), system.Kss.view()};
    _pattern = matrices[mass].cwiseAbs();
    for (int part = 1; part < parts; ++part)
        _pattern = Sparse(_pattern + matrices[static_cast<std::size_t>(part)].cwiseAbs());
    _pattern.makeCompressed();
    for (int part = 0; part < parts; ++part) {
        const Sparse &A = matrices[static_cast<std::size_t>(part)];
        const Sparse on_pattern = Sparse(0 * _pattern + A); // entries that are zero stay
        _values[static_cast<std::size_t>(part)] =
            Eigen::Map<const Eigen::VectorXd>(on_pattern.valuePtr(), on_pattern.nonZeros());
    }
    _mass_diagonal = matrices[mass].diagonal();
    _stiffness_diagonal = matrices[stiffness].diagonal();
    _real_Q = _pattern;
    _complex_Q = _pattern.cast<Complex>();
}

bool TurningPencil::set_speed(double speed) {
    _speed = speed;
    _shift = 0.31 * std::max(std::abs(speed), _slow);
    const double shift = _shift;
    _scales = linalg::scales_at(shift, _mass_diagonal, _stiffness_diagonal);
    _M = _values[mass];
    _D = _values[damping] + speed * _values[damping_turned];
    _K = _values[stiffness] + speed * _values[stiffness_turned] +
         speed * speed * _values[stiffness_twice];
    for (Eigen::Index column = 0; column < _pattern.outerSize(); ++column)
        for (int at = _pattern.outerIndexPtr()[column]; at < _pattern.outerIndexPtr()[column + 1];
             ++at) {
            const double scale = _scales(column) * _scales(_pattern.innerIndexPtr()[at]);
            _M(at) *= scale;
            _D(at) *= scale;
            _K(at) *= scale;
        }
    Eigen::Map<Eigen::VectorXd>(_real_Q.valuePtr(), _real_Q.nonZeros()) =
        shift * shift * _M + shift * _D + _K;
    return _shifted.factorize(_real_Q);
}

TurningPencil::Products TurningPencil::times(Complex l, const Eigen::VectorXcd &x) const {
    Products out{Eigen::VectorXcd::Zero(x.size()), Eigen::VectorXcd::Zero(x.size())};
    Eigen::VectorXcd stiff = Eigen::VectorXcd::Zero(x.size());
    for (Eigen::Index column = 0; column < _pattern.outerSize(); ++column) {
        const Complex value = x(column);
        for (int at = _pattern.outerIndexPtr()[column]; at < _pattern.outerIndexPtr()[column + 1];
             ++at) {
            const int row = _pattern.innerIndexPtr()[at];
            out.slope(row) += _M(at) * value;
            out.residual(row) += _D(at) * value;
            stiff(row) += _K(at) * value;
        }
    }
    const Eigen::VectorXcd heavy = l * out.slope;
    out.slope = 2.0 * heavy + out.residual;
    out.residual = l * (heavy + out.residual) + stiff;
    return out;
}

Eigen::VectorXcd TurningPencil::slope_transposed(Complex l, const Eigen::VectorXcd &y) const {
    Eigen::VectorXcd out(y.size());
    for (Eigen::Index column = 0; column < _pattern.outerSize(); ++column) {
        Complex of_mass = 0;
        Complex of_damping = 0;
        for (int at = _pattern.outerIndexPtr()[column]; at < _pattern.outerIndexPtr()[column + 1];
             ++at) {
            of_mass += _M(at) * y(_pattern.innerIndexPtr()[at]);
            of_damping += _D(at) * y(_pattern.innerIndexPtr()[at]);
        }
        out(column) = 2.0 * l * of_mass + of_damping;
    }
    return out;
}

bool TurningPencil::factorize(Complex l) {
    if (l.imag() == 0) {
        const double real = l.real();
        Eigen::Map<Eigen::VectorXd>(_real_Q.valuePtr(), _real_Q.nonZeros()) =
            real * (real * _M + _D) + _K;
        return _real.factorize(_real_Q);
    }
    const double re = (l * l).real();
    const double im = (l * l).imag();
    Complex *values = _complex_Q.valuePtr();
    for (Eigen::Index at = 0; at < _M.size(); ++at)
        values[at] = {re * _M(at) + l.real() * _D(at) + _K(at), im * _M(at) + l.imag() * _D(at)};
    return _complex.factorize(_complex_Q);
}

void TurningPencil::solve(bool real, bool transposed, Eigen::VectorXcd &b) const {
    if (!real) {
        transposed ? _complex.solve_transposed(b) : _complex.solve(b);
        return;
    }
    Eigen::VectorXd of_real = b.real();
    transposed ? _real.solve_transposed(of_real) : _real.solve(of_real);
    b = of_real.cast<Complex>();
}

/// A step of inverse iteration of both vectors; of a left one that is none yet two.
bool TurningPencil::iterate(Complex l, bool first, linalg::ComplexPair &pair) {
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
    pair.left = slope_transposed(l, pair.left);
    solve(real, true, pair.left);
    normalize(pair.left);
    return pair.vector.allFinite() && pair.left.allFinite();
}

double TurningPencil::shifted_norm(const Eigen::VectorXcd &b) const {
    Eigen::MatrixXd columns(b.size(), 2);
    columns << b.real(), b.imag();
    _shifted.solve(columns);
    return columns.norm();
}

/// |y|^T (|K| + |l| |D| + |l|^2 |M|) |x|.
double TurningPencil::entries(double l, const Eigen::VectorXcd &y,
                              const Eigen::VectorXcd &x) const {
    const Eigen::VectorXd a = y.cwiseAbs();
    double sum = 0;
    for (Eigen::Index column = 0; column < _pattern.outerSize(); ++column) {
        double of_column = 0;
        for (int at = _pattern.outerIndexPtr()[column]; at < _pattern.outerIndexPtr()[column + 1];
             ++at)
            of_column += a(_pattern.innerIndexPtr()[at]) *
                         (std::abs(_K(at)) + l * (std::abs(_D(at)) + l * std::abs(_M(at))));
        sum += of_column * std::abs(x(column));
    }
    return sum;
}

std::optional<linalg::ComplexPair> TurningPencil::refined(const linalg::ComplexPair &guess,
                                                          double farthest) {
    if (std::optional<linalg::ComplexPair> found = iterated(guess, farthest))
        return found;
    _complex.forget_pivots(); // those of another matrix may not have been good for this one
    _real.forget_pivots();
    return iterated(guess, farthest);
}

std::optional<linalg::ComplexPair> TurningPencil::iterated(const linalg::ComplexPair &guess,
                                                           double farthest) {
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
                        entries(size, pair.left, pair.vector) / (size * std::abs(slope));
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

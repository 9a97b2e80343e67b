#include "modes/following/eigenpair_refinement.h"

#include "linalg/check.h"
#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

/// a^T b without the tests for infinities of the standard's product.
std::complex<double> plain_product(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
    return a.cwiseProduct(b).sum();
}

} // namespace

std::complex<double> nearest_root(std::complex<double> xMx, std::complex<double> xDx,
                                  std::complex<double> xKx, std::complex<double> near) {
    const std::complex<double> root = std::sqrt(xDx * xDx - 4.0 * xMx * xKx);
    // Both without cancellation.
    const std::complex<double> q =
        -(xDx + (std::real(std::conj(xDx) * root) >= 0 ? root : -root)) / 2.0;
    const std::complex<double> first = q / xMx;
    const std::complex<double> second = xKx / q;
    return std::norm(first - near) <= std::norm(second - near) ? first : second;
}

void EigenpairRefinement::multiply(const Eigen::VectorXcd &x) {
    _problem.multiply(x, _speed, _of);
    _xMx = plain_product(x, _of.M);
    _xDx = plain_product(x, _of.D);
    _xKx = plain_product(x, _of.K);
}

double EigenpairRefinement::error(Complex l, double distance) {
    const double derivative = std::abs(l * (2.0 * l * _xMx + _xDx));
    if (!(derivative > 0) || !std::isfinite(derivative))
        return std::numeric_limits<double>::infinity();
    _residual = (l * l) * _of.M + l * _of.D + _of.K;
    return _problem.energy(_residual, std::abs(l)) / (derivative * std::min(1.0, distance));
}

linalg::SymmetricFactor &EigenpairRefinement::factorize(Complex l) {
    try {
        return _problem.factorize(l, _speed);
    } catch (const linalg::SolverError &) { // on the eigenvalue itself
        return _problem.factorize(l * (1 + 1e-14), _speed);
    }
}

void EigenpairRefinement::inverse_step(SymmetricPair &pair) {
    const Eigen::VectorXcd slope = (2.0 * pair.value) * _of.M + _of.D;
    pair.vector = factorize(pair.value).solve(slope);
    pair.vector /= std::sqrt(pair.vector.cwiseAbs2().maxCoeff());
    multiply(pair.vector);
    pair.value = nearest_root(_xMx, _xDx, _xKx, pair.value);
    pair.solved = true;
}

void EigenpairRefinement::fill(SymmetricPair &pair) const {
    const Complex l = pair.value;
    pair.derivative = 2.0 * l * _xMx + _xDx;
    pair.rate = -(l * plain_product(pair.vector, _of.D1) + plain_product(pair.vector, _of.K1)) /
                pair.derivative;
    pair.rounding = std::numeric_limits<double>::epsilon() *
                    _problem.absolute_form(std::abs(l), _speed, pair.vector) /
                    std::abs(l * pair.derivative);
    pair.Mx = _of.M;
    pair.Kx = _of.K;
}

void EigenpairRefinement::assess(SymmetricPair &pair, double distance) {
    multiply(pair.vector);
    pair.value = nearest_root(_xMx, _xDx, _xKx, pair.value);
    pair.solved = false;
    pair.error = error(pair.value, distance);
}

bool EigenpairRefinement::refine(SymmetricPair &pair, double distance, double enough) {
    constexpr int most_steps = 8;
    const double settled = std::max(enough, 1e-13);
    assess(pair, distance);
    for (int step = 0; step < most_steps && !(pair.error <= enough); ++step) {
        const double last = pair.error;
        inverse_step(pair);
        pair.error = error(pair.value, distance);
        if (pair.error <= settled && pair.error > 0.1 * last)
            break; // rounding
    }
    if (!(pair.error <= settled))
        return false;
    fill(pair);
    return true;
}

SymmetricPair EigenpairRefinement::nearest(Complex value) {
    SymmetricPair pair;
    pair.value = value;
    const linalg::SymmetricFactor &factor = factorize(value * (1 + 1e-6));
    pair.vector = Eigen::VectorXcd::Ones(_problem.size());
    for (int step = 0; step < 3; ++step) {
        multiply(pair.vector);
        pair.vector = factor.solve((2.0 * value) * _of.M + _of.D);
        pair.vector /= std::sqrt(pair.vector.cwiseAbs2().maxCoeff());
    }
    (void)refine(pair, 1, enough_error); // whether it has settled is seen by who asked
    return pair;
}

double EigenpairRefinement::phase(Complex z, const std::vector<SymmetricPair> &without) {
    double phase = factorize(z).determinant_phase();
    for (const SymmetricPair &pair : without) {
        phase -= std::arg(z - pair.value);
        if (_problem.conjugates() && pair.value.imag() != 0)
            phase -= std::arg(z - std::conj(pair.value));
    }
    return phase;
}

double distance_from_others(const std::vector<SymmetricPair> &pairs, std::size_t i) {
    double first = 1;
    double second = 1;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
        if (j == i)
            continue;
        const double away = std::norm(pairs[j].value - pairs[i].value);
        if (away < first * std::norm(pairs[i].value)) {
            second = first;
            first = away / std::norm(pairs[i].value);
        } else {
            second = std::min(second, away / std::norm(pairs[i].value));
        }
    }
    return std::sqrt(first * second);
}

std::vector<double> enough_errors(const std::vector<SymmetricPair> &pairs, int slowest) {
    std::vector<double> out(pairs.size(), enough_error);
    if (slowest >= std::ssize(pairs))
        return out;
    std::vector<double> frequencies;
    for (const SymmetricPair &pair : pairs)
        if (std::abs(pair.value.imag()) > real_axis * std::abs(pair.value))
            frequencies.push_back(std::abs(pair.value.imag()));
    if (slowest >= std::ssize(frequencies))
        return out;
    // Values of guesses: the next one may be among the slowest.
    std::sort(frequencies.begin(), frequencies.end());
    const double last = 1.001 * frequencies[static_cast<std::size_t>(slowest - 1)];
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (std::abs(pairs[i].value.imag()) > last)
            out[i] = counted_error;
    return out;
}

} // namespace whirl::modes

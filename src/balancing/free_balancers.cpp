#include "balancing/free_balancers.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace whirl::balancing {

namespace {

using Eigen::Index;
using Complex = std::complex<double>;

/// To which the conditions hold, over the terms they are sums of; Newton's steps end far below.
constexpr double settled = 1e-9;

/// What the balancer of one plane supplies where b is the motion without it: nothing is left, or it
/// supplies all it has, c e, at the angle of the rest: b + a c e = l e with l > 0, so that
/// |b| = |l - a c|.
Complex alone(Complex a, Complex b, double c) {
    if (std::abs(b) <= std::abs(a) * c)
        return -b / a;
    const double across = a.imag() * c;
    const double rest = a.real() * c + std::sqrt(std::norm(b) - across * across);
    return c * b / (rest - a * c);
}

/// Each plane after the other as if the others stood still.
void sweep(const FreeBalancers &of, Eigen::VectorXcd &u) {
    for (Index j = 0; j < u.size(); ++j) {
        const Complex others = of.w(j) + (of.A.row(j) * u).value() - of.A(j, j) * u(j);
        u(j) = alone(of.A(j, j), others, of.capacity(j));
    }
}

/// With m_j = |rest|/c_j of the planes that supply all they have: (A - m) u = -w, |u_j| = c_j.
void refine(const FreeBalancers &of, Eigen::VectorXcd &u) {
    std::vector<Index> full;
    Eigen::VectorXd m = Eigen::VectorXd::Zero(u.size());
    const Eigen::VectorXcd rest = of.w + of.A * u;
    for (Index j = 0; j < u.size(); ++j)
        if (std::abs(u(j)) >= of.capacity(j) * (1 - settled)) {
            full.push_back(j);
            m(j) = std::abs(rest(j)) / of.capacity(j);
        }
    const auto n = static_cast<Index>(full.size());
    constexpr int most_steps = 20; // from a good start it takes four
    Eigen::VectorXcd next = u;
    for (int step = 0; step < most_steps; ++step) {
        const Eigen::MatrixXcd inverse =
            (of.A - Eigen::MatrixXcd(m.cast<Complex>().asDiagonal())).fullPivLu().inverse();
        next = -inverse * of.w;
        if (!next.allFinite())
            return;
        u = next;
        if (n == 0)
            return;
        Eigen::MatrixXd slope(n, n);
        Eigen::VectorXd miss(n);
        for (Index i = 0; i < n; ++i) {
            const Index at = full[static_cast<std::size_t>(i)];
            miss(i) = std::norm(u(at)) - of.capacity(at) * of.capacity(at);
            for (Index k = 0; k < n; ++k) {
                const Index other = full[static_cast<std::size_t>(k)];
                slope(i, k) = 2 * (std::conj(u(at)) * inverse(at, other) * u(other)).real();
            }
        }
        const Eigen::VectorXd change = slope.fullPivLu().solve(-miss);
        if (!change.allFinite())
            return;
        for (Index i = 0; i < n; ++i)
            m(full[static_cast<std::size_t>(i)]) += change(i);
    }
}

bool solves_all(const FreeBalancers &of, const Eigen::VectorXcd &u) {
    if (!u.allFinite())
        return false;
    const Eigen::VectorXcd rest = of.w + of.A * u;
    for (Index j = 0; j < u.size(); ++j) {
        const double terms = std::abs(of.w(j)) + (of.A.row(j).cwiseAbs() * u.cwiseAbs()).value();
        const double c = of.capacity(j);
        if (std::abs(u(j)) > c * (1 + settled))
            return false;
        const bool full = std::abs(u(j)) > c * (1 - settled);
        const Complex along = full ? rest(j) * std::conj(u(j)) / std::abs(u(j)) : rest(j);
        const double wrong =
            full ? std::max(std::abs(along.imag()), -along.real()) : std::abs(along);
        if (wrong > settled * terms)
            return false;
    }
    return true;
}

} // namespace

bool works_everywhere(const Eigen::MatrixXcd &A) {
    // Rounding of an eigenvalue that is zero, over the largest: several planes of a rigid rotor.
    constexpr double zero_work = 1e-10;
    const Eigen::MatrixXcd mean = (A + A.adjoint()) / 2;
    const Eigen::VectorXd work =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(mean).eigenvalues();
    return work.size() > 0 && work(0) < 0 &&
           work(work.size() - 1) <= zero_work * work.cwiseAbs().maxCoeff();
}

std::optional<Eigen::VectorXcd> best_supply(const FreeBalancers &of) {
    Eigen::VectorXcd u = Eigen::VectorXcd::Zero(of.w.size());
    if (of.w.size() == 0 || of.w.isZero(0))
        return u;
    if (!of.A.allFinite() || !works_everywhere(of.A))
        return std::nullopt;
    // Few sweeps tell which planes are full; more where planes can nearly do each other's work.
    constexpr int rounds = 200;
    constexpr int sweeps = 50;
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < sweeps; ++i)
            sweep(of, u);
        if (solves_all(of, u) && round > 0)
            return u;
        Eigen::VectorXcd refined = u;
        refine(of, refined);
        if (solves_all(of, refined))
            return refined;
    }
    return solves_all(of, u) ? std::optional(u) : std::nullopt;
}

} // namespace whirl::balancing

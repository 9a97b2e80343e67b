#include "oracles/balls.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace whirl::oracles {

namespace {

using Angles = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Jacobian = Eigen::Matrix<Real, 2, Eigen::Dynamic>;

/// Balls with their weights m R in the constraint and m R^2 in D, both of sum 1.
struct Weighted {
    Angles pull, inertia;

    [[nodiscard]] Jacobian slopes(const Angles &angles) const {
        Jacobian J(2, angles.size());
        for (Eigen::Index i = 0; i < angles.size(); ++i) {
            J(0, i) = -pull[i] * std::sin(angles[i]);
            J(1, i) = pull[i] * std::cos(angles[i]);
        }
        return J;
    }

    /// Back to sum pull exp(i alpha) = target by Newton's steps of least length; false where they
    /// diverge.
    [[nodiscard]] bool balance(Angles &angles, Real target) const {
        for (int step = 0; step < 60; ++step) {
            Eigen::Matrix<Real, 2, 1> miss(-target, 0);
            for (Eigen::Index i = 0; i < angles.size(); ++i)
                miss +=
                    pull[i] * Eigen::Matrix<Real, 2, 1>(std::cos(angles[i]), std::sin(angles[i]));
            if (miss.norm() < 1e-16L)
                return true;
            const Jacobian J = slopes(angles);
            const Eigen::Matrix<Real, 2, 2> normal = J.lazyProduct(J.transpose());
            if (std::abs(normal.determinant()) < 1e-24L)
                return false;
            const Eigen::Matrix<Real, 2, 1> pulls = normal.inverse() * miss;
            angles -= J.transpose().lazyProduct(pulls);
        }
        return false;
    }

    [[nodiscard]] Complex D(const Angles &angles) const {
        Complex sum = 0;
        for (Eigen::Index i = 0; i < angles.size(); ++i)
            sum += inertia[i] * std::polar(Real(1), 2 * angles[i]);
        return sum;
    }

    /// Gradient of |D|^2 along the balanced positions.
    [[nodiscard]] Angles slope(const Angles &angles) const {
        const Complex sum = D(angles);
        Angles out(angles.size());
        for (Eigen::Index i = 0; i < angles.size(); ++i)
            out[i] = 4 * inertia[i] *
                     (std::conj(sum) * Complex(0, 1) * std::polar(Real(1), 2 * angles[i])).real();
        const Jacobian J = slopes(angles);
        const Eigen::Matrix<Real, 2, 2> normal = J.lazyProduct(J.transpose());
        const Eigen::Matrix<Real, 2, 1> along = J.lazyProduct(out);
        const Eigen::Matrix<Real, 2, 1> pulls = normal.inverse() * along;
        return out - J.transpose().lazyProduct(pulls);
    }

    /// |D| from there on: descends (sense -1) or climbs (sense 1) with steps that double or halve.
    [[nodiscard]] Real extreme(Angles angles, Real target, Real sense) const {
        Real value = std::norm(D(angles));
        Real size = 0.1L;
        for (int step = 0; step < 400 && size > 1e-12L; ++step) {
            Angles next = angles + sense * size * slope(angles);
            if (balance(next, target) && sense * (std::norm(D(next)) - value) > 0) {
                value = std::norm(D(next));
                angles = next;
                size *= 2;
            } else {
                size /= 4;
            }
        }
        return std::sqrt(value);
    }
};

Weighted weighted(const std::vector<Row> &rows) {
    std::vector<Real> pull, inertia;
    for (const Row &row : rows)
        for (int i = 0; i < row.n; ++i) {
            pull.push_back(static_cast<Real>(row.mass) * row.radius);
            inertia.push_back(pull.back() * row.radius);
        }
    const auto n = static_cast<Eigen::Index>(pull.size());
    Weighted out{Eigen::Map<const Angles>(pull.data(), n),
                 Eigen::Map<const Angles>(inertia.data(), n)};
    out.pull /= out.pull.sum();
    out.inertia /= out.inertia.sum();
    return out;
}

/// Of all balls together, kg m.
Real pull_of(const std::vector<Row> &rows) {
    Real sum = 0;
    for (const Row &row : rows)
        sum += row.n * static_cast<Real>(row.mass) * row.radius;
    return sum;
}

} // namespace

Real capacity(const Balancer &b) { return pull_of(b.rows) / static_cast<Real>(b.imbalance); }

std::vector<Real> symmetric_position(int n, Real capacity) {
    if (n == 1 && std::abs(capacity - 1) < 1e-12L)
        return {std::numbers::pi_v<Real>};
    const bool odd = n % 2 == 1;
    const Real pairs = n - (odd ? 1 : 0);
    const Real cosine = (-n / capacity + (odd ? 1 : 0)) / pairs;
    if (std::abs(cosine) > 1)
        throw std::runtime_error("no symmetric balanced position");
    std::vector<Real> out;
    if (odd)
        out.push_back(std::numbers::pi_v<Real>);
    for (int i = odd ? 1 : 0; i < n; ++i)
        out.push_back((i % 2 == 0 ? 1 : -1) * std::acos(cosine));
    return out;
}

std::vector<Real> balanced_position(const Balancer &balancer) {
    if (balancer.position.empty())
        return symmetric_position(balancer.n, capacity(balancer));
    return {balancer.position.begin(), balancer.position.end()};
}

Complex second_harmonic(const std::vector<Real> &angles) {
    Complex sum = 0;
    for (const Real angle : angles)
        sum += std::polar(Real(1), 2 * angle);
    return sum / static_cast<Real>(angles.size());
}

BallInertia ball_inertia(const Balancer &b) {
    const Real R0 = b.imbalance_radius;
    const Real m0 = R0 > 0 ? b.imbalance / R0 : 0;
    const Real A_m = b.n * static_cast<Real>(b.mass) * b.radius * b.radius;
    const Real A_m0 = m0 * R0 * R0;
    const Complex D = second_harmonic(balanced_position(b));
    return {b.n * static_cast<Real>(b.mass) + m0, (A_m + A_m0) / 2, A_m + A_m0,
            (A_m0 + A_m * D) / Real(2), (A_m0 + A_m * std::abs(D)) / 2};
}

HarmonicInterval harmonic_interval(const std::vector<Row> &rows, Real imbalance) {
    std::mt19937 generator(20080527);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    const Weighted balls = weighted(rows);
    const Real target = -imbalance / pull_of(rows);
    HarmonicInterval out{1, 0};
    for (int start = 0; start < 200; ++start) {
        Angles angles(balls.pull.size());
        for (Real &value : angles)
            value = angle(generator);
        if (!balls.balance(angles, target))
            continue;
        out.least = std::min(out.least, balls.extreme(angles, target, -1));
        out.most = std::max(out.most, balls.extreme(angles, target, 1));
    }
    return out;
}

} // namespace whirl::oracles

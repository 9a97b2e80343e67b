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

Jacobian constraint_slopes(const Angles &angles) {
    Jacobian J(2, angles.size());
    for (Eigen::Index i = 0; i < angles.size(); ++i) {
        J(0, i) = -std::sin(angles[i]);
        J(1, i) = std::cos(angles[i]);
    }
    return J;
}

/// Back to sum cos = -n/E, sum sin = 0 by Newton's steps of least length; false where they diverge.
bool balance(Angles &angles, Real target) {
    for (int step = 0; step < 60; ++step) {
        Eigen::Matrix<Real, 2, 1> miss(-target, 0);
        for (const Real angle : angles)
            miss += Eigen::Matrix<Real, 2, 1>(std::cos(angle), std::sin(angle));
        if (miss.norm() < 1e-16L)
            return true;
        const Jacobian J = constraint_slopes(angles);
        const Eigen::Matrix<Real, 2, 2> normal = J * J.transpose();
        if (std::abs(normal.determinant()) < 1e-24L)
            return false;
        angles -= J.transpose() * normal.inverse() * miss;
    }
    return false;
}

Real square_of_D(const Angles &angles) {
    Complex sum = 0;
    for (const Real angle : angles)
        sum += std::polar(Real(1), 2 * angle);
    return std::norm(sum / static_cast<Real>(angles.size()));
}

/// Gradient of |D|^2 along the balanced positions.
Angles slope(const Angles &angles) {
    Complex sum = 0;
    for (const Real angle : angles)
        sum += std::polar(Real(1), 2 * angle);
    const auto n = static_cast<Real>(angles.size());
    Angles out(angles.size());
    for (Eigen::Index i = 0; i < angles.size(); ++i)
        out[i] = 4 * (std::conj(sum) * Complex(0, 1) * std::polar(Real(1), 2 * angles[i])).real() /
                 (n * n);
    const Jacobian J = constraint_slopes(angles);
    const Eigen::Matrix<Real, 2, 2> normal = J * J.transpose();
    return out - J.transpose() * (normal.inverse() * (J * out));
}

/// Descends (sense -1) or climbs (sense 1) with steps that double or halve.
Real extreme(Angles angles, Real target, Real sense) {
    Real value = square_of_D(angles);
    Real size = 0.1L;
    for (int step = 0; step < 400 && size > 1e-12L; ++step) {
        Angles next = angles + sense * size * slope(angles);
        if (balance(next, target) && sense * (square_of_D(next) - value) > 0) {
            value = square_of_D(next);
            angles = next;
            size *= 2;
        } else {
            size /= 4;
        }
    }
    return std::sqrt(value);
}

} // namespace

Real capacity(const Balancer &b) {
    return b.n * static_cast<Real>(b.mass) * b.radius / static_cast<Real>(b.imbalance);
}

std::vector<Real> symmetric_position(int n, Real capacity) {
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
    const Complex D = second_harmonic(symmetric_position(b.n, capacity(b)));
    return {b.n * static_cast<Real>(b.mass) + m0, (A_m + A_m0) / 2, A_m + A_m0,
            (A_m0 + A_m * D) / Real(2), (A_m0 + A_m * std::abs(D)) / 2};
}

HarmonicInterval harmonic_interval(int n, Real capacity) {
    std::mt19937 generator(20080527);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    const Real target = -n / capacity;
    HarmonicInterval out{1, 0};
    for (int start = 0; start < 200; ++start) {
        Angles angles(n);
        for (Real &value : angles)
            value = angle(generator);
        if (!balance(angles, target))
            continue;
        out.least = std::min(out.least, extreme(angles, target, -1));
        out.most = std::max(out.most, extreme(angles, target, 1));
    }
    return out;
}

} // namespace whirl::oracles

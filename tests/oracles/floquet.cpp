#include "oracles/floquet.h"

#include "oracles/rigid_rotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::oracles {

namespace {

constexpr int stages = 4;

/// Nodes c, weights b and coefficients A of Gauss's method on (0, 1).
struct GaussMethod {
    std::array<Real, stages> c{}, b{};
    std::array<std::array<Real, stages>, stages> A{};

    GaussMethod() {
        // (35 x^4 - 30 x^2 + 3)/8 = 0
        const Real outer = std::sqrt((15 + 2 * std::sqrt(Real(30))) / 35);
        const Real inner = std::sqrt((15 - 2 * std::sqrt(Real(30))) / 35);
        c = {(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2};
        for (std::size_t j = 0; j < stages; ++j) {
            const std::array<Real, stages> basis = lagrange(j);
            b[j] = integral(basis, 1);
            for (std::size_t i = 0; i < stages; ++i)
                A[i][j] = integral(basis, c[i]);
        }
    }

  private:
    /// Coefficients of the polynomial that is 1 at node j and 0 at the others.
    [[nodiscard]] std::array<Real, stages> lagrange(std::size_t j) const {
        std::array<Real, stages> out{1, 0, 0, 0};
        for (std::size_t k = 0; k < stages; ++k) {
            if (k == j)
                continue;
            const Real scale = c[j] - c[k];
            for (std::size_t n = stages; n-- > 0;)
                out[n] = ((n > 0 ? out[n - 1] : 0) - c[k] * out[n]) / scale;
        }
        return out;
    }
    static Real integral(const std::array<Real, stages> &polynomial, Real to) {
        Real sum = 0;
        for (std::size_t n = stages; n-- > 0;)
            sum = (sum + polynomial[n] / static_cast<Real>(n + 1)) * to;
        return sum;
    }
};

/// y' = S(t) y of y = (q, T q'), T the period: entries of one size, without which the eigenvalues
/// of the monodromy matrix drown in the rounding of its largest entries.
RealMatrix state(const PeriodicSystem &system, Real t) {
    const RealMatrix K = system.period * system.K(t);
    const Eigen::Index n = K.rows();
    RealMatrix both(n, 2 * n);
    both << K, system.D(t);
    RealMatrix out = RealMatrix::Zero(2 * n, 2 * n);
    out.topRightCorner(n, n) = RealMatrix::Identity(n, n) / system.period;
    out.bottomRows(n) = -solve(system.M(t), both);
    return out;
}

/// y after one step h from t, column by column.
RealMatrix step(const PeriodicSystem &system, const GaussMethod &gauss, Real t, Real h,
                const RealMatrix &y) {
    const Eigen::Index n = y.rows();
    RealMatrix equations = RealMatrix::Identity(stages * n, stages * n);
    RealMatrix right(stages * n, y.cols());
    for (Eigen::Index i = 0; i < stages; ++i) {
        const auto stage = static_cast<std::size_t>(i);
        const RealMatrix S = state(system, t + gauss.c[stage] * h);
        right.middleRows(i * n, n) = product(S, y);
        for (Eigen::Index j = 0; j < stages; ++j)
            equations.block(i * n, j * n, n, n) -=
                h * gauss.A[stage][static_cast<std::size_t>(j)] * S;
    }
    const RealMatrix slopes = solve(equations, right);
    RealMatrix out = y;
    for (Eigen::Index i = 0; i < stages; ++i)
        out += h * gauss.b[static_cast<std::size_t>(i)] * slopes.middleRows(i * n, n);
    return out;
}

} // namespace

std::vector<Complex> multipliers(const PeriodicSystem &system, int steps) {
    static const GaussMethod gauss;
    const Eigen::Index n = 2 * system.M(0).rows();
    RealMatrix y = RealMatrix::Identity(n, n);
    const Real h = system.period / steps;
    for (int k = 0; k < steps; ++k)
        y = step(system, gauss, k * h, h, y);
    return eigenvalues(y);
}

Real floquet_growth(const PeriodicSystem &system, int steps) {
    Real largest = 0;
    for (const Complex &multiplier : multipliers(system, steps))
        largest = std::max(largest, std::abs(multiplier));
    return std::log(largest) / system.period;
}

PeriodicSystem rigid_periodic(const CaseRotor &rotor, Real speed) {
    CaseRotor unsupported = rotor;
    unsupported.supports.clear();
    const RigidRotor body = bare_rotor(unsupported);
    RealMatrix M = RealMatrix::Zero(4, 4);
    M.diagonal() << body.mass, body.A, body.mass, body.A;
    RealMatrix D = RealMatrix::Zero(4, 4);
    D(1, 3) = speed * body.C;
    D(3, 1) = -speed * body.C;
    RealMatrix K = RealMatrix::Zero(4, 4);
    for (const Support &s : rotor.supports) {
        RealMatrix at(2, 4); // deflections (x, y) at the support
        const Real z = s.z - body.centre;
        at << 1, z, 0, 0, 0, 0, 1, z;
        RealMatrix k(2, 2);
        RealMatrix c(2, 2);
        for (std::size_t i = 0; i < 4; ++i) {
            k(static_cast<int>(i / 2), static_cast<int>(i % 2)) = s.k[i / 2][i % 2];
            c(static_cast<int>(i / 2), static_cast<int>(i % 2)) = s.c[i / 2][i % 2];
        }
        const RealMatrix turned = at.transpose();
        K += product(turned, product(k, at));
        D += product(turned, product(c, at));
    }
    PeriodicSystem out;
    out.period = std::numbers::pi_v<Real> / speed;
    // Complex factor e of conj(phi): Re and Im of e conj(phi) on (phi_x, phi_y)
    const auto on_conjugate = [](RealMatrix &matrix, const Complex &e) {
        matrix(1, 1) += e.real();
        matrix(1, 3) += e.imag();
        matrix(3, 1) += e.imag();
        matrix(3, 3) -= e.real();
    };
    out.M = [M, body, speed, on_conjugate](Real t) {
        RealMatrix now = M;
        on_conjugate(now, body.a * std::polar(Real(1), 2 * speed * t));
        return now;
    };
    out.D = [D, body, speed, on_conjugate](Real t) {
        RealMatrix now = D;
        on_conjugate(now, Complex(0, 2 * speed) * body.a * std::polar(Real(1), 2 * speed * t));
        return now;
    };
    out.K = [K](Real) { return K; };
    return out;
}

} // namespace whirl::oracles

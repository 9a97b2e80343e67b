#include "oracles/floquet.h"

#include "oracles/dense_rotor.h"
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

/// y' = S(t) y of y = (q, q').
RealMatrix state(const PeriodicSystem &system, Real t) {
    const RealMatrix K = system.K(t);
    const Eigen::Index n = K.rows();
    RealMatrix both(n, 2 * n);
    both << K, system.D(t);
    RealMatrix out = RealMatrix::Zero(2 * n, 2 * n);
    out.topRightCorner(n, n).setIdentity();
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

/// Of M q'' + D q' + K q = 0, its unknowns in x, then the same in y.
struct Steady {
    RealMatrix M, D, K;
};

/// Inertial anisotropy a in rotating axes on a slope, by its row in x.
struct Turning {
    Eigen::Index slope = 0;
    Complex a;
};

/// The anisotropies added.
PeriodicSystem with_anisotropies(const Steady &steady, const std::vector<Turning> &turning,
                                 Real speed) {
    // Complex factor e of conj(phi): Re and Im of e conj(phi) on (phi_x, phi_y)
    const auto with = [turning](RealMatrix matrix, const Complex &factor) {
        const Eigen::Index n = matrix.rows() / 2;
        for (const auto &[i, a] : turning) {
            const Complex e = factor * a;
            matrix(i, i) += e.real();
            matrix(i, n + i) += e.imag();
            matrix(n + i, i) += e.imag();
            matrix(n + i, n + i) -= e.real();
        }
        return matrix;
    };
    PeriodicSystem out;
    out.period = std::numbers::pi_v<Real> / speed;
    out.M = [M = steady.M, speed, with](Real t) {
        return with(M, std::polar(Real(1), 2 * speed * t));
    };
    out.D = [D = steady.D, speed, with](Real t) {
        return with(D, Complex(0, 2 * speed) * std::polar(Real(1), 2 * speed * t));
    };
    out.K = [K = steady.K](Real) { return K; };
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
    // In units in which one of each has the same energy: else eigenvalues drown in the rounding of
    // the largest entries.
    const RealMatrix M = system.M(0);
    const RealMatrix K = system.K(0);
    std::vector<Real> units;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index row = i % (n / 2);
        const Real slow = M(row, row) / (system.period * system.period);
        units.push_back(std::sqrt(i < n / 2 ? std::max(K(row, row), slow) : M(row, row)));
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            y(i, j) *= units[static_cast<std::size_t>(i)] / units[static_cast<std::size_t>(j)];
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
    return with_anisotropies({M, D, K}, {{1, body.a}}, speed);
}

PeriodicSystem elastic_periodic(const CaseRotor &rotor, Real speed) {
    const DenseRotor dense = dense_rotor(rotor);
    const auto wide = [](const Eigen::MatrixXd &matrix) { return RealMatrix(matrix.cast<Real>()); };
    std::vector<Turning> turning;
    for (const InertialAnisotropy &item : rotor.anisotropies)
        turning.push_back(
            {dense.deflection(item.z) + 1,
             std::polar(static_cast<Real>(item.dI), 2 * static_cast<Real>(item.angle))});
    return with_anisotropies({wide(dense.M), wide(dense.C) + speed * wide(dense.G),
                              wide(dense.K) + speed * wide(dense.Kc)},
                             turning, speed);
}

} // namespace whirl::oracles

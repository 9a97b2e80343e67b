#include "oracles/pendulums.h"

#include "oracles/receptance.h"
#include "oracles/rigid_rotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

using Four = std::array<Real, 4>;

/// Steady motion as zeros in (xi, eta, phi, psi), and their slopes.
Four steady(const PendulumRotor &r, Real R_w, const Four &x, RealMatrix *slopes) {
    const Real x2 = R_w * R_w;
    const Real d = 1 - x2;
    const Real e = R_w * r.H;
    const Real m = r.R_m * x2;
    if (slopes) {
        const Real c2 = std::cos(x[2]);
        const Real c3 = std::cos(x[3]);
        *slopes << d, -e, 0, m * c3,     //
            e, d, -m * c2, 0,            //
            0, -1, r.R_a / (c2 * c2), 0, //
            1, 0, 0, r.R_a / (c3 * c3);
    }
    return {d * x[0] - e * x[1] + m * std::sin(x[3]) - m * r.u0,
            e * x[0] + d * x[1] - m * std::sin(x[2]), r.R_a * std::tan(x[2]) - x[1],
            r.R_a * std::tan(x[3]) + x[0]};
}

/// Deflection without pendulums, (1 + i R_w H - R_w^2) xi = R_m R_w^2 u0.
Complex bare_deflection(const PendulumRotor &r, Real R_w) {
    return r.R_m * R_w * R_w * r.u0 / Complex(1 - R_w * R_w, R_w * r.H);
}

/// u (complex), phi, psi and their rates; time in 1/omega0, u in arms.
struct State {
    Complex u, v;
    Real phi = 0, psi = 0, phi_rate = 0, psi_rate = 0;
};

State operator+(const State &a, const State &b) {
    return {a.u + b.u,
            a.v + b.v,
            a.phi + b.phi,
            a.psi + b.psi,
            a.phi_rate + b.phi_rate,
            a.psi_rate + b.psi_rate};
}
State operator*(Real f, const State &a) {
    return {f * a.u, f * a.v, f * a.phi, f * a.psi, f * a.phi_rate, f * a.psi_rate};
}

/// With b = u'' + 2 i R u' - R^2 u and S = i sin phi - sin psi (sum of the masses' places over
/// 2 l):
///   b + H (u' + i R u) + u + R_m (S'' + 2 i R S' - R^2 S) = R_m R^2 u0,
///   phi'' + h phi' + R_a R^2 sin phi + cos phi Im b = 0,
///   psi'' + h psi' + R_a R^2 sin psi - cos psi Re b = 0.
State rate(const PendulumRotor &r, Real R, const State &s) {
    const Complex i(0, 1);
    const Real sp = std::sin(s.phi), cp = std::cos(s.phi);
    const Real sq = std::sin(s.psi), cq = std::cos(s.psi);
    const Complex S = i * sp - sq;
    const Complex S_rate = i * cp * s.phi_rate - cq * s.psi_rate;
    const Complex S_known = -i * sp * s.phi_rate * s.phi_rate + sq * s.psi_rate * s.psi_rate;
    const Complex f = r.R_m * R * R * r.u0 - r.H * (s.v + i * R * s.u) - s.u -
                      r.R_m * (S_known + Real(2) * i * R * S_rate - R * R * S);
    const Real f_phi = -r.h * s.phi_rate - r.R_a * R * R * sp;
    const Real f_psi = -r.h * s.psi_rate - r.R_a * R * R * sq;
    // b + R_m (i cp phi'' - cq psi'') = f with phi'' = f_phi - cp Im b, psi'' = f_psi + cq Re b
    const Complex b((f.real() + r.R_m * cq * f_psi) / (1 - r.R_m * cq * cq),
                    (f.imag() - r.R_m * cp * f_phi) / (1 - r.R_m * cp * cp));
    return {s.v,
            b - Real(2) * i * R * s.v + R * R * s.u,
            s.phi_rate,
            s.psi_rate,
            f_phi - cp * b.imag(),
            f_psi + cq * b.real()};
}

} // namespace

Real PendulumRotor::threshold() const { return 1 / std::sqrt(1 + rho() / 2); }
Real PendulumRotor::limit() const { return 1 / (1 + rho()); }

PendulumRotor pendulum_rotor(const CaseRotor &rotor, const PendulumDesign &design) {
    const RigidRotor body = bare_rotor(rotor);
    const Balancer &b = rotor.balancers.front();
    const Real mass = body.mass + 4 * static_cast<Real>(b.mass);
    PendulumRotor out;
    out.omega0 = std::sqrt(body.k0 / mass);
    out.R_m = 2 * static_cast<Real>(b.mass) / mass;
    out.R_a = static_cast<Real>(design.pivot) / design.arm;
    out.H = body.c0 / (mass * out.omega0);
    out.h = b.damping / (b.mass * static_cast<Real>(design.arm) * design.arm * out.omega0);
    out.u0 = b.imbalance / (2 * static_cast<Real>(b.mass) * design.arm);
    return out;
}

PendulumRotor pendulum_rotor(const CaseRotor &rotor) {
    const Balancer &b = rotor.balancers.front();
    return pendulum_rotor(rotor, {b.arm, b.pivot});
}

Real approximate_efficiency(const PendulumRotor &r, Real R_w) {
    const Real x = R_w * R_w;
    const Real e = x * r.H * r.H;
    const Real with = 1 - x * (1 + r.rho());
    return std::sqrt(((1 - x) * (1 - x) + e) / (with * with + e));
}

Real exact_efficiency(const PendulumRotor &r, Real R_w) {
    const Real x2 = R_w * R_w;
    // sin = tan: psi = -xi/R_a, phi = eta/R_a
    const Complex first = r.R_m * x2 * r.u0 / Complex(1 - x2 * (1 + r.rho()), R_w * r.H);
    Four x{first.real(), first.imag(), std::atan(first.imag() / r.R_a),
           -std::atan(first.real() / r.R_a)};
    for (int step = 0; step < 100; ++step) {
        RealMatrix slopes(4, 4);
        RealMatrix miss(4, 1);
        const Four at = steady(r, R_w, x, &slopes);
        std::copy(at.begin(), at.end(), miss.data());
        const RealMatrix move = solve(slopes, miss);
        Real size = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] -= move(static_cast<Eigen::Index>(k), 0);
            size += x[k] * x[k];
        }
        size = std::sqrt(size);
        if (move.norm() < 1e-18L * size)
            break;
        if (step == 99 && move.norm() > 1e-15L * size)
            throw std::runtime_error("steady motion of the pendulums: no convergence");
    }
    return std::hypot(x[0], x[1]) / std::abs(bare_deflection(r, R_w));
}

Real linear_growth(const PendulumRotor &r, Real R_w) {
    // mu = s^2 + 2 i R s - R^2; coefficients by powers of s
    const Complex i(0, 1);
    const Real R = R_w;
    const std::array<Complex, 3> mu{-R * R, Real(2) * i * R, Real(1)};
    const std::array<Complex, 3> disc{mu[0] + r.H * i * R + Real(1), mu[1] + r.H, mu[2]};
    const std::array<Complex, 3> pendulum{r.R_a * R * R, r.h, Real(1)};
    std::array<Complex, 5> polynomial{};
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            polynomial[a + b] += disc[a] * pendulum[b] - r.R_m * mu[a] * mu[b];
    ComplexMatrix companion = ComplexMatrix::Zero(4, 4);
    for (Eigen::Index k = 0; k < 4; ++k) {
        companion(0, k) = -polynomial[3 - static_cast<std::size_t>(k)] / polynomial[4];
        if (k > 0)
            companion(k, k - 1) = Real(1);
    }
    Real out = -std::numeric_limits<Real>::infinity();
    for (const Complex &root : eigenvalues(real_form(companion, ComplexMatrix::Zero(4, 4))))
        out = std::max(out, root.real());
    return out;
}

std::string PendulumOutcome::name() const {
    if (drift > std::numbers::pi_v<Real>)
        return "lagging";
    return swing > 0.05L ? "whirling" : "at rest";
}

PendulumOutcome pendulum_motion(const PendulumRotor &rotor, Real R_w, Real phi, Real psi,
                                Real time) {
    const Real end = time * rotor.omega0;
    const auto steps = static_cast<long>(240 * end * R_w / (2 * std::numbers::pi_v<Real>)) + 1;
    const Real h = end / static_cast<Real>(steps);
    State s;
    s.phi = phi;
    s.psi = psi;
    State start;
    std::array<Real, 2> low{1e9L, 1e9L}, high{-1e9L, -1e9L};
    for (long k = 0; k < steps; ++k) {
        const State a = rate(rotor, R_w, s);
        const State b = rate(rotor, R_w, s + h / 2 * a);
        const State c = rate(rotor, R_w, s + h / 2 * b);
        const State d = rate(rotor, R_w, s + h * c);
        s = s + h / 6 * (a + 2 * b + 2 * c + d);
        if (k == steps - steps / 10)
            start = s;
        if (k >= steps - steps / 40) {
            low = {std::min(low[0], s.phi), std::min(low[1], s.psi)};
            high = {std::max(high[0], s.phi), std::max(high[1], s.psi)};
        }
    }
    return {std::max(high[0] - low[0], high[1] - low[1]),
            std::max(std::abs(s.phi - start.phi), std::abs(s.psi - start.psi))};
}

} // namespace whirl::oracles

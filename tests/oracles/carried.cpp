#include "oracles/carried.h"

#include "oracles/balls.h"
#include "oracles/jet.h"
#include "oracles/rotating_state.h"

#include <Eigen/LU>

#include <algorithm>
#include <stdexcept>

namespace whirl::oracles {

namespace {

/// What one bead's energy depends on: u, p, its angle, its turning, and their rates.
constexpr std::size_t local = 6;
template <class Number> using Energy = Jet<Number, 2 * local>;

template <class Number> struct Energies { Energy<Number> T, V, F; };

/// Motion of the rotor in axes that turn: u, p and the velocities U = u' + i W u, P = p' + i W p.
template <class Number> struct Local {
    std::array<Energy<Number>, local> q, r;
    Energy<Number> Ux, Uy, Px, Py;

    Local(const std::array<Number, 2 * local> &at, Number W) {
        for (std::size_t i = 0; i < local; ++i) {
            q[i] = Energy<Number>::variable(at[i], i);
            r[i] = Energy<Number>::variable(at[local + i], local + i);
        }
        Ux = r[0] - W * q[1];
        Uy = r[1] + W * q[0];
        Px = r[2] - W * q[3];
        Py = r[3] + W * q[2];
    }
    /// Im(conj(p) P)
    [[nodiscard]] Energy<Number> swirl() const { return q[2] * Py - q[3] * Px; }
};

/// T = 1/2 M |U|^2 + 1/2 A |P|^2 - 1/2 C W Im(conj(p) P), V of the springs and of the centrifugal
/// forces of the imbalances, F of the dampers in the fixed axes.
template <class Number>
Energies<Number> of_rotor(const Local<Number> &m, const RigidRotor &b, Number W, Number force,
                          Number moment) {
    const auto c = [](Real x) { return static_cast<Number>(x); };
    const Number half = 0.5;
    Energies<Number> e;
    e.T = half * c(b.mass) * (square(m.Ux) + square(m.Uy)) +
          half * c(b.A) * (square(m.Px) + square(m.Py)) - half * c(b.C) * W * m.swirl();
    e.V = half * c(b.k0) * (square(m.q[0]) + square(m.q[1])) +
          c(b.k1) * (m.q[0] * m.q[2] + m.q[1] * m.q[3]) +
          half * c(b.k2) * (square(m.q[2]) + square(m.q[3])) -
          W * W * (force * m.q[0] + moment * m.q[2]);
    e.F = half * c(b.c0) * (square(m.Ux) + square(m.Uy)) + c(b.c1) * (m.Ux * m.Px + m.Uy * m.Py) +
          half * c(b.c2) * (square(m.Px) + square(m.Py));
    return e;
}

/// The centre moves on a circle in a plane of the rotor that tilts with it: at the angle g = W t +
/// a it is at r exp(i g) with r^2 (1 + c^2) = R^2 and R c out of the plane, c = Re(p exp(-i a)); so
/// T = 1/2 m |U + z P + i R g' exp(i a)|^2 + 1/2 m R^2 (c'^2 - g'^2 c^2) to second order in slopes.
/// A ring adds 1/2 J h'^2 - 1/2 J h' Im(conj(p) P) + 1/4 J |P|^2, h = W t + its turning b; at the
/// journal it slides with R a' - bore b'.
template <class Number>
Energies<Number> of_bead(const Local<Number> &m, const Bead &bead, Number W) {
    const auto number = [](Real x) { return static_cast<Number>(x); };
    const Number half = 0.5;
    const Number R = number(bead.radius), z = number(bead.z), mass = number(bead.mass);
    const Energy<Number> s = sine(m.q[4]);
    const Energy<Number> c = cosine(m.q[4]);
    const Energy<Number> spin = m.r[4] + Energy<Number>(W);
    const Energy<Number> vx = m.Ux + z * m.Px - R * (spin * s);
    const Energy<Number> vy = m.Uy + z * m.Py + R * (spin * c);
    const Energy<Number> out = m.q[2] * c + m.q[3] * s;
    const Energy<Number> out_rate = (m.r[2] + m.r[4] * m.q[3]) * c + (m.r[3] - m.r[4] * m.q[2]) * s;
    Energies<Number> e;
    e.T = half * mass * (square(vx) + square(vy)) +
          half * mass * R * R * (square(out_rate) - square(spin * out));
    if (!bead.ring) {
        e.F = half * number(bead.damping) * R * R * square(m.r[4]);
        return e;
    }
    const Number J = number(bead.inertia);
    const Energy<Number> turning = m.r[5] + Energy<Number>(W);
    e.T += half * J * (square(turning) - turning * m.swirl()) +
           half * half * J * (square(m.Px) + square(m.Py));
    e.F = half * number(bead.damping) * square(R * m.r[4] - number(bead.bore) * m.r[5]) +
          half * number(bead.drag) * square(m.r[5]);
    return e;
}

/// M q'' + f = 0 and its derivatives by q (K) and by q' (D) at rest, summed over rotor and beads.
template <class Number> struct Sums {
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    Matrix M, D, K;
    Vector f;

    explicit Sums(Eigen::Index n) : M(Matrix::Zero(n, n)), D(M), K(M), f(Vector::Zero(n)) {}

    /// @param places  of the local unknowns; negative: there is none
    void add(const Energies<Number> &e, const std::array<Eigen::Index, local> &places,
             const std::array<Number, 2 * local> &at) {
        for (std::size_t i = 0; i < local; ++i) {
            if (places[i] < 0)
                continue;
            f[places[i]] += e.V.first[i] - e.T.first[i] + e.F.first[local + i];
            for (std::size_t j = 0; j < local; ++j) {
                f[places[i]] += e.T.second[local + i][j] * at[local + j];
                if (places[j] < 0)
                    continue;
                M(places[i], places[j]) += e.T.second[local + i][local + j];
                D(places[i], places[j]) += e.T.second[local + i][j] - e.T.second[i][local + j] +
                                           e.F.second[local + i][local + j];
                K(places[i], places[j]) +=
                    e.V.second[i][j] - e.T.second[i][j] + e.F.second[local + i][j];
            }
        }
    }
};

template <class Number>
Sums<Number> summed(const CarriedRotor &rotor, const RigidRotor &body, Number W, Number force,
                    Number moment, const Eigen::Matrix<Number, Eigen::Dynamic, 1> &q,
                    const Eigen::Matrix<Number, Eigen::Dynamic, 1> &r) {
    Sums<Number> out(rotor.unknowns());
    std::array<Eigen::Index, local> places{0, 1, 2, 3, -1, -1};
    Real held = 0;
    const auto local_motion = [&] {
        std::array<Number, 2 * local> at{};
        for (std::size_t i = 0; i < local; ++i)
            if (places[i] >= 0) {
                at[i] = q[places[i]];
                at[local + i] = r[places[i]];
            }
        at[4] += static_cast<Number>(held);
        return at;
    };
    auto at = local_motion();
    out.add(of_rotor(Local<Number>(at, W), body, W, force, moment), places, at);
    for (std::size_t k = 0; k < rotor.beads().size(); ++k) {
        const Bead &bead = rotor.beads()[k];
        held = bead.held ? bead.angle : 0;
        places[4] = rotor.place(k);
        places[5] = bead.ring && !bead.held ? places[4] + 1 : -1;
        at = local_motion();
        out.add(of_bead(Local<Number>(at, W), rotor.beads()[k], W), places, at);
    }
    return out;
}

std::vector<Real> angles_at_balance(const Balancer &balancer) {
    std::vector<Real> out;
    if (!balancer.position.empty())
        return balanced_position(balancer);
    for (const Row &row : balancer.rows)
        for (const Real angle : symmetric_position(row.n, capacity(balancer)))
            out.push_back(angle);
    return out;
}

} // namespace

std::vector<Bead> beads_of(const CaseRotor &rotor) {
    std::vector<Bead> out;
    const Real centre = bare_rotor(rotor).centre;
    for (std::size_t b = 0; b < rotor.balancers.size(); ++b) {
        const Balancer &balancer = rotor.balancers[b];
        if (balancer.pendulums)
            throw std::runtime_error("motion of balls and rings: no pendulums");
        std::vector<Real> angles;
        if (balancer.held && !rotor.ball_angles.empty())
            angles.assign(rotor.ball_angles[b].begin(), rotor.ball_angles[b].end());
        else if (balancer.held)
            angles = angles_at_balance(balancer);
        std::size_t at = 0;
        for (const Row &row : balancer.rows)
            for (int i = 0; i < row.n; ++i, ++at)
                out.push_back({b, static_cast<Real>(balancer.z) - centre, row.mass, row.radius,
                               row.damping, balancer.ring, balancer.bore, balancer.inertia,
                               balancer.drag, balancer.held, balancer.held ? angles.at(at) : 0});
    }
    for (std::size_t b = 0; b < rotor.balancers.size(); ++b) {
        const Balancer &balancer = rotor.balancers[b];
        const Real R0 = balancer.imbalance_radius;
        if (R0 > 0)
            out.push_back({b, static_cast<Real>(balancer.z) - centre, balancer.imbalance / R0, R0,
                           0, false, 0, 0, 0, true, 0});
    }
    return out;
}

std::vector<Real> balanced_angles(const CaseRotor &rotor) {
    std::vector<Real> out;
    for (const Balancer &balancer : rotor.balancers)
        if (!balancer.held)
            for (const Real angle : angles_at_balance(balancer))
                out.push_back(angle);
    return out;
}

CarriedRotor::CarriedRotor(const CaseRotor &rotor, Real speed)
    : _body(bare_rotor(rotor)), _speed(speed), _beads(beads_of(rotor)) {
    for (const Balancer &balancer : rotor.balancers)
        if (!(balancer.imbalance_radius > 0)) { // else a bead
            _force += balancer.imbalance;
            _moment += balancer.imbalance * (balancer.z - _body.centre);
        }
    for (const Bead &bead : _beads) {
        _places.push_back(bead.held ? -1 : _unknowns);
        _unknowns += bead.held ? 0 : bead.ring ? 2 : 1;
    }
}

std::vector<Complex> CarriedRotor::eigenvalues(const std::vector<Real> &angles) const {
    using WideVector = Sums<Real>::Vector;
    WideVector q = WideVector::Zero(_unknowns);
    Real moments = _force;
    auto angle = angles.begin();
    for (std::size_t k = 0; k < _beads.size(); ++k) {
        moments += _beads[k].mass * _beads[k].radius;
        if (!_beads[k].held)
            q[_places[k]] = *angle++;
    }
    const WideVector rest = WideVector::Zero(_unknowns);
    const Sums<Real> s = summed<Real>(*this, _body, _speed, _force, _moment, q, rest);
    if (_unknowns > 4 && s.f.norm() > 1e-15L * moments * _speed * _speed)
        throw std::runtime_error("the balls do not balance the rotor there");
    return state_eigenvalues(s.M, s.D, s.K, _speed);
}

Eigen::VectorXd CarriedRotor::acceleration(const Eigen::VectorXd &q,
                                           const Eigen::VectorXd &r) const {
    const Sums<double> s =
        summed<double>(*this, _body, static_cast<double>(_speed), static_cast<double>(_force),
                       static_cast<double>(_moment), q, r);
    const Eigen::VectorXd pull = s.M.partialPivLu().solve(s.f);
    return -pull;
}

double CarriedRotor::amplitude(const Eigen::VectorXd &q) const {
    double out = 0;
    for (const Bead &bead : _beads) {
        const auto z = static_cast<double>(bead.z);
        out = std::max(out, std::hypot(q[0] + z * q[2], q[1] + z * q[3]));
    }
    return out;
}

double CarriedRotor::amplitude_without_beads() const {
    if (std::ranges::any_of(_beads, &Bead::held))
        throw std::runtime_error("motion without balls and rings: none of them held");
    const Real W2 = _speed * _speed;
    Eigen::Matrix<Complex, 2, 2> D;
    D << Complex(_body.k0 - W2 * _body.mass, _speed * _body.c0),
        Complex(_body.k1, _speed * _body.c1), Complex(_body.k1, _speed * _body.c1),
        Complex(_body.k2 - W2 * (_body.A - _body.C), _speed * _body.c2);
    const Complex det = D(0, 0) * D(1, 1) - D(0, 1) * D(1, 0);
    const Complex u = W2 * (D(1, 1) * _force - D(0, 1) * _moment) / det;
    const Complex p = W2 * (D(0, 0) * _moment - D(1, 0) * _force) / det;
    double out = 0;
    for (const Bead &bead : _beads)
        out = std::max(out, static_cast<double>(std::abs(u + bead.z * p)));
    return out;
}

} // namespace whirl::oracles

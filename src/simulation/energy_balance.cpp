// Energy and angular momentum of the moving rotor, and what crosses its borders.

#include "simulation/motion.h"

namespace whirl::simulation {

namespace {

using Eigen::Index;
using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using ConstPair = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2>>;

} // namespace

void RotorMotion::keep_energy_balance(const Spin::At &spin, double torque, const double *state,
                                      double *books) const {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    const int n = coordinates();
    const ConstMap p(state, 2 * r);
    const ConstMap v(state + n, 2 * r);
    const ConstPair x(state, r, 2);
    // _push = K p + C v; what of v . K p is not the change of a potential counts as loss.
    double loss = 0;
    double impulse = torque - (x.col(0).dot(_push.tail(r)) - x.col(1).dot(_push.head(r)));
    if (_tables) {
        const reduction::ReducedRotor::Supports at = rotor.supports_at(spin.speed);
        const reduction::ReducedRotor::Supports slope = rotor.supports_slope(spin.speed);
        loss += v.dot(at.damping * v) - p.dot(slope.stiffness * p) * spin.acceleration / 2;
        loss += (v.dot(at.stiffness * p) - p.dot(at.stiffness * v)) / 2;
    } else {
        loss += v.dot(_by_velocity.head(2 * r));
        if (_circulating)
            loss += (v.dot(_stiffness * p) - p.dot(_stiffness * v)) / 2;
    }
    if (_internal)
        loss += _slip.cwiseProduct(ConstPair(_inner.data(), r, 2)).sum();
    const double *rate = state + n + first_angle();
    for (const balancers::MassEquation &e : _free_equations) { // as at this state
        loss += e.friction * *rate++;
        impulse += e.weight;
    }
    for (const FixedMass &mass : _parts.fixed)
        if (mass.mass.weight != 0 && is_there(mass))
            impulse -= mass.mass.weight * std::cos(spin.angle + mass.phase);
    if (rotor.mass_deviation.size() > 0) { // momentum is not along the velocity
        const Eigen::VectorXd deviating = rotor.mass_deviation * v;
        impulse += v.head(r).dot(deviating.tail(r)) - v.tail(r).dot(deviating.head(r));
        const ConstMap a(_forces.data(), 2 * r); // what is skew in the masses has no energy
        loss += (v.dot(rotor.mass_deviation * a) - a.dot(deviating)) / 2;
    }
    books[0] = torque * spin.speed;
    books[1] = loss;
    books[2] = impulse;
    if (!_parts.excitation.none())
        add_outside_work(spin, state, books);
}

/// Work and angular impulse of the forces at stations and of the field -a of the foundation, on the
/// rotor and on the masses that have equations of their own.
void RotorMotion::add_outside_work(const Spin::At &spin, const double *state, double *books) const {
    const Index r = _parts.rotor.size();
    const ConstPair x(state, r, 2);
    books[0] += _external.dot(ConstMap(state + coordinates(), 2 * r));
    books[2] += x.col(0).dot(_external.tail(r)) - x.col(1).dot(_external.head(r));
    const double *rate = state + coordinates() + first_angle();
    for (const balancers::MassEquation &e : _free_equations) {
        const double along = e.u.head<2>().dot(_base);
        const double turning = _base(1) * e.offset(0) - _base(0) * e.offset(1);
        const double own = *rate++;
        books[0] -= along * (e.in_rotor ? own : spin.speed + own) + turning * spin.speed;
        books[2] -= e.in_rotor ? turning : along + turning;
    }
    for (const balancers::MassEquation &e : _fixed_equations) {
        const double along = e.u.head<2>().dot(_base);
        books[0] -= along * spin.speed;
        books[2] -= along;
    }
}

RotorMotion::Totals RotorMotion::totals(double t, const double *state) const {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    const int n = coordinates();
    const Spin::At now = spin(t, state);
    const ConstMap p(state, 2 * r);
    const ConstMap v(state + n, 2 * r);
    const ConstPair x(state, r, 2);
    const ConstPair u(state + n, r, 2);
    const double turning =
        x.col(0).dot(rotor.gyroscopic * u.col(1)) - x.col(1).dot(rotor.gyroscopic * u.col(0));
    double energy = v.squaredNorm() / 2 + _parts.polar_inertia * now.speed * now.speed / 2;
    double momentum = _parts.polar_inertia * now.speed;
    momentum -= turning / 2;
    momentum += x.col(0).dot(u.col(1)) - x.col(1).dot(u.col(0));
    if (rotor.mass_deviation.size() > 0) {
        const Eigen::VectorXd deviating = rotor.mass_deviation * v;
        energy += v.dot(deviating) / 2;
        momentum += x.col(0).dot(deviating.tail(r)) - x.col(1).dot(deviating.head(r));
    }
    energy -= now.speed / 2 * turning;
    momentum -=
        now.speed / 2 *
        (x.col(0).dot(rotor.gyroscopic * x.col(0)) + x.col(1).dot(rotor.gyroscopic * x.col(1)));
    energy += (x.col(0).dot(rotor.elastic * x.col(0)) + x.col(1).dot(rotor.elastic * x.col(1)) +
               p.dot(rotor.supports_at(now.speed).stiffness * p)) /
              2;
    const auto add = [&](const balancers::PlaneVector &place, const balancers::MassMomenta &part) {
        const balancers::PlaneVector &m = part.plane;
        energy += part.kinetic + part.potential;
        momentum += part.spin + // and Im(q^H m)
                    (place(0) * m(1) - place(1) * m(0) + place(2) * m(3) - place(3) * m(2));
    };
    const double *angles = state + first_angle();
    for (const FreeParts &parts : _parts.free) {
        const balancers::PlaneMotion plane = motion_of(parts.plane, state);
        add(plane.place, parts.motion->momenta(plane, {now.angle, now.speed}, angles, angles + n));
        angles += parts.motion->size();
    }
    for (const FixedMass &mass : _parts.fixed) {
        if (!is_there(mass))
            continue;
        const balancers::PlaneMotion plane{fixed_motion(mass, state),
                                           fixed_motion(mass, state + n)};
        add(plane.place, mass.mass.momenta(plane, now.angle + mass.phase, now.speed));
    }
    return {energy, momentum};
}

} // namespace whirl::simulation

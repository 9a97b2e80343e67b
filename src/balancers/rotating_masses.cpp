#include "balancers/rotating_masses.h"

#include <cmath>

namespace whirl::balancers {

namespace {

/// Components of slope and its velocity along the radius and across it.
struct Tilt {
    double c, s;   ///< phi exp(-i g) = c + i s
    double vc, vs; ///< phi' exp(-i g)
};

Tilt tilt_of(const PlaneVector &p, const PlaneVector &v, double cosine, double sine) {
    return {p(2) * cosine + p(3) * sine, p(3) * cosine - p(2) * sine, v(2) * cosine + v(3) * sine,
            v(3) * cosine - v(2) * sine};
}

} // namespace

MassEquation CircleMass::equation(const PlaneVector &p, const PlaneVector &v, double angle,
                                  double rate) const {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const Tilt t = tilt_of(p, v, cosine, sine);
    MassEquation out;
    out.u << -moment * sine, moment * cosine, tilt * t.s * cosine, tilt * t.s * sine;
    out.a = inertia + tilt * (t.s * t.s - t.c * t.c);
    out.b = 2 * tilt * rate * (t.s * t.vs - t.c * t.vc - rate * t.c * t.s) + weight * cosine;
    const double radial = moment * rate * rate;
    const double tilting = -2 * tilt * rate * t.vs;
    out.force << radial * cosine, radial * sine, tilting * cosine, tilting * sine;
    // mu e e^T less its mean over the angle
    const double mean = tilt / 2;
    out.tilt << tilt * cosine * cosine - mean, tilt * cosine * sine, tilt * cosine * sine,
        tilt * sine * sine - mean;
    return out;
}

MassMomenta CircleMass::momenta(const PlaneVector &p, const PlaneVector &v, double angle,
                                double rate) const {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const Tilt t = tilt_of(p, v, cosine, sine);
    const double across = v(1) * cosine - v(0) * sine; // Im(w' exp(-i g))
    const double c_rate = t.vc + rate * t.s;
    MassMomenta out;
    out.kinetic = moment * rate * across + inertia * rate * rate / 2 +
                  tilt * (c_rate * c_rate - rate * rate * t.c * t.c) / 2 -
                  tilt * v.tail<2>().squaredNorm() / 4;
    out.potential = weight * sine;
    out.spin = moment * across + inertia * rate + tilt * (c_rate * t.s - rate * t.c * t.c);
    out.plane << -moment * rate * sine, moment * rate * cosine, tilt * (c_rate * cosine - v(2) / 2),
        tilt * (c_rate * sine - v(3) / 2);
    return out;
}

MassEquation PendulumPair::equation(const SpinState &spin, double angle, double rate) const {
    const double e = spin.angle + line;
    const Eigen::Vector2d along(std::cos(e), std::sin(e));
    const Eigen::Vector2d across(-along(1), along(0));
    const double twice = 2 * mass * arm;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    MassEquation out;
    out.u.head<2>() = twice * cosine * across;
    out.a = twice * arm;
    out.b = twice * pivot * spin.speed * spin.speed * sine + 2 * damping * rate +
            twice * gravity * cosine * along(0);
    const double radial = rate * rate + spin.speed * spin.speed;
    out.force.head<2>() = twice * (radial * sine * across + 2 * spin.speed * rate * cosine * along);
    out.per_spin.head<2>() = twice * sine * along;
    return out;
}

MassMomenta PendulumPair::momenta(const SpinState &spin, const PlaneVector &v, double angle,
                                  double rate) const {
    const Eigen::Vector2d S = offset(spin, angle);
    const Eigen::Vector2d turned(-S(1), S(0)); // i S
    const double e = spin.angle + line;
    const Eigen::Vector2d across(-std::sin(e), std::cos(e));
    const Eigen::Vector2d S_rate =
        2 * mass * arm * std::cos(angle) * rate * across + spin.speed * turned;
    const double about = pivot * pivot + arm * arm + 2 * pivot * arm * std::cos(angle);
    MassMomenta out;
    out.kinetic = v.head<2>().dot(S_rate) +
                  mass * (about * spin.speed * spin.speed + arm * arm * rate * rate);
    out.potential = gravity * S(1);
    out.spin = v.head<2>().dot(turned) + 2 * mass * about * spin.speed;
    out.plane.head<2>() = S_rate;
    return out;
}

Eigen::Vector2d PendulumPair::torque(const SpinState &spin, double angle, double rate) const {
    const double about = pivot * pivot + arm * arm + 2 * pivot * arm * std::cos(angle);
    const double slowing = 4 * mass * pivot * arm * spin.speed * rate * std::sin(angle);
    return {gravity * offset(spin, angle)(0) - slowing, 2 * mass * about};
}

Eigen::Vector2d PendulumPair::offset(const SpinState &spin, double angle) const {
    const double e = spin.angle + line;
    return 2 * mass * arm * std::sin(angle) * Eigen::Vector2d(-std::sin(e), std::cos(e));
}

} // namespace whirl::balancers

#include "balancers/circle_mass.h"

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

void CircleMass::write_equation(const PlaneMotion &plane, double cosine, double sine, double rate,
                                MassEquation &out) const {
    const Tilt t = tilt_of(plane.place, plane.velocity, cosine, sine);
    out.u << -moment * sine, moment * cosine, tilt * t.s * cosine, tilt * t.s * sine;
    out.a = inertia + tilt * (t.s * t.s - t.c * t.c);
    out.weight = -weight * cosine;
    out.b = 2 * tilt * rate * (t.s * t.vs - t.c * t.vc - rate * t.c * t.s) - out.weight;
    const double radial = moment * rate * rate;
    const double tilting = -2 * tilt * rate * t.vs;
    out.force << radial * cosine, radial * sine, tilting * cosine, tilting * sine;
    // mu e e^T less its mean over the angle
    const double mean = tilt / 2;
    out.tilt << tilt * cosine * cosine - mean, tilt * cosine * sine, tilt * cosine * sine,
        tilt * sine * sine - mean;
}

MassMomenta CircleMass::momenta(const PlaneMotion &plane, double angle, double rate) const {
    const PlaneVector &v = plane.velocity;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const Tilt t = tilt_of(plane.place, v, cosine, sine);
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

} // namespace whirl::balancers

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

AtRest::AtRest(int angles) {
    const Eigen::Index n = 4 + angles;
    force = Eigen::VectorXd::Zero(n);
    for (Eigen::MatrixXd *matrix : {&inertia, &gyroscopic, &damping, &stiffness})
        *matrix = Eigen::MatrixXd::Zero(n, n);
}

void AtRest::add_symmetric(Eigen::MatrixXd &matrix, int plane, Eigen::Index angle,
                           const Eigen::Vector2d &column) {
    matrix.block<2, 1>(plane, angle) += column;
    matrix.block<1, 2>(angle, plane) += column.transpose();
}

void AtRest::add_skew(Eigen::MatrixXd &matrix, int plane, Eigen::Index angle,
                      const Eigen::Vector2d &column) {
    matrix.block<2, 1>(plane, angle) += column;
    matrix.block<1, 2>(angle, plane) -= column.transpose();
}

// With e along the radius, n across it, and the energy of circle_mass.h in rotating axes, less that
// of the mean mu/2 in the rotor's mass matrix:
//     L = m R (Om + a')(n.W' + Om e.W) + m R^2 (Om + a')^2/2
//         + mu [(e.Phi' + a' n.Phi)^2 - (Om + a')^2 (e.Phi)^2]/2 - mu |Phi' + Om i Phi|^2/4.
// The matrices are its second derivatives at a' = W' = Phi' = 0.
void CircleMass::add_at_rest(const PlaneVector &place, double speed, double angle,
                             std::optional<Eigen::Index> index, AtRest &out) const {
    const Eigen::Vector2d e(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d n(-e(1), e(0));
    const double c = e.dot(place.tail<2>());
    const double s = n.dot(place.tail<2>());
    const double squared = speed * speed;
    const Eigen::Matrix2d along = tilt * e * e.transpose();
    const Eigen::Matrix2d mean = tilt / 2 * Eigen::Matrix2d::Identity();
    Eigen::Matrix2d turn;
    turn << 0, -1, 1, 0;
    out.force.head<2>() += moment * squared * e;
    out.force.segment<2>(2) -= squared * (along + mean) * place.tail<2>();
    out.inertia.block<2, 2>(2, 2) += along - mean;
    out.gyroscopic.block<2, 2>(2, 2) -= tilt * speed * turn;
    out.stiffness.block<2, 2>(2, 2) += squared * (along + mean);
    if (!index)
        return;
    const Eigen::Index a = *index;
    const double pull = squared * (moment * e.dot(place.head<2>()) + tilt * (s * s - c * c));
    out.force(a) += squared * (moment * n.dot(place.head<2>()) - tilt * c * s);
    out.inertia(a, a) += inertia + tilt * (s * s - c * c);
    AtRest::add_symmetric(out.inertia, 0, a, moment * n);
    AtRest::add_symmetric(out.inertia, 2, a, tilt * s * e);
    AtRest::add_skew(out.gyroscopic, 0, a, -2 * moment * speed * e);
    AtRest::add_skew(out.gyroscopic, 2, a, 2 * tilt * speed * c * e);
    out.stiffness(a, a) += pull;
    AtRest::add_symmetric(out.stiffness, 0, a, -moment * squared * n);
    AtRest::add_symmetric(out.stiffness, 2, a, tilt * squared * (c * n + s * e));
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

#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::balancers {

/// Motion of a plane of the rotor: deflection w = (x, y) in the first two entries, slope in the
/// last two.
using PlaneVector = Eigen::Vector4d;

/// What the rotor does at one moment.
struct SpinState {
    double angle = 0; ///< theta, rad
    double speed = 0; ///< Omega, rad/s
};

/// An equation a g'' + u . y + b = 0 of one angle g, and the force -(u g'' + Q y) + P on its plane,
/// y the plane's acceleration; with g'' eliminated by condense(). The constant inertia that the
/// rotor's mass matrix already holds is not in Q.
struct MassEquation {
    PlaneVector u = PlaneVector::Zero();            ///< coupling of angle and plane
    double a = 0;                                   ///< inertia of the angle
    double b = 0;                                   ///< all without accelerations
    PlaneVector force = PlaneVector::Zero();        ///< P
    PlaneVector per_spin = PlaneVector::Zero();     ///< change of P per unit of spin acceleration
    Eigen::Matrix2d tilt = Eigen::Matrix2d::Zero(); ///< Q on the slopes
};

/// Contributions to the energy and to the angular momentum about the z axis beyond those of the
/// rotor's mass matrix.
struct MassMomenta {
    double kinetic = 0;   ///< J
    double potential = 0; ///< J
    double spin = 0;      ///< dT/d(angular velocity), of the angle alone, kg m2/s
    PlaneVector plane = PlaneVector::Zero(); ///< dT/d(velocity of the plane)
};

/// A point on a circle about the axis: a ball (angle free), or a mass fixed in the rotor. Its
/// energy, to second order in slopes, c = Re(phi exp(-i g)):
///     T = m |w' + i R g' exp(i g)|^2 / 2 + mu (c'^2 - g'^2 c^2) / 2,  mu = m R^2 (0: no tilt).
/// docs/theory.md, "Motion in time".
struct CircleMass {
    double moment = 0;  ///< m R, kg m
    double inertia = 0; ///< m R^2, kg m2
    double tilt = 0;    ///< mu, kg m2: inertia, or 0 where the tilt inertia is left out
    double weight = 0;  ///< m g R, N m

    /// @param p,v  motion of the plane and its velocity
    /// @param angle,rate  g (fixed frame) and g'
    [[nodiscard]] MassEquation equation(const PlaneVector &p, const PlaneVector &v, double angle,
                                        double rate) const;
    [[nodiscard]] MassMomenta momenta(const PlaneVector &p, const PlaneVector &v, double angle,
                                      double rate) const;
};

/// Two tied pendulums, hinged at +-a on a line of the rotor, that turn by equal angles f to
/// opposite sides: together they displace 2 i m l sin(f) exp(i line), line = theta + quarter turns.
struct PendulumPair {
    double mass = 0;    ///< m, kg
    double arm = 0;     ///< l, m
    double pivot = 0;   ///< a, m
    double damping = 0; ///< H1 of one hinge, N m s/rad
    double line = 0;    ///< angle of the line of hinges in the rotor, rad
    double gravity = 0; ///< m/s2

    /// @param angle,rate  f and f'
    [[nodiscard]] MassEquation equation(const SpinState &spin, double angle, double rate) const;
    /// Its moments of momentum and energy. `spin`: dT/dOmega.
    [[nodiscard]] MassMomenta momenta(const SpinState &spin, const PlaneVector &v, double angle,
                                      double rate) const;
    /// Contribution to the torque on the rotor: {alone, per unit of spin acceleration}, y without.
    [[nodiscard]] Eigen::Vector2d torque(const SpinState &spin, double angle, double rate) const;
    /// 2 i m l sin(f) exp(i line): the moment of mass, kg m.
    [[nodiscard]] Eigen::Vector2d offset(const SpinState &spin, double angle) const;
};

} // namespace whirl::balancers

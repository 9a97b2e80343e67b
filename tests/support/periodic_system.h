#pragma once

#include "assembly/discretization.h"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <vector>

namespace whirl::tests {

/// M q'' + D q' + K q = 0 at one instant.
struct Instant {
    Eigen::MatrixXd M, D, K;
};

/// A rotor seen from the fixed frame, whose unsymmetric parts turn with it: matrices periodic in
/// time. Written from the energy of point masses on the rotor, one by one, and of a section with
/// two bending stiffnesses; shares nothing with the matrices in rotating axes but the axisymmetric
/// parts, the bearings and the element matrices.
///
/// Unknowns: the real ones of the discretization in pairs (x, y), then one for each ball (its
/// distance R eps along the race from its place in balance, m) or each tied pair of pendulums.
///
/// A point mass m at radius R and angle g = W t + a adds m R^2 (c'^2 - g'^2 c^2)/2 with
/// c = Re(phi exp(-i g)) to the kinetic energy, so m R^2 e (e . phi'' + 2 W e' . phi') with
/// e = (cos g, sin g) to the equation of the slope.
class PeriodicSystem {
  public:
    /// @param speed        W, also that at which bearing tables are read, rad/s
    /// @param ball_angles  of each balancer, rad in the rotor; not read for pendulums
    PeriodicSystem(const assembly::Discretization &discretization, double speed,
                   const std::vector<std::vector<double>> &ball_angles);

    [[nodiscard]] Instant at(double time) const;
    [[nodiscard]] double speed() const { return _speed; }
    [[nodiscard]] double period() const; ///< of one turn, s
    [[nodiscard]] int size() const;
    /// Real unknowns that turn with the axes; the rest are those of the moving masses.
    [[nodiscard]] int paired() const;

    /// Floquet multipliers of one turn.
    [[nodiscard]] std::vector<std::complex<double>> multipliers(int steps) const;
    /// Largest real part of the Floquet exponents, 1/s.
    [[nodiscard]] double growth(int steps) const;

    /// A moving mass: along its circle, held in the rotor at an angle.
    struct MovingMass {
        double z = 0;         ///< m
        double mass = 0;      ///< kg
        double angle = 0;     ///< rad, in the rotor
        double damping = 0;   ///< N s/m
        double restoring = 0; ///< times W^2, kg: stiffness against the centrifugal field
    };
    [[nodiscard]] const std::vector<MovingMass> &moving() const { return _moving; }

  private:
    /// A point mass that turns with the rotor (`count` of -1: the axisymmetric ring is taken out).
    struct PointMass {
        double z = 0;
        double mass = 0;    ///< kg, on the deflection
        double inertia = 0; ///< m R^2, kg m2
        double angle = 0;
    };
    const assembly::Discretization &_d;
    double _speed;
    Instant _axisymmetric;
    std::vector<PointMass> _points;
    std::vector<MovingMass> _moving;

    void add_points(const model::Balancer &balancer, const std::vector<double> &angles);
    void add_tilt(Instant &out, const PointMass &point, double time) const;
    void add_moving(Instant &out, const MovingMass &mass, int index, double time) const;
    void add_shaft(Instant &out, double time) const;
};

/// exp(l period) of eigenvalues l in rotating axes: multipliers of one turn.
[[nodiscard]] std::vector<std::complex<double>>
exponentials(const std::vector<std::complex<double>> &eigenvalues, double period);

/// For each value of `first` the distance to the nearest one of `second`; the largest of them.
[[nodiscard]] double largest_distance(const std::vector<std::complex<double>> &first,
                                      const std::vector<std::complex<double>> &second);

} // namespace whirl::tests

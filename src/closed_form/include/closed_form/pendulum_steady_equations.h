#pragma once

#include "closed_form/pendulum_balancer.h"

#include <Eigen/Core>
#include <cmath>

namespace whirl::closed_form {

/// Both steady equations in the unknowns (xi, eta) at one speed: per axis
/// force(x) = (1 - R^2) x - R_m R^2 x/sqrt(R_a^2 + x^2), coupled by R H.
struct PendulumSteadyEquations {
    double linear;   ///< 1 - R^2
    double pendulum; ///< R_m R^2
    double pivot;    ///< R_a
    double coupling; ///< R H
    Eigen::Vector2d load;

    PendulumSteadyEquations(const PendulumRotor &rotor, double R)
        : linear(1.0 - R * R), pendulum(rotor.mass_ratio * R * R), pivot(rotor.pivot_ratio),
          coupling(R * rotor.external_damping),
          load(pendulum * rotor.imbalance.real(), pendulum * rotor.imbalance.imag()) {}

    [[nodiscard]] double force(double x) const {
        return linear * x - pendulum * x / std::hypot(pivot, x);
    }
    [[nodiscard]] double slope(double x) const {
        const double length = std::hypot(pivot, x);
        return linear - pendulum * pivot * pivot / (length * length * length);
    }
    [[nodiscard]] Eigen::Vector2d residual(const Eigen::Vector2d &at) const {
        return {force(at[0]) - coupling * at[1] - load[0],
                coupling * at[0] + force(at[1]) - load[1]};
    }
    [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::Vector2d &at) const {
        Eigen::Matrix2d matrix;
        matrix << slope(at[0]), -coupling, coupling, slope(at[1]);
        return matrix;
    }
};

/// The motion of the rotor whose shaft stands there, a root of the equations.
[[nodiscard]] PendulumMotion steady_motion_at(const PendulumRotor &rotor, double speed_ratio,
                                              const Eigen::Vector2d &position);

} // namespace whirl::closed_form

#pragma once

#include "model/excitation.h"
#include "reduction/reduced_rotor.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::simulation {

/// What acts on the rotor from outside over time: forces at stations, and the acceleration of the
/// foundation, which in axes that move with it acts on every mass as a uniform field -a(t).
class Excitation {
  public:
    void add(const reduction::Row &row, const model::StationForce &force);
    /// @param x_load,y_load  under an acceleration in x, and in y: ReducedRotor::mass_load
    /// and its deviation
    void set_base(const reduction::Row &x_load, const reduction::Row &y_load,
                  const model::BaseMotion &base);

    [[nodiscard]] bool none() const { return _forces.empty() && !_base; }
    /// Times at which it jumps or bends, > 0, unordered.
    [[nodiscard]] std::vector<double> jumps() const;
    /// Adds the loads on (Re p; Im p): forces, and -a on the mass that the rotor's mass matrix
    /// holds.
    /// @param piece  a time inside the piece between two jumps that t belongs to
    /// @returns the acceleration of the foundation, m/s2
    Eigen::Vector2d add_loads(double t, double piece, Eigen::VectorXd &loads) const;

  private:
    struct Force {
        reduction::Row row;
        model::StationForce force;
    };
    std::vector<Force> _forces;
    std::optional<model::BaseMotion> _base;
    reduction::Row _x_load, _y_load;

    [[nodiscard]] Eigen::Vector2d base(double t, double piece) const;
};

} // namespace whirl::simulation

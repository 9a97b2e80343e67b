#pragma once

#include "model/case.h"
#include "modes/roots/roots.h"
#include "simulation/moving_parts.h"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace whirl::states {

/// The equations of `simulate` for motions in which all angles are constant and the rotor turns
/// with its deflection as one body, at any speed of a range; and small motions about them, all in
/// axes that turn with the rotor. docs/theory.md, "Steady states".
///
/// Unknowns: (Re u; Im u) of the reduced rotor, then all angles of the balancers in their order.
class SteadyEquations {
  public:
    /// @param fastest  the largest |speed| asked for, rad/s
    /// @throws model::AnalysisFailure where no state is steady in rotating axes, or the equations
    /// have terms that these have not: bearings that differ between directions, balls that touch,
    /// dry friction.
    SteadyEquations(const model::Case &scene, double slowest, double fastest);

    [[nodiscard]] const simulation::MovingParts &parts() const { return _parts; }
    [[nodiscard]] Eigen::Index rotor_unknowns() const { return 2 * _parts.rotor.size(); }
    [[nodiscard]] Eigen::Index unknowns() const { return rotor_unknowns() + _parts.free_angles(); }
    [[nodiscard]] Eigen::Index planes() const { return std::ssize(_parts.planes); }

    /// Something that turns with the rotor deflects it.
    [[nodiscard]] bool driven() const;
    /// The rotor loses energy as it whirls in turning axes.
    [[nodiscard]] bool damped() const { return _damped; }
    /// The rotor with its races is the same from all sides but for what deflects it.
    [[nodiscard]] bool round() const;

    /// Real matrix of the rotor with all that is fixed in it, without the free parts, at rest in
    /// turning axes.
    [[nodiscard]] Eigen::MatrixXd stiffness(double speed) const;
    /// Load of the fixed masses on the rotor.
    [[nodiscard]] Eigen::VectorXd load(double speed) const;
    /// Deflections and slopes of all planes (x, y, slope x, slope y of each) over (Re u; Im u).
    [[nodiscard]] const Eigen::MatrixXd &plane_rows() const { return _rows; }

    /// Deflections of the planes, m.
    [[nodiscard]] std::vector<std::complex<double>> deflections(const Eigen::VectorXd &x) const;

    /// The rotor's deflection with the free parts at these angles: with equal angles a unique one.
    [[nodiscard]] Eigen::VectorXd with_angles(const Eigen::VectorXd &angles, double speed) const;
    /// Angles that walls hold, by their places among all of them, ascending.
    using Held = std::vector<Eigen::Index>;
    /// Towards a root by Newton's method, the shortest step along families.
    /// @param deflection  a size of deflections, m: forces along circles are measured by it
    /// @returns what is left of the equations over the sizes of their terms
    double refine(Eigen::VectorXd &x, double speed, double deflection, const Held &held = {}) const;

    /// Torque along an angle, and the size of the terms that it is a sum of, N m.
    struct Push {
        double torque, size;
    };
    [[nodiscard]] std::vector<Push> pushes(const Eigen::VectorXd &x, double speed,
                                           double deflection) const;

    /// Small motions about a state: M q'' + D q' + K q = 0; what is held has none.
    [[nodiscard]] modes::DenseQuadratic<double> about(const Eigen::VectorXd &x, double speed,
                                                      const Held &held = {}) const;

  private:
    simulation::MovingParts _parts;
    Eigen::MatrixXd _rows; ///< 4P x 2r
    bool _damped = false;
    bool _round_races = true;

    struct Balance {
        Eigen::VectorXd left;  ///< what is not in balance
        Eigen::VectorXd sizes; ///< of the terms of each
        modes::DenseQuadratic<double> motions;
    };
    /// What is wanted of small motions: their stiffness, which Newton's method takes, or all.
    enum class Motions { stiffness, all };
    [[nodiscard]] Balance balance(const Eigen::VectorXd &x, double speed, double deflection,
                                  Motions motions) const;
    /// Calls `add` for each fixed mass that tilts with its plane, with the rows of that plane, 4 x
    /// 2r, and what the mass adds there.
    void for_tilting_masses(double speed,
                            const std::function<void(const Eigen::MatrixXd &rows,
                                                     const balancers::AtRest &rest)> &add) const;
};

} // namespace whirl::states

#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "linalg/harmonic_solve.h"
#include "model/rotor.h"
#include "results/balance.h"
#include "results/sentence.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::criterion {

/// Where the balancers stand at a speed (rad/s): none, nowhere in balance.
using PlacesOverSpeed = std::function<std::optional<balancers::Arrangement>(double)>;

/// The motions of light balancers about their balanced position, to first order in their mass:
/// slow ones against the rotor, which answers them as if they stood still but for a share of their
/// rate l, with the acceleration B(i W) + l B'(i W) of the planes under forward imbalances, B(s) =
/// s^4 H(s). Of a rotor that is axisymmetric without them, on any bearings; docs/theory.md, "First
/// order in the balancers' mass".
class SlowMotions {
  public:
    /// @param rotor  its free balancers count with their masses and mean inertias too
    SlowMotions(model::Rotor rotor, PlacesOverSpeed places, int order);

    /// All roots l at a spin speed (rad/s), 1/s.
    /// @param drag  times that of the case
    /// @throws linalg::SolverError
    [[nodiscard]] Eigen::VectorXcd roots(double speed, double drag = 1);
    /// The largest real part of a root, 1/s, with what rounding can make of zero added: negative
    /// where all die out. The speed where there is no balanced position.
    [[nodiscard]] double growth(double speed);
    /// How far it can be off by rounding, 1/s.
    [[nodiscard]] double rounding(double speed);
    /// The least drag, times that of the case, from which on all roots die out however large it is;
    /// 0: from below a millionth of the drag that is as large as all else in the equations, which
    /// is not told from none; none where they do not.
    [[nodiscard]] std::optional<double> least_drag(double speed);

  private:
    /// z' = (rest + drag * of_drag) z, z the displacements of the balancers' parts that matter,
    /// times a rate, and their velocities.
    struct Equations {
        Eigen::MatrixXd rest, of_drag;
    };

    model::Rotor _rotor;
    PlacesOverSpeed _places;
    std::unique_ptr<assembly::Discretization> _mesh;
    std::optional<linalg::HarmonicSolver> _solver; ///< of the bearings as at the last speed
    linalg::HarmonicTerms _terms;
    Eigen::MatrixXcd _forward; ///< forces that turn with the rotor, (1, -i)/sqrt 2 a plane
    std::optional<double> _speed;
    std::optional<Equations> _equations; ///< at that speed; none: no balanced position

    /// B and B' between the planes of the balancers, 1/kg and s/kg.
    struct Accelerations {
        Eigen::MatrixXcd B, rate;
    };
    [[nodiscard]] Accelerations accelerations(double speed);
    void set_bearings(double speed);
    [[nodiscard]] const std::optional<Equations> &at(double speed);
};

/// Bands between these speeds where all slow motions die out, with the errors of their ends by the
/// same on elements of a higher order, and the least drag over the speeds.
/// @param seeds    speeds between which growth is looked at closer where it bends
/// @param notes    what there is to say
/// @throws linalg::SolverError
[[nodiscard]] results::FirstOrder first_order(const model::Rotor &rotor,
                                              const PlacesOverSpeed &places, int order,
                                              std::vector<double> seeds,
                                              const std::vector<double> &speeds,
                                              std::vector<results::Sentence> &notes);

} // namespace whirl::criterion

#pragma once

#include "modes/roots/branches.h"
#include "synchronous/problem.h"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace whirl::synchronous {

/// Planar shapes on which the synchronous motions of a rotor are described, and of others of the
/// same mesh too, which differ from it in their supports or masses: a critical speed map, random
/// samples.
struct SharedShapes {
    Eigen::MatrixXd shapes; ///< N x r
    double reach = 0;       ///< they describe motions up to that frequency, rad/s
};

/// Modes at rest and what bends the rotor where something acts (reduction::PlanarShapes); all
/// unknowns of a small rotor or a rigid shaft.
/// @param top    that they reach at the least, rad/s
/// @param modes  at rest, at the least
/// @throws linalg::SolverError where the modes at rest cannot be found
[[nodiscard]] SharedShapes synchronous_shapes(const assembly::Discretization &rotor, double top,
                                              int modes);

/// All unknowns: nothing is missing.
[[nodiscard]] SharedShapes all_shapes(const assembly::Discretization &rotor, double top);

/// The synchronous problem on planar shapes, each term projected once: all its roots at any speed
/// by one dense decomposition.
class ReducedSynchronous {
  public:
    /// @param problem  must outlive this
    /// @param shapes   N x r
    ReducedSynchronous(const SynchronousProblem &problem, const Eigen::MatrixXd &shapes);

    /// All roots with their rates dl/ds, bearings as at a speed s between the rows `piece` and
    /// `piece` + 1 of the tables (0 of a constant problem); without the motions that no support
    /// resists. Of a conservative problem they are exactly on the axes, where they follow from its
    /// energies.
    /// @throws linalg::SolverError
    [[nodiscard]] modes::RootsAt at(double speed, std::size_t piece) const;

    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &shape) const;
    /// Up to which |l| all roots so far were resolved, 1/s: those beyond may be lost in rounding.
    [[nodiscard]] double known_to() const { return _known_to; }
    /// All unknowns are left: nothing is missing.
    [[nodiscard]] bool whole() const { return _shapes.cols() == _shapes.rows(); }

  private:
    using Dense = modes::DenseQuadratic<std::complex<double>>;
    const SynchronousProblem &_problem;
    Eigen::MatrixXd _shapes; ///< over the unknowns of the problem
    Dense _first;
    std::vector<Dense> _changes; ///< of D and K
    double _scale;               ///< of the slow motions on the supports, 1/s
    std::vector<int> _zeros;     ///< roots at zero with the bearings as at each row
    /// At the highest speed so far, without rates: at a row they are asked for both pieces that
    /// meet there, in which those alone differ.
    mutable std::optional<modes::RootsAt> _highest;
    mutable double _known_to = std::numeric_limits<double>::infinity();

    [[nodiscard]] Eigen::MatrixXcd projected(const ComplexQuadratic::Sparse &A) const;
    [[nodiscard]] int zeros_at(double speed, std::size_t piece) const;
    [[nodiscard]] std::vector<modes::Root> conservative(const Dense &at, int zeros) const;
    [[nodiscard]] std::vector<modes::Root> any(const Dense &at, int zeros) const;
};

} // namespace whirl::synchronous

#pragma once

#include "assembly/rotating_system.h"
#include "assembly/system.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace whirl::reduction {

/// Systems over all planar unknowns, in pairs (x, y), become systems over the amplitudes of shapes
/// in pairs (x, y). What is attached behind the planar unknowns (balls, pendulums) keeps its own.
/// Symmetric matrices become symmetric ones and skew ones skew, to the last digit: what conserves
/// energy goes on doing so.
class Projection {
  public:
    /// @param shapes  N x r
    explicit Projection(const Eigen::MatrixXd &shapes) : _shapes(shapes) {}

    [[nodiscard]] linalg::Matrix of(const linalg::Matrix &A) const;
    /// @throws std::invalid_argument for fewer rows than pairs of planar unknowns: a planar matrix
    [[nodiscard]] Eigen::MatrixXd of(const Eigen::SparseMatrix<double> &A) const;
    [[nodiscard]] assembly::FixedSystem of(const assembly::FixedSystem &system) const;
    [[nodiscard]] assembly::RotatingSystem of(const assembly::RotatingSystem &system) const;
    [[nodiscard]] assembly::PeriodicSupports of(const assembly::PeriodicSupports &supports) const;

    /// Loads on all unknowns, a column each, as loads on the amplitudes.
    [[nodiscard]] Eigen::MatrixXd loads(const Eigen::MatrixXd &columns) const;

    /// A vector over the amplitudes as one over all unknowns.
    [[nodiscard]] Eigen::VectorXcd lifted(const Eigen::VectorXcd &reduced) const;

  private:
    const Eigen::MatrixXd &_shapes;
};

} // namespace whirl::reduction

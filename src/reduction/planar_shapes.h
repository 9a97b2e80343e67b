#pragma once

#include "assembly/discretization.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>

#include <vector>

namespace whirl::reduction {

/// Shapes of a shaft in one plane that describe its slow motions: the lowest modes at rest, and
/// the deflections under unit forces and moments wherever something acts that these do not know
/// (bearings, gyroscopic moments of discs, balancers, anisotropies). Modes alone converge slowly
/// there (R. R. Craig, A. J. Kurdila, Fundamentals of Structural Dynamics, 2nd ed., chapter 17).
class PlanarShapes {
  public:
    /// @param discretization  of an elastic shaft
    /// @param top             frequency up to which motions are to be described, rad/s
    /// @param modes           at rest, at the least
    /// @throws linalg::SolverError where the modes at rest cannot be found
    PlanarShapes(const assembly::Discretization &discretization, double top,
                 int modes = fewest_modes);

    /// The shapes that these columns (N entries each) span, and no more; orthonormal under the
    /// diagonal of that matrix.
    PlanarShapes(const assembly::Discretization &discretization, double top,
                 const Eigen::MatrixXd &columns);

    /// N x r, orthonormal under K + top^2 M with the mean stiffness of the bearings.
    [[nodiscard]] const Eigen::MatrixXd &matrix() const { return _shapes; }
    /// K + top^2 M.
    [[nodiscard]] const Eigen::SparseMatrix<double> &metric() const { return _H; }

    /// Takes in what is new of the columns (N entries each).
    /// @param newness  part of a column that must be new, of its length under K + top^2 M
    void add(const Eigen::MatrixXd &columns, double newness);
    /// The same with as few shapes as may be: first the column of which most is new.
    void add_newest_first(Eigen::MatrixXd columns, double newness);

    /// Takes in what is new of columns whose lengths under K + top^2 M count, the longest first,
    /// until what is left of each is shorter than that.
    void add_longest_first(Eigen::MatrixXd columns, double shortest);

    /// Combinations of the shapes, those that carry most of some motions last, each motion counted
    /// by its largest part: eigenpairs of the sum of their squares over the amplitudes.
    /// @param parts  planar parts of a motion, a column each
    [[nodiscard]] Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>
    principal(const std::vector<const Eigen::MatrixXd *> &parts) const;

    /// Only these combinations of the shapes, r x s with orthonormal columns, are kept.
    void keep(const Eigen::MatrixXd &combinations);

    /// Takes in the deflections, held by K + top^2 M, under unit loads that work on these
    /// quantities.
    /// @throws linalg::SolverError where the bearings push away
    void add_static(const std::vector<assembly::Combination> &loaded);

  private:
    /// Two rigid motions of a plane and four of bending, whatever the range.
    static constexpr int fewest_modes = 6;
    Eigen::SparseMatrix<double> _H; ///< K + top^2 M
    Eigen::MatrixXd _shapes;
};

/// Planar shapes of a motion over N planar unknowns: of x and y, real and imaginary, of all terms
/// of a series. N x 4 for each term.
/// @param vector  terms one after the other, each of `term` real unknowns
[[nodiscard]] Eigen::MatrixXd planar_parts(const Eigen::VectorXcd &vector, Eigen::Index N,
                                           Eigen::Index term);

} // namespace whirl::reduction

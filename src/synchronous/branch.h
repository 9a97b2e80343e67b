#pragma once

#include "linalg/sparse_factor.h"
#include "synchronous/problem.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::synchronous {

/// An eigenvalue of a problem whose coefficients are linear in s, and what becomes of it.
struct BranchPoint {
    std::complex<double> eigenvalue; ///< l, 1/s
    std::complex<double> slope;      ///< dl/ds
    Eigen::VectorXcd shape;          ///< largest modulus 1
    double residual = 0;             ///< relative change of l that would explain what is left
    double rounding = 0;             ///< relative error that rounding of the entries can cause
    bool pushes_down = true;         ///< x^H M x > 0
};

/// Synchronous problem between two rows of bearing tables, linear in the speed s at which they are
/// read.
class LinearSynchronous {
  public:
    LinearSynchronous(ComplexQuadratic from, ComplexQuadratic to, double s_from, double s_to);

    /// The eigenvalue near `l` with a vector near `x`, by two-sided inverse iteration: right and
    /// left vectors x, y, l -> l - y^H Q x / y^H Q' x, dl/ds = -y^H (dQ/ds) x / y^H Q' x.
    /// @param tolerance  relative, of the last step of l
    /// @returns none where it does not settle.
    [[nodiscard]] std::optional<BranchPoint> point(double s, std::complex<double> l,
                                                   const Eigen::VectorXcd &x,
                                                   double tolerance = 1e-13) const;

    /// The speed at which Im l(s) = s, from a point near it; none where Newton's method does not
    /// settle or leaves the piece.
    [[nodiscard]] std::optional<BranchPoint> standing(double s, std::complex<double> l,
                                                      const Eigen::VectorXcd &x) const;

  private:
    ComplexQuadratic _from, _to; ///< of scaled unknowns
    Eigen::VectorXd _scale;      ///< of the unknowns
    ComplexQuadratic::Sparse _D_slope, _K_slope;
    double _s_from, _s_to;
    mutable linalg::SparseFactor<std::complex<double>> _factors; ///< of one pattern
};

/// The synchronous roots of the whole rotor, each from one near it, l = i s with the bearings as at
/// s; the matrices between two rows are made once.
class WholeRoots {
  public:
    /// @param problem  must outlive this
    explicit WholeRoots(const SynchronousProblem &problem)
        : _problem(problem), _pieces(problem.rows().size() + 1) {}

    /// The root near `l` where the bearings are as at about `s`; none where there is none to which
    /// the iteration goes.
    [[nodiscard]] std::optional<BranchPoint> near(double s, std::complex<double> l,
                                                  const Eigen::VectorXcd &x) const;

  private:
    const SynchronousProblem &_problem;
    /// Below the first row, between rows, above the last one.
    mutable std::vector<std::unique_ptr<LinearSynchronous>> _pieces;

    [[nodiscard]] const LinearSynchronous &piece(std::size_t i) const;
    [[nodiscard]] std::size_t piece_of(double speed) const;
    [[nodiscard]] std::optional<BranchPoint>
    in_piece(std::size_t i, double s, std::complex<double> l, const Eigen::VectorXcd &x) const;
};

} // namespace whirl::synchronous

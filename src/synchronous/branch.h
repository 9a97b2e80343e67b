#pragma once

#include "modes/roots/whole_pencil.h"
#include "synchronous/problem.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <complex>
#include <optional>

namespace whirl::synchronous {

/// A synchronous root of the whole rotor, and what becomes of it with the speed s at which the
/// bearing tables are read.
struct BranchPoint {
    std::complex<double> eigenvalue; ///< l, 1/s; with tables Im l = s
    std::complex<double> slope;      ///< dl/ds
    Eigen::VectorXcd shape;          ///< largest modulus 1
    double residual = 0;             ///< relative change of l that would explain what is left
    double rounding = 0;             ///< relative error that rounding of the entries can cause
    bool pushes_down = true;         ///< x^H M x > 0

    /// Of a conservative problem: as W grows, an eigenvalue of K(W) - W^2 M falls through zero.
    [[nodiscard]] bool downwards() const { return pushes_down == (slope.imag() < 1); }
};

/// The synchronous roots of the whole rotor, each from one near it: l with the bearings as at Im l.
class WholeRoots {
  public:
    /// @param problem  must outlive this
    explicit WholeRoots(const SynchronousProblem &problem);

    /// The root near `l` with a vector near `x`; none where the iteration goes to none.
    /// Newton's method for Im l(s) = s, with the root and its rate at each s.
    [[nodiscard]] std::optional<BranchPoint> near(std::complex<double> l,
                                                  const Eigen::VectorXcd &x) const;
    /// The same from what x has across the vector of a root, by the mass matrix; none where that is
    /// hardly anything.
    [[nodiscard]] std::optional<BranchPoint> near_across(std::complex<double> l,
                                                         const Eigen::VectorXcd &x,
                                                         const Eigen::VectorXcd &root) const;

    /// Negative eigenvalues of K(W) - W^2 M of a conservative problem.
    /// @throws linalg::SolverError where a pivot is zero
    [[nodiscard]] int negative_eigenvalues(double speed) const;

  private:
    using Complex = std::complex<double>;

    const SynchronousProblem &_problem;
    mutable modes::WholePencil<Complex> _pencil;
    mutable bool _is_set = false; ///< to a problem that is constant
    mutable Eigen::SimplicialLDLT<ComplexQuadratic::Sparse> _inertia;

    /// A piece of the tables.
    struct Piece {
        ComplexQuadratic first, rate; ///< at its beginning, and of D and K over speed
        double from = 0, to = 0;      ///< rad/s; equal: constant

        [[nodiscard]] ComplexQuadratic at(double speed) const;
    };
    [[nodiscard]] std::size_t piece_of(double speed) const;
    [[nodiscard]] Piece piece(std::size_t i) const;
    [[nodiscard]] std::optional<BranchPoint> in_piece(const Piece &piece, Complex l,
                                                      const Eigen::VectorXcd &x) const;
};

} // namespace whirl::synchronous

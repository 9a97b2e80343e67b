#pragma once

#include "linalg/sparse_factor.h"
#include "synchronous/problem.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <complex>
#include <optional>
#include <utility>
#include <vector>

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
/// All matrices are kept on one pattern, whose order of elimination is found once.
class WholeRoots {
  public:
    /// @param problem  must outlive this
    explicit WholeRoots(const SynchronousProblem &problem);

    /// The root near `l` with a vector near `x`; none where the iteration goes to none.
    /// Two-sided Rayleigh quotient iteration with right and left vectors x, y: Newton's method for
    /// y^H Q(l, s) x = 0, and Im l = s as two real equations, with better vectors at each step.
    [[nodiscard]] std::optional<BranchPoint> near(std::complex<double> l,
                                                  const Eigen::VectorXcd &x) const;

    /// Negative eigenvalues of K(W) - W^2 M of a conservative problem.
    /// @throws linalg::SolverError where a pivot is zero
    [[nodiscard]] int negative_eigenvalues(double speed) const;

  private:
    using Complex = std::complex<double>;
    using Entries = std::vector<std::pair<Eigen::Index, Complex>>; ///< place, value

    const SynchronousProblem &_problem;
    Eigen::VectorXd _scale; ///< of the unknowns: the matrices are those of scaled ones
    Eigen::VectorXcd _M, _D, _K;
    struct Change {
        Entries D, K;
    };
    std::vector<Change> _changes; ///< of D and K at the rows
    mutable ComplexQuadratic::Sparse _Q;
    mutable linalg::SparseFactor<Complex> _factors;
    mutable Eigen::SimplicialLDLT<ComplexQuadratic::Sparse> _inertia;

    /// D and K at a speed in a piece of the tables, and their rates.
    struct At {
        Eigen::VectorXcd D, K;
        Entries D_rate, K_rate;
        double from = 0, to = 0; ///< rad/s; equal: constant
    };
    [[nodiscard]] Entries entries_of(const ComplexQuadratic::Sparse &A) const;
    [[nodiscard]] std::size_t piece_of(double speed) const;
    [[nodiscard]] At piece(std::size_t i) const;
    void read_at(const At &piece, double speed, At &out) const;
    [[nodiscard]] std::optional<BranchPoint> in_piece(const At &piece, Complex l,
                                                      const Eigen::VectorXcd &x) const;
    [[nodiscard]] bool factorize(const At &at, Complex l) const;
    [[nodiscard]] Complex product(const Eigen::VectorXcd &y, const Eigen::VectorXcd &values,
                                  const Eigen::VectorXcd &x) const;
    [[nodiscard]] Complex product(const Eigen::VectorXcd &y, const Entries &entries,
                                  const Eigen::VectorXcd &x) const;
    [[nodiscard]] double rounding(const At &at, Complex l, const Eigen::VectorXcd &x,
                                  const Eigen::VectorXcd &y, Complex derivative) const;
};

} // namespace whirl::synchronous

#pragma once

#include "modes/following/symmetric_problem.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::modes {

/// An eigenpair of a symmetric problem at one speed, with what the vector makes of the matrices.
struct SymmetricPair {
    std::complex<double> value;      ///< l, 1/s
    Eigen::VectorXcd vector;         ///< x
    std::complex<double> rate;       ///< dl/dspeed
    std::complex<double> derivative; ///< x^T Q'(l) x
    double error = 0;                ///< of l, relative: what the residual leaves
    double rounding = 0;             ///< of l, relative: what rounding of the entries can cause
    bool solved = false;             ///< by inverse iteration, not by a good guess alone
    Eigen::VectorXcd Mx, Kx;
};

/// Finds eigenpairs of the problem at one speed from guesses.
class EigenpairRefinement {
  public:
    EigenpairRefinement(const SymmetricProblem &problem, double speed)
        : _problem(problem), _speed(speed) {}

    /// Rayleigh quotient iteration until the error is small, cubic with a symmetric matrix: none
    /// where the guess is good enough. With left vector and right vector the same the Rayleigh
    /// quotient has an error of second order, r^T Q(l)^-1 r / (x^T Q'(l) x) with the residual r.
    /// (K + |l|^2 M)^-1 over the relative distance to the other eigenvalues takes the place of
    /// Q^-1.
    /// @param distance  from the eigenvalue to the next ones, relative
    /// @returns false where it does not settle
    [[nodiscard]] bool refine(SymmetricPair &pair, double distance);

    /// The eigenpair nearest a value, from no vector.
    [[nodiscard]] SymmetricPair nearest(std::complex<double> value);

    /// Argument of det Q(z), the eigenvalues given divided out.
    [[nodiscard]] double phase(std::complex<double> z, const std::vector<SymmetricPair> &without);

  private:
    using Complex = std::complex<double>;
    const SymmetricProblem &_problem;
    double _speed;
    SymmetricProblem::Products _of;
    Complex _xMx, _xDx, _xKx;

    void multiply(const Eigen::VectorXcd &x);
    [[nodiscard]] Complex rayleigh(Complex near) const;
    [[nodiscard]] double error(Complex l, double distance) const;
    [[nodiscard]] linalg::SymmetricFactor &factorize(Complex l);
    void inverse_step(SymmetricPair &pair);
    void fill(SymmetricPair &pair) const;
};

} // namespace whirl::modes

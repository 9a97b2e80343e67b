#pragma once

#include "linalg/matrix.h"
#include "linalg/sparse_factor.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <complex>

namespace whirl::linalg {

/// M q'' + (C + s G) q' + (K + s Kc) q = f, real, all matrices of one size.
struct HarmonicTerms {
    Matrix M, C, G, K, Kc;
};

/// Solves A(s) q = f, A(s) = K + s Kc - s^2 M + i s (C + s G), for many speeds s: the steady
/// motion Re(q exp(i s t)) of M q'' + (C + s G) q' + (K + s Kc) q = Re(f exp(i s t)).
///
/// The pattern of nonzeros is that of all speeds together, so that KLU (SuiteSparse) orders and
/// analyses it once.
class HarmonicSolver {
  public:
    explicit HarmonicSolver(const HarmonicTerms &terms);

    /// Complex displacements, one column for each column of forces.
    /// @param forces  one load case a column
    /// @throws SolverError where A(speed) is singular or the residual exceeds 1e-8: the largest
    ///         |f - A q| over the largest |A| |q| + |f|.
    [[nodiscard]] Eigen::MatrixXcd solve(double speed, const Eigen::MatrixXcd &forces);

    /// Estimated relative error of a solution at the speed of the last one by rounding of the
    /// entries of A, in comparable unknowns (unit_scales.h); large where A is singular (an undamped
    /// resonance).
    [[nodiscard]] double rounding(const Eigen::VectorXcd &forces,
                                  const Eigen::VectorXcd &displacements) const;

    /// |q|^T |A| |q| at the speed of the last solution, |A| the sum of the moduli of the terms.
    [[nodiscard]] double absolute_form(const Eigen::VectorXcd &displacements) const;

    /// Nothing takes energy out or feeds it in.
    [[nodiscard]] bool conserves() const;

    /// Complex unknowns.
    [[nodiscard]] int size() const { return static_cast<int>(_scales.size()); }

  private:
    using Sparse = Eigen::SparseMatrix<std::complex<double>>;
    enum Factor { one, speed_once, minus_speed_squared, i_speed, i_speed_squared, factor_count };

    Eigen::VectorXd _scales;                         ///< of the unknowns, powers of two
    std::array<Eigen::ArrayXd, factor_count> _terms; ///< entries on the pattern of all, scaled
    Sparse _A;
    Sparse _sizes; ///< real and imaginary part: moduli of the real and of the imaginary terms
    SparseFactor<std::complex<double>> _lu;

    void set(double speed);
    [[nodiscard]] Eigen::VectorXcd sizes_of(const Eigen::VectorXcd &f,
                                            const Eigen::VectorXcd &q) const;
};

} // namespace whirl::linalg

#pragma once

#include "synchronous/general.h"

#include <optional>

namespace whirl::synchronous {

/// An eigenvalue of a problem whose coefficients are linear in s, and what becomes of it.
struct BranchPoint {
    std::complex<double> eigenvalue; ///< l, 1/s
    std::complex<double> slope;      ///< dl/ds
    Eigen::VectorXcd shape;          ///< largest modulus 1
    double residual = 0;             ///< relative change of l that would explain what is left
    double rounding = 0;             ///< relative error that rounding of the entries can cause
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
};

} // namespace whirl::synchronous

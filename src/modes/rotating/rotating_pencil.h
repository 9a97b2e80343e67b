#pragma once

#include "linalg/eigenpair.h"
#include "linalg/quadratic/quadratic_pattern.h"
#include "linalg/sparse_factor.h"
#include "modes/form_matrices.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <optional>
#include <utility>

namespace whirl::modes {

/// Q(l) = l^2 M + l D + K of a rotor in rotating axes, at all speeds on one pattern of entries: the
/// order of elimination is found once.
class RotatingPencil {
  public:
    /// @param matrices  form rotating
    /// @param slow      of the order of the motions on the supports, 1/s
    RotatingPencil(FormMatrices matrices, double slow)
        : _matrices(std::move(matrices)), _stiffness(_matrices.at(0).K.diagonal()), _slow(slow) {}

    /// @returns false where the matrix at the shift that residuals are measured from is singular
    [[nodiscard]] bool set_speed(double speed);

    /// The eigenpair next to one that is nearly one, by Rayleigh quotient iteration with right and
    /// left vectors (B. N. Parlett, Mathematics of Computation 28, 1974), with its residual and
    /// rounding as linalg::assess_condition has them. A real value stays real.
    /// @param farthest  that it may go away, in parts of its value
    /// @returns with its left vector; nothing where it does not converge or goes away
    [[nodiscard]] std::optional<linalg::ComplexPair> refined(const linalg::ComplexPair &guess,
                                                             double farthest = 1e-3);

  private:
    using Sparse = Eigen::SparseMatrix<double>;
    using Complex = std::complex<double>;

    FormMatrices _matrices;
    Eigen::VectorXd _stiffness; ///< of each unknown at rest
    double _slow;
    double _speed = 0;
    double _shift = 0;
    Eigen::VectorXd _scales;
    Sparse _M, _D, _K;                               ///< at the speed, scaled
    std::optional<linalg::QuadraticPattern> _values; ///< the same
    linalg::SparseFactor<double> _shifted;
    linalg::SparseFactor<double> _real{true}; ///< with the pivots of the matrix before
    linalg::SparseFactor<Complex> _complex{true};

    /// (2 l M + D) x and Q(l) x.
    struct Products {
        Eigen::VectorXcd slope, residual;
    };
    [[nodiscard]] Products times(Complex l, const Eigen::VectorXcd &x) const;
    /// Factors of Q(l), real ones of a real l.
    [[nodiscard]] bool factorize(Complex l);
    void solve(bool real, bool transposed, Eigen::VectorXcd &b) const;
    [[nodiscard]] std::optional<linalg::ComplexPair> iterated(const linalg::ComplexPair &guess,
                                                              double farthest);
    [[nodiscard]] bool iterate(Complex l, bool first, linalg::ComplexPair &pair);
    [[nodiscard]] double shifted_norm(const Eigen::VectorXcd &b) const;
};

} // namespace whirl::modes

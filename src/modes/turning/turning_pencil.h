#pragma once

#include "assembly/rotating_system.h"
#include "linalg/eigenpair.h"
#include "linalg/sparse_factor.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <complex>
#include <optional>

namespace whirl::modes {

/// Q(l) = l^2 M + l (C + speed Cs) + K + speed Ks + speed^2 Kss of a rotor in rotating axes, all
/// matrices on one pattern of entries: the order of elimination is found once.
class TurningPencil {
  public:
    /// @param slow  of the order of the motions on the supports, 1/s
    TurningPencil(const assembly::RotatingSystem &system, double slow);

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
    enum Part { mass, damping, damping_turned, stiffness, stiffness_turned, stiffness_twice };
    static constexpr int parts = 6;

    Sparse _pattern;
    std::array<Eigen::VectorXd, parts> _values; ///< on the pattern
    Eigen::VectorXd _mass_diagonal, _stiffness_diagonal;
    double _slow;
    double _speed = 0;
    double _shift = 0;
    Eigen::VectorXd _scales;
    Eigen::VectorXd _M, _D, _K; ///< at the speed, scaled
    linalg::SparseFactor<double> _shifted;
    linalg::SparseFactor<double> _real{true}; ///< with the pivots of the matrix before
    linalg::SparseFactor<Complex> _complex{true};
    Sparse _real_Q;
    Eigen::SparseMatrix<Complex> _complex_Q;

    /// (2 l M + D) x and Q(l) x.
    struct Products {
        Eigen::VectorXcd slope, residual;
    };
    [[nodiscard]] Products times(Complex l, const Eigen::VectorXcd &x) const;
    [[nodiscard]] Eigen::VectorXcd slope_transposed(Complex l, const Eigen::VectorXcd &y) const;
    /// Factors of Q(l), real ones of a real l.
    [[nodiscard]] bool factorize(Complex l);
    void solve(bool real, bool transposed, Eigen::VectorXcd &b) const;
    [[nodiscard]] std::optional<linalg::ComplexPair> iterated(const linalg::ComplexPair &guess,
                                                              double farthest);
    [[nodiscard]] bool iterate(Complex l, bool first, linalg::ComplexPair &pair);
    [[nodiscard]] double shifted_norm(const Eigen::VectorXcd &b) const;
    [[nodiscard]] double entries(double l, const Eigen::VectorXcd &y,
                                 const Eigen::VectorXcd &x) const;
};

} // namespace whirl::modes

#pragma once

#include "linalg/dense/general_eigen.h"
#include "periodic/system.h"

#include <Eigen/Core>

#include <complex>
#include <optional>

namespace whirl::periodic {

/// A free motion exp(l t) sum_k z_k exp(2 i k speed t) as a root of Hill's series.
struct SeriesMotion {
    std::complex<double> value; ///< l, 1/s
    Eigen::MatrixXcd right;     ///< states (q, q'), z_-N, ..., z_N: 2n x (2N + 1)
    Eigen::MatrixXcd left;      ///< of the adjoint equations, as large
};

/// Hill's series of a system at one speed in coordinates of the modes of its steady part, z_k = R
/// a_k:
///
///     l a_k = (s - 2 i k speed) a_k - L B f_k,   f_k = S_+ Y R a_k-1 + S_- Y R a_k+1,
///
/// s the eigenvalues of the steady part, R and L its right and left vectors, S_+ and S_- how the
/// periodic supports act back with exp(2 i speed t) and its conjugate. The supports have few
/// places: solving with a given l leaves a chain of systems of their number, one for each term,
/// however many terms there are. Nothing is left out of the system.
class ModalSeries {
  public:
    /// @param speed  not zero, rad/s
    /// @throws linalg::SolverError where the modes of the steady part are not to be had (no mass,
    /// or one of them defective)
    ModalSeries(const System &system, double speed);

    /// Two-sided Rayleigh quotient iteration, with as many terms as leave nothing at the ends.
    /// @param guess  states as of a system with the same unknowns; its value counts where it has no
    ///               left vectors
    /// @returns nothing where it does not settle, or settles on another motion
    [[nodiscard]] std::optional<SeriesMotion> next_to(const SeriesMotion &guess) const;

  private:
    using Complex = std::complex<double>;
    double _speed;
    Eigen::VectorXd _weights;    ///< of the entries of a state
    Eigen::VectorXcd _steady;    ///< s
    Eigen::MatrixXcd _R, _L;     ///< of weighted states; L R = 1
    Eigen::MatrixXcd _acts;      ///< L B
    Eigen::MatrixXcd _seen;      ///< Y R
    Eigen::MatrixXcd _up, _down; ///< S_+, S_-

    struct Chain;
    struct Settled;
    /// @throws linalg::SolverError where one of them is defective
    void take_modes(const linalg::GeneralEigen &found);
    [[nodiscard]] Eigen::MatrixXcd solve(Complex l, const Eigen::MatrixXcd &right) const;
    [[nodiscard]] Eigen::MatrixXcd solve_adjoint(Complex l, const Eigen::MatrixXcd &right) const;
    [[nodiscard]] Complex quotient(const Eigen::MatrixXcd &left, const Eigen::MatrixXcd &a) const;
    [[nodiscard]] std::optional<SeriesMotion> whole(const Settled &found) const;
    [[nodiscard]] std::optional<Settled> settled(Eigen::MatrixXcd a, Eigen::MatrixXcd b) const;
};

} // namespace whirl::periodic

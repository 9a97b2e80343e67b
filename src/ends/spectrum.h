#pragma once

#include "ends/rotor_pieces.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::ends {

/// An eigenvalue l of a motion exp(l t) at one spin speed.
struct Root {
    std::complex<double> value;   ///< l, 1/s
    std::complex<double> rate;    ///< dl/dspeed
    double noise = 0;             ///< how far rounding can move Re l, 1/s
    bool sharp = false;           ///< no more than that of the matrix entries: by inverse iteration
    Eigen::VectorXcd right, left; ///< Q(l) right = 0, left^H Q(l) = 0
    std::complex<double> slope;   ///< left^H Q'(l) right

    /// 1 grows, -1 dies out, 0: not to be told from neither.
    [[nodiscard]] int sign() const {
        return value.real() > noise ? 1 : value.real() < -noise ? -1 : 0;
    }
};

/// All eigenvalues of a rotor at one speed, both conjugates, but those that are zero at every
/// speed.
struct Spectrum {
    double speed = 0; ///< rad/s
    std::vector<Root> roots;
    DenseProblem problem; ///< whose roots they are

    [[nodiscard]] int growing() const;
    /// The root next to a value.
    [[nodiscard]] const Root &nearest(std::complex<double> value) const;
};

/// @param shift  positive, of the order of the slow motions, 1/s
/// @param zeros  eigenvalues known to be zero: the least ones are left out
/// @throws linalg::SolverError
[[nodiscard]] Spectrum all_roots(const DenseProblem &problem, double speed, double shift,
                                 int zeros);

} // namespace whirl::ends

#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace whirl::modes {

/// Q(l) = l^2 M + l D + K of a reduced rotor at one speed, and its change with the speed, dense.
template <class Scalar> struct DenseQuadratic {
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    Matrix M, D, K;
    Matrix D_rate, K_rate; ///< empty: the rates of its roots are not asked for
};

/// An eigenvalue l of a motion exp(l t) at one spin speed.
struct Root {
    std::complex<double> value;   ///< l, 1/s
    std::complex<double> rate;    ///< dl/dspeed
    double noise = 0;             ///< how far rounding can move Re l, 1/s
    bool sharp = false;           ///< no more than that of the matrix entries: by inverse iteration
    Eigen::VectorXcd right, left; ///< Q(l) right = 0, left^H Q(l) = 0
    std::complex<double> slope;   ///< left^H Q'(l) right

    /// 1 grows, -1 dies out, 0: neither within rounding.
    [[nodiscard]] int sign() const {
        return value.real() > noise ? 1 : value.real() < -noise ? -1 : 0;
    }
};

/// All eigenvalues, of a real problem both conjugates, but those that are zero at every speed.
/// @param shift  positive, of the order of the slow motions, 1/s
/// @param zeros  eigenvalues known to be zero: the least ones are left out
/// @throws linalg::SolverError
template <class Scalar>
[[nodiscard]] std::vector<Root> all_roots(const DenseQuadratic<Scalar> &problem, double shift,
                                          int zeros);

/// The same, by modulus. Where rounding leaves fewer than ten digits of some of the `lowest` that
/// are far from the shift, as of a shaft nearly without mass beside its discs on their supports,
/// these and the faster ones are found from a shift next to them.
template <class Scalar>
[[nodiscard]] std::vector<Root> sharp_roots(const DenseQuadratic<Scalar> &problem, double shift,
                                            int zeros, int lowest);

/// A shift next to the slow roots, and of no value that is likely to be one, 1/s.
/// @param slow  modulus of the order of theirs at rest, 1/s
[[nodiscard]] inline double usual_shift(double speed, double slow) {
    return 0.31 * std::max(std::abs(speed), slow);
}

/// The eigenvalues alone, at a third of the cost: without their rates and their rounding errors.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<std::complex<double>> all_values(const DenseQuadratic<double> &problem,
                                                           double shift, int zeros);

/// The eigenvalue with its vectors, by inverse iteration from both sides, and their quotient;
/// without its rate.
/// @param value  as all_values() has it
/// @throws linalg::SolverError
[[nodiscard]] Root with_vectors(const DenseQuadratic<double> &problem, std::complex<double> value);

} // namespace whirl::modes

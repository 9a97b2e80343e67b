#pragma once

#include "linalg/dense/products.h"
#include "periodic/system.h"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace whirl::periodic {

/// What half a turn, after which the supports stand as before, makes of (q, q'): 2n x 2n. Implicit
/// steps of one length (collocation.h). In each, the steady part of the rotor is the same: it is
/// condensed to the few places of the supports once, where a small system is left for every step.
/// Motions of frequencies up to steps * resolved_angle * |speed| / pi are exact to 2e-12 a step,
/// slower ones to rounding; much faster ones die out.
/// @param speed  not zero, rad/s
/// @param along  where to put the states at the beginning of each step, or none
/// @throws linalg::SolverError where the steps meet a singular matrix
[[nodiscard]] Eigen::MatrixXd monodromy(const System &system, double speed, int steps,
                                        std::vector<linalg::Rows> *along = nullptr);

/// A free motion exp(l t) u(t), u of period pi / |speed|.
struct FloquetMotion {
    std::complex<double> value; ///< l, 1/s, |Im l| <= |speed|
    Eigen::VectorXcd state;     ///< (q, q') at t = 0, entries made comparable; length 1
    Eigen::VectorXcd shape;     ///< the same as it is
    double noise = 0;           ///< of l by rounding, 1/s
    /// Im(q^H M q') + Re(q)^T D Im(q) over |q| |q'|, measured by M: what the equations conserve
    /// where nothing damps or drives; 0 where something does. Two motions with actions of one sign
    /// do not open a band where they meet (V. A. Yakubovich, V. M. Starzhinskii, Linear
    /// Differential Equations with Periodic Coefficients, section III.1).
    double action = 0;
    double frequency = 0; ///< |q'| over |q| at t = 0, measured by M, rad/s
};

/// Eigenpairs of the monodromy matrix, both conjugates; without those hidden by rounding.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<FloquetMotion> floquet_motions(const System &system, double speed,
                                                         int steps);

/// A free motion exp(l t) sum_k u_k exp(2 i k speed t) with its terms.
struct FloquetSeries {
    std::complex<double> value; ///< l, 1/s, 0 <= Im l <= |speed|
    double noise = 0;           ///< of l by rounding, 1/s
    /// Over the unknowns (or amplitudes of shapes) of the system before it scaled them, u_-K, ...,
    /// u_K: n x (2K + 1).
    Eigen::MatrixXcd terms;
};

/// The motions of a period, one of each conjugate pair, whose rate is on average over it no more
/// than `fastest` times the displacement, both measured by M; terms of exponents up to three times
/// that rate, or as many as the steps resolve.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<FloquetSeries> floquet_series(const System &system, double speed,
                                                        int steps, double fastest);

/// One motion with its largest term in the middle, l at that, and as many terms to either side as
/// leave nothing beyond: few where the largest one is far from the strip |Im l| <= |speed|.
/// @param motion  of floquet_motions() with these steps, among those that grow most: along the
///                period rounding brings in faster growing ones
/// @returns nothing where its terms lie on both sides of the strip, or are too many
[[nodiscard]] std::optional<FloquetSeries> centred_series(const System &system, double speed,
                                                          int steps, const FloquetMotion &motion);

/// As floquet_motions() of equations with constant coefficients: at rest (Im l of any size) that of
/// the supports as they stand, else of what of them is the same from every direction.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<FloquetMotion> steady_motions(const System &system, double speed);

} // namespace whirl::periodic

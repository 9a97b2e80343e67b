#pragma once

#include "assembly/rotating_system.h"

#include <Eigen/Core>

namespace whirl::assembly {

/// M q'' + D q' + K q = 0 at one speed.
struct SystemAtSpeed {
    linalg::Matrix M, D, K;
};

/// Hill's infinite system, cut off: with periodic supports the motions in rotating axes are
///
///     exp(l t) [q_0 + sum_k a_k cos(2 k speed t) + b_k sin(2 k speed t)],  k = 1 .. harmonics,
///
/// and (l^2 M + l D + K) (q_0, a_1, b_1, a_2, ...) = 0 with the real matrices returned, of size
/// (2 harmonics + 1) times that of the system. Every motion comes 2 harmonics + 1 times, with l
/// shifted by multiples of 2 i speed: its aliases. The one whose q_0 is largest suffers least from
/// the cut.
[[nodiscard]] SystemAtSpeed hill_system(const RotatingSystem &system,
                                        const PeriodicSupports &supports, double speed,
                                        int harmonics);

/// What is left of it for motions that repeat with the supports (l = 0), by powers of the speed:
/// (K + speed Ks + speed^2 Kss) (q_0, a_1, b_1, ...) = f. Rows of cosines and sines are halved (the
/// mean of cos^2, Galerkin's weights), so that matrices of symmetric terms are symmetric.
struct PeriodicStiffness {
    linalg::Matrix K, Ks, Kss;
};
[[nodiscard]] PeriodicStiffness periodic_stiffness(const RotatingSystem &system,
                                                   const PeriodicSupports &supports, int harmonics);

/// A vector of the same over `size` unknowns as terms exp(2 i k speed t), a column each, from
/// k = -harmonics on.
[[nodiscard]] Eigen::MatrixXcd hill_terms(const Eigen::VectorXcd &vector, Eigen::Index size);

/// So many terms about the middle one; zeros where there are none.
[[nodiscard]] Eigen::MatrixXcd middle_terms(const Eigen::MatrixXcd &terms, Eigen::Index columns);

/// The same motion with its term k + places as term k.
[[nodiscard]] Eigen::MatrixXcd moved_terms(const Eigen::MatrixXcd &terms, Eigen::Index places);

} // namespace whirl::assembly

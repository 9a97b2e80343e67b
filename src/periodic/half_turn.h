#pragma once

// What the parts of monodromy.h share.

#include "linalg/dense/general_eigen.h"
#include "periodic/monodromy.h"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::periodic {

/// Of the supports as they stand in the rotor, s: half a turn.
[[nodiscard]] inline double period(double speed) { return std::numbers::pi / std::abs(speed); }

/// As floquet_motions(), of that matrix.
[[nodiscard]] std::vector<FloquetMotion> motions_of(const System &system, double speed,
                                                    const Eigen::MatrixXd &monodromy);

/// How fast motions are: |q'| over |q|, measured by M, of all states (q, q').
[[nodiscard]] double frequency_of(const Eigen::MatrixXd &M, const Eigen::MatrixXcd &states);

/// The vector of the i-th value among right or left ones.
[[nodiscard]] inline Eigen::VectorXcd vector_of(const linalg::GeneralEigen &found,
                                                const Eigen::MatrixXd &vectors, Eigen::Index i) {
    if (found.values(i).imag() < 0) // of a pair the second
        return linalg::unpacked(vectors, i - 1, true).conjugate();
    return linalg::unpacked(vectors, i, found.is_pair(i));
}

/// Entries of (q, q') become of one size by them.
[[nodiscard]] Eigen::VectorXd weights_of(const System::Steady &steady, double speed);

} // namespace whirl::periodic

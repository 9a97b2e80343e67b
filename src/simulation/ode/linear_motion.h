#pragma once

#include "reduction/reduced_rotor.h"

#include <Eigen/Core>

#include <optional>

namespace whirl::simulation {

/// x' = A x in the coordinates in which A is diagonal.
struct LinearMotion {
    Eigen::VectorXcd eigenvalues; ///< 1/s
    Eigen::MatrixXcd vectors;     ///< x = vectors * coordinates
    Eigen::MatrixXcd inverse;

    [[nodiscard]] bool empty() const { return eigenvalues.size() == 0; }
};

/// The rotor without imbalances and without the motion of its balancers' parts, in axes that turn
/// with it: x = (p, p'), 2r entries, p' the velocity in resting axes as it is seen from the turning
/// ones. Nothing where the supports are not the same from every direction, depend on speed, or
/// where A has no well-conditioned eigenvectors.
[[nodiscard]] std::optional<LinearMotion> rotor_alone(const reduction::ReducedRotor &rotor,
                                                      double speed);

} // namespace whirl::simulation

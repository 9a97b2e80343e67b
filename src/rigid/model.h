#pragma once

#include "rigid/forms.h"

#include <optional>
#include <vector>

namespace whirl::rigid {

/// A number of the finite-element model.
struct ModelValue {
    double value = 0;
    double noise = 0; ///< relative error that rounding can cause
};

/// The counterparts of the targets in the model of this rotor with shaft elements of this order;
/// none where the model has none.
///
/// Critical and additional speeds: positive roots W of det[K - W^2 A], A = M - G less the
/// anisotropy, K and A with the row of a pinned deflection left out. The k-th lowest belongs to the
/// k-th of the rigid rotor and never exceeds it: the rigid motions are a subspace of the model's,
/// and a maximum of A over K only grows with the space. Ends of the unstable range: sign changes of
/// det K(W), K(W) the stiffness in rotating axes with damping, between the critical speeds that the
/// anisotropy splits; there a real root passes zero, as in the closed form. Permissible anisotropy:
/// the least of 1/(W^2 |R(W)|) over the range, R the tilt that a unit moment standing in rotating
/// axes causes at the anisotropy.
[[nodiscard]] std::vector<std::optional<ModelValue>>
model_values(const model::Rotor &rotor, int order, const std::vector<RigidTarget> &targets);

/// Mass, centre and inertias of the model's own mass and gyroscopic matrices on rigid motions.
[[nodiscard]] Inertia model_inertia(const model::Rotor &rotor, int order);

} // namespace whirl::rigid

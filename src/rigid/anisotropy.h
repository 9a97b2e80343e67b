#pragma once

#include "results/sentence.h"
#include "results/show.h"
#include "rigid/inertia.h"

namespace whirl::rigid {

/// Critical speeds and stability limits of the scene as a rigid rotor over its anisotropy and its
/// polar inertia. Empty, with a note, unless the scene has rotating anisotropies and no balancers
/// and is symmetric on isotropic supports: sums of k z and of c z about the centre of mass vanish.
///
/// @param whole  inertia of the rotor
[[nodiscard]] std::optional<results::AnisotropyChart>
anisotropy_chart(const model::Rotor &rotor, const Inertia &whole,
                 std::vector<results::Sentence> &notes);

/// Closed form of the permissible inertial anisotropy (kg m2) of this rotor as a rigid body, over
/// the spin speeds from `from` to `to` (rad/s). None where the closed form does not apply.
[[nodiscard]] std::optional<double> rigid_permissible_anisotropy(const model::Rotor &rotor,
                                                                 double from, double to);

} // namespace whirl::rigid

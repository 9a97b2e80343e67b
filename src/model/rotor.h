#pragma once

#include "model/attachments.h"
#include "model/balancer.h"
#include "model/bearing.h"
#include "model/shaft.h"

#include <algorithm>
#include <span>
#include <vector>

namespace whirl::model {

/// Everything physical in a scene. z runs along the shaft from 0 to shaft.length().
struct Rotor {
    Shaft shaft;
    std::vector<Disc> discs;
    std::vector<Bearing> bearings; ///< seals behind all others
    std::vector<Anisotropy> anisotropies;
    std::vector<Balancer> balancers;
    std::vector<CorrectionPlane> planes;
    std::vector<Imbalance> imbalances;
    std::vector<Probe> probes;

    /// The bearings without the seals behind them.
    [[nodiscard]] std::span<const Bearing> supports() const;
    [[nodiscard]] std::span<const Bearing> seals() const;

    /// Something holds for the coefficients of every bearing at every speed.
    template <class Predicate> [[nodiscard]] bool every_row(Predicate holds) const {
        return std::ranges::all_of(
            bearings, [&](const Bearing &b) { return std::ranges::all_of(b.rows, holds); });
    }
    /// Bearings and pedestals are equal in x and y, without cross coupling, at every speed.
    [[nodiscard]] bool bearings_isotropic() const;
    /// Bearings and pedestals that look the same from every direction, at every speed: kxx = kyy,
    /// kxy = -kyx, masses without coupling.
    [[nodiscard]] bool bearings_rotation_invariant() const;
    /// No bearing couples x with y, at any speed.
    [[nodiscard]] bool bearings_orthotropic() const;
    /// Mass coefficients of bearings and masses of pedestals are equal in x and y and uncoupled.
    [[nodiscard]] bool support_masses_isotropic() const;
    /// Damping anywhere: bearings, pedestals or shaft.
    [[nodiscard]] bool damped() const;
    /// A bearing table over spin speed is present.
    [[nodiscard]] bool bearings_depend_on_speed() const;
    /// Speeds at which some bearing's coefficients bend (Bearing::bends), rad/s, ascending.
    [[nodiscard]] std::vector<double> table_bends() const;
    /// Something turns with the rotor and is not axisymmetric.
    [[nodiscard]] bool rotating_anisotropy() const {
        return !anisotropies.empty() || !balancers.empty() || shaft.asymmetric();
    }
};

} // namespace whirl::model

#pragma once

#include "model/attachments.h"
#include "model/balancer.h"
#include "model/bearing.h"
#include "model/excitation.h"
#include "model/shaft.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace whirl::model {

/// A balancer whose parts are fixed in the rotor. What they are to it is among the discs,
/// anisotropies and imbalances of the rotor, behind all others (balancers/held.h).
struct HeldBalancer {
    Balancer balancer;
    std::size_t index = 0;      ///< among the balancers of the case file
    std::vector<double> angles; ///< of balls and ring centres in the rotor, of tied pendulums φ, ψ
    bool anisotropic = false;   ///< one of the anisotropies is that of the parts
    bool unbalanced = false;    ///< one of the imbalances is what they leave of the balance
};

/// The name of a part, or "plane 2" of the second plane where it has none.
[[nodiscard]] std::string name_or_number(const std::string &name, const char *kind,
                                         std::size_t index);

/// Everything physical in a scene. z runs along the shaft from 0 to shaft.length().
struct Rotor {
    Shaft shaft;
    std::vector<Disc> discs;
    std::vector<Bearing> bearings; ///< seals behind all others
    std::vector<Anisotropy> anisotropies;
    std::vector<Balancer> balancers; ///< whose parts are free to move
    std::vector<HeldBalancer> held;
    std::vector<CorrectionPlane> planes;
    std::vector<Imbalance> imbalances;
    std::vector<HarmonicForce> forces;
    std::vector<Probe> probes;
    std::vector<Station> stations;

    /// The bearings without the seals behind them.
    [[nodiscard]] std::span<const Bearing> supports() const;
    [[nodiscard]] std::span<const Bearing> seals() const;

    /// The support whose pedestal a probe sits on, or is held by where it measures against it: the
    /// one that it names, else the nearest. None: that has no pedestal, and stands still.
    [[nodiscard]] std::optional<std::size_t> pedestal_of(const Probe &probe) const;

    /// By which correction weights and their tables know them: "probe 2" is the second where it has
    /// no name.
    [[nodiscard]] std::string probe_name(std::size_t probe) const;
    [[nodiscard]] std::string plane_name(std::size_t plane) const;

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
    /// Where a free balancer stands in the case file, for messages: "balancer[0]".
    [[nodiscard]] std::string balancer_path(std::size_t index) const;
    /// The planes of all balancers, free and held, in the order of the case file.
    [[nodiscard]] std::vector<CorrectionPlane> balancer_planes() const;
    /// As the case file has it: held balancers among the others, without what stands for them.
    [[nodiscard]] Rotor with_held_among_balancers() const;
    /// Something turns with the rotor and is not axisymmetric.
    [[nodiscard]] bool rotating_anisotropy() const {
        return !anisotropies.empty() || !balancers.empty() || shaft.asymmetric();
    }
};

} // namespace whirl::model

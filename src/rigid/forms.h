#pragma once

#include "model/case.h"
#include "results/sentence.h"
#include "rigid/inertia.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::rigid {

enum class RigidQuantity {
    critical,      ///< forward critical speed, balancers held, no damping
    additional,    ///< the same of the rotor pinned at a plane
    unstable_from, ///< ends of the range of speed in which a root of the tilt motion is positive
    unstable_to,
    permissible ///< largest dI without such a range
};

/// One number of the rigid rotor in closed form, and where the model has its counterpart.
struct RigidTarget {
    RigidQuantity kind = RigidQuantity::critical;
    results::Sentence quantity; ///< name for readers
    model::Quantity of = model::Quantity::speed;
    double closed_form = 0;
    int index = 0;            ///< critical, additional: place among the model's, from below
    std::optional<int> upper; ///< ends: they lie between the critical speeds `index` and this one
    double z = 0;             ///< additional: the plane, m
    double from = 0, to = 0;  ///< permissible: range of speed, rad/s

    [[nodiscard]] bool speed() const { return kind != RigidQuantity::permissible; }
};

struct RigidForms {
    Inertia inertia;                         ///< balancers at their balanced position
    double bearing_stiffness = 0;            ///< sum, N/m
    double omega_0 = 0;                      ///< sqrt of that over the mass, rad/s
    std::vector<double> partial_frequencies; ///< rad/s, as in closed_form::TwoSupportRotor
    std::optional<double> z_max;             ///< m, likewise
    std::vector<RigidTarget> targets;
    std::vector<results::Sentence> notes;
};

/// The scene with bearing tables replaced by their coefficients at rest, which both sides of the
/// comparison use.
/// @throws model::AnalysisFailure in words where the rigid rotor has no closed form: bearings that
/// differ between directions, pedestals.
[[nodiscard]] model::Case rigid_limit_scene(const model::Case &scene,
                                            std::vector<results::Sentence> &notes);

/// Closed forms: A. N. Gorbenko (composite and anisotropic rotor), G. Filimonikhin et al. (rotor on
/// two supports); src/closed_form. @throws model::AnalysisFailure where the bearings leave a rigid
/// motion free.
[[nodiscard]] RigidForms rigid_forms(const model::Case &scene);

} // namespace whirl::rigid

#pragma once

#include "model/case.h"

#include <complex>
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
    std::string quantity; ///< name for readers
    std::string unit;
    double closed_form = 0;
    int index = 0;            ///< critical, additional: place among the model's, from below
    std::optional<int> upper; ///< ends: they lie between the critical speeds `index` and this one
    double z = 0;             ///< additional: the plane, m
    double from = 0, to = 0;  ///< permissible: range of speed, rad/s

    [[nodiscard]] bool speed() const { return kind != RigidQuantity::permissible; }
};

/// Inertia of the composite rotor, balancers at their balanced position.
struct RigidInertia {
    double mass = 0;        ///< kg
    double center = 0;      ///< m
    double A = 0;           ///< mean diametral, about the centre of mass, kg m2
    double C = 0;           ///< polar, kg m2
    std::complex<double> a; ///< anisotropy: modulus, twice the direction; kg m2
};

struct RigidForms {
    RigidInertia inertia;
    double bearing_stiffness = 0; ///< sum, N/m
    std::vector<RigidTarget> targets;
    std::vector<std::string> notes;
};

/// The scene with bearing tables replaced by their coefficients at rest, which both sides of the
/// comparison use.
/// @throws model::AnalysisFailure in words where the rigid rotor has no closed form: bearings that
/// differ between directions, pedestals.
[[nodiscard]] model::Case rigid_limit_scene(const model::Case &scene,
                                            std::vector<std::string> &notes);

/// Closed forms: A. N. Gorbenko (composite and anisotropic rotor), G. Filimonikhin et al. (rotor on
/// two supports); src/closed_form. @throws model::AnalysisFailure where the bearings leave a rigid
/// motion free.
[[nodiscard]] RigidForms rigid_forms(const model::Case &scene);

} // namespace whirl::rigid

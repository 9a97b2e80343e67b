#include "modes/formulation.h"

#include "model/errors.h"
#include "modes/stiffness_sign.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::modes {

namespace {

/// Why the forms in the fixed frame cannot describe this rotor; empty where they can.
std::string against_fixed(const model::Rotor &rotor) {
    if (rotor.rotating_anisotropy())
        return "something that turns is not axisymmetric ([[anisotropy]], [[balancer]] or an "
               "asymmetric segment)";
    return {};
}

/// The same of the forms without damping.
/// @param bearings  what is against them in the bearings
std::string against_undamped(const model::Rotor &rotor, const std::string &bearings) {
    if (std::string reason = against_fixed(rotor); !reason.empty())
        return reason;
    if (rotor.shaft.axial_torque != 0)
        return "axial torque couples x and y";
    if (!bearings.empty())
        return bearings;
    if (rotor.damped())
        return "there is damping";
    return {};
}

std::string against_planar(const model::Rotor &rotor) {
    return against_undamped(rotor, rotor.bearings_isotropic()
                                       ? ""
                                       : "a bearing differs between x and y or couples them");
}

std::string against_hyperbolic(const model::Rotor &rotor) {
    return against_undamped(rotor, rotor.bearings_orthotropic() ? "" : "a bearing couples x and y");
}

/// Damping and cross coupling act on w = x + i y alone, and the rotor without them has frequencies.
bool turns_alike(const model::Rotor &rotor) {
    return against_fixed(rotor).empty() && rotor.bearings_rotation_invariant() &&
           rotor.shaft.axial_torque == 0 && // its matrix is not symmetric
           (!may_push_away(rotor) || stiffness_positive(rotor, std::max(1, rotor.shaft.order)));
}

/// Of supports the stiffness and damping may turn in the axes of the rotor, not the mass.
std::string against_hill(const model::Rotor &rotor) {
    if (rotor.support_masses_isotropic())
        return {};
    return "mass coefficients of a bearing or masses of a pedestal differ between x and y or "
           "couple them while the rotor is not axisymmetric either ([[anisotropy]], [[balancer]] "
           "or an asymmetric segment): mass that varies in time in every frame";
}

void require(const std::string &reason, results::Form form) {
    if (!reason.empty())
        throw model::BadInput(
            fmt::format("formulation: expected one that can describe the scene, got \"{}\": {}",
                        results::form_name(form), reason));
}

results::Formulation forced(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    const auto asked_for = [](results::Form form, const std::string &against) {
        require(against, form);
        return results::Formulation{form, "asked for by the case"};
    };
    switch (scene.formulation) {
    case model::FormChoice::planar:
        return asked_for(results::Form::planar, against_planar(rotor));
    case model::FormChoice::hyperbolic:
        return asked_for(results::Form::hyperbolic, against_hyperbolic(rotor));
    case model::FormChoice::rotating:
        return asked_for(results::Form::rotating,
                         rotor.bearings_rotation_invariant()
                             ? ""
                             : "a bearing is not the same from every direction");
    case model::FormChoice::hill:
        return asked_for(results::Form::hill, against_hill(rotor));
    default:
        return asked_for(results::Form::general, against_fixed(rotor));
    }
}

/// Of a rotor that is axisymmetric where it turns, x and y by themselves.
results::Formulation in_four_unknowns(const model::Rotor &rotor) {
    const std::string no_hyperbolic = against_hyperbolic(rotor);
    if (no_hyperbolic.empty())
        return {results::Form::hyperbolic,
                "bearings differ between x and y without coupling them, no "
                "damping: a symmetric problem with real frequencies"};
    return {results::Form::general,
            no_hyperbolic + ": a real quadratic problem with complex eigenvalues"};
}

} // namespace

results::Formulation choose_formulation(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    if (scene.formulation != model::FormChoice::automatic)
        return forced(scene);
    if (rotor.rotating_anisotropy() && rotor.bearings_rotation_invariant())
        return {results::Form::rotating,
                "something that turns is not axisymmetric and the bearings are the same from every "
                "direction: constant coefficients in axes that turn with the rotor"};
    if (rotor.rotating_anisotropy()) {
        require(against_hill(rotor), results::Form::hill);
        return {results::Form::hill,
                "neither what turns nor the bearings are the same from every direction: a series "
                "in twice the spin speed, in rotating axes"};
    }
    if (!rotor.damped() && may_push_away(rotor) &&
        !stiffness_positive(rotor, std::max(1, rotor.shaft.order)))
        return {results::Form::general,
                "the stiffness is not positive definite (a bearing pushes away, or "
                "the axial force buckles the shaft): real eigenvalues are looked "
                "for beside frequencies"};
    const std::string no_planar = against_planar(rotor);
    if (no_planar.empty())
        return {results::Form::planar,
                "isotropic bearings, axisymmetric rotor, no damping: w = x + i y "
                "halves the unknowns and the matrices are symmetric"};
    if (turns_alike(rotor))
        return {results::Form::planar_damped,
                "bearings that are the same from every direction, axisymmetric rotor: w = x + i y "
                "halves the unknowns with damping and cross coupling too, and the sign of Im of "
                "the eigenvalue is the direction of whirl"};
    return in_four_unknowns(rotor);
}

results::Formulation without_planar_damped(const results::Formulation &chosen,
                                           const model::Rotor &rotor) {
    return chosen.form == results::Form::planar_damped ? in_four_unknowns(rotor) : chosen;
}

} // namespace whirl::modes

#include "analyses/formulation.h"

#include "analyses/results.h"
#include "analyses/stiffness_sign.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::analyses {

namespace {

/// Why the forms in the fixed frame cannot describe this rotor; empty where they can.
std::string against_fixed(const model::Rotor &rotor) {
    if (rotor.rotating_anisotropy())
        return "something that turns is not axisymmetric ([[anisotropy]], [[balancer]] or an "
               "asymmetric segment)";
    return {};
}

std::string against_planar(const model::Rotor &rotor) {
    if (std::string reason = against_fixed(rotor); !reason.empty())
        return reason;
    if (!rotor.bearings_isotropic())
        return "a bearing differs between x and y or couples them";
    if (rotor.damped())
        return "there is damping";
    return {};
}

std::string against_hyperbolic(const model::Rotor &rotor) {
    if (std::string reason = against_fixed(rotor); !reason.empty())
        return reason;
    if (!rotor.bearings_orthotropic())
        return "a bearing couples x and y";
    if (rotor.damped())
        return "there is damping";
    return {};
}

void require(const std::string &reason, Form form) {
    if (!reason.empty())
        throw model::BadInput(
            fmt::format("formulation: expected one that can describe the scene, got \"{}\": {}",
                        form_name(form), reason));
}

Formulation forced(const model::Case &scene) {
    switch (scene.formulation) {
    case model::FormChoice::planar:
        require(against_planar(scene.rotor), Form::planar);
        return {Form::planar, "asked for by the case"};
    case model::FormChoice::hyperbolic:
        require(against_hyperbolic(scene.rotor), Form::hyperbolic);
        return {Form::hyperbolic, "asked for by the case"};
    case model::FormChoice::rotating:
        require(scene.rotor.bearings_rotation_invariant()
                    ? ""
                    : "a bearing is not the same from every direction",
                Form::rotating);
        return {Form::rotating, "asked for by the case"};
    case model::FormChoice::hill:
        return {Form::hill, "asked for by the case"};
    default:
        require(against_fixed(scene.rotor), Form::general);
        return {Form::general, "asked for by the case"};
    }
}

} // namespace

std::string form_name(Form form) {
    switch (form) {
    case Form::planar:
        return "planar";
    case Form::hyperbolic:
        return "hyperbolic";
    case Form::rotating:
        return "rotating";
    case Form::hill:
        return "hill";
    default:
        return "general";
    }
}

std::string frame_name(Form form) { return in_rotating_axes(form) ? form_name(form) : "fixed"; }

std::string unknowns_name(Form form) { return form == Form::planar ? "planar" : "real"; }

std::string whirl_name(Whirl whirl) {
    switch (whirl) {
    case Whirl::forward:
        return "forward";
    case Whirl::backward:
        return "backward";
    default:
        return "mixed";
    }
}

Formulation choose_formulation(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    if (scene.formulation != model::FormChoice::automatic)
        return forced(scene);
    if (rotor.rotating_anisotropy())
        return rotor.bearings_rotation_invariant()
                   ? Formulation{Form::rotating,
                                 "something that turns is not axisymmetric and the bearings are "
                                 "the "
                                 "same from every direction: constant coefficients in axes that "
                                 "turn with the rotor"}
                   : Formulation{Form::hill,
                                 "neither what turns nor the bearings are the same from every "
                                 "direction: a series in twice the spin speed, in rotating axes"};
    if (!rotor.damped() && may_push_away(rotor) &&
        !stiffness_positive(rotor, std::max(1, rotor.shaft.order)))
        return {Form::general, "the stiffness is not positive definite (a bearing pushes away, or "
                               "the axial force buckles the shaft): real eigenvalues are looked "
                               "for beside frequencies"};
    const std::string no_planar = against_planar(rotor);
    if (no_planar.empty())
        return {Form::planar, "isotropic bearings, axisymmetric rotor, no damping: w = x + i y "
                              "halves the unknowns and the matrices are symmetric"};
    const std::string no_hyperbolic = against_hyperbolic(rotor);
    if (no_hyperbolic.empty())
        return {Form::hyperbolic, "bearings differ between x and y without coupling them, no "
                                  "damping: a symmetric problem with real frequencies"};
    return {Form::general, no_hyperbolic + ": a real quadratic problem with complex eigenvalues"};
}

} // namespace whirl::analyses

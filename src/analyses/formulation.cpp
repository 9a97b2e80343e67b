#include "analyses/formulation.h"

#include "analyses/results.h"
#include "model/errors.h"

#include <fmt/format.h>

namespace whirl::analyses {

namespace {

/// Why the planar form cannot describe this rotor; empty where it can.
std::string against_planar(const model::Rotor &rotor) {
    if (!rotor.bearings_isotropic())
        return "a bearing differs between x and y or couples them";
    if (rotor.damped())
        return "there is damping";
    return {};
}

std::string against_hyperbolic(const model::Rotor &rotor) {
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
    default:
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
    default:
        return "general";
    }
}

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
    if (rotor.rotating_anisotropy())
        throw model::AnalysisFailure(
            "the scene has a rotating anisotropy or an auto-balancer: this needs the equations in "
            "the rotating frame, which this version does not have; remove [[anisotropy]] and "
            "[[balancer]] to see the rotor without them");
    if (scene.formulation != model::FormChoice::automatic)
        return forced(scene);
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

#include "analyses/show.h"

#include "analyses/discretization_error.h"
#include "analyses/response.h"
#include "analyses/show_anisotropy.h"
#include "analyses/show_balancers.h"
#include "analyses/show_inertia.h"
#include "assembly/discretization.h"
#include "model/errors.h"

#include <chrono>
#include <cmath>
#include <string_view>

namespace whirl::analyses {

namespace {

Inertia whole_inertia(const model::Rotor &rotor, const Inertia &shaft) {
    Inertia sum = shaft;
    for (const model::Disc &disc : rotor.discs)
        sum += inertia_of(disc);
    for (const model::Balancer &balancer : rotor.balancers)
        sum += inertia_of(balancer);
    return sum;
}

} // namespace

ShowResult show(const model::Case &scene) {
    const auto start = std::chrono::steady_clock::now();
    const model::Rotor &rotor = scene.rotor;
    const mesh::ShaftMesh mesh = mesh::make_mesh(rotor);
    const Inertia shaft = inertia_of(rotor.shaft, mesh);
    const Inertia all = whole_inertia(rotor, shaft);
    ShowResult result;
    result.mass = all.mass;
    result.center_of_mass = all.center();
    result.Id = all.diametral();
    result.Ip = all.polar;
    result.type = rigid_type(result.Id, result.Ip);
    result.shaft_mass = shaft.mass;
    result.length = rotor.shaft.length();
    const Formulation eigen = choose_formulation(scene);
    for (const char *command : {"campbell", "critical", "modes", "accuracy", "stability"})
        if (eigen.form != Form::hill || std::string_view(command) != "critical")
            result.formulations.emplace_back(command, eigen);
    try {
        result.formulations.emplace_back("response", response_formulation(scene));
    } catch (const model::AnalysisFailure &none) {
        result.model.notes.emplace_back(none.what());
    }
    result.model.formulation = eigen;
    result.model.order = resolve_order(scene, eigen);
    const assembly::Discretization d(rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = (eigen.form == Form::planar ? 1 : 2) * d.planar_size();
    result.balancers = show_balancers(rotor, all, result.model.notes);
    if (const auto a = anisotropy_of(rotor, result.balancers)) {
        // Below rounding no axis is the one of smaller inertia.
        const bool some = std::abs(*a) > 1e-14 * result.Id;
        result.dI = some ? std::abs(*a) : 0;
        result.dI_angle = some ? std::arg(*a) / 2 : 0;
    }
    result.anisotropy = anisotropy_chart(rotor, all, result.model.notes);
    result.model.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace whirl::analyses

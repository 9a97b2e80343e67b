#include "analyses/show.h"

#include "assembly/discretization.h"
#include "forced/forced_motion.h"
#include "forced/static_sag.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/formulation.h"
#include "results/show.h"
#include "rigid/anisotropy.h"
#include "rigid/composite_rotor.h"
#include "rigid/inertia.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace whirl::analyses {

namespace {

rigid::Inertia whole_inertia(const model::Rotor &rotor, const rigid::Inertia &shaft) {
    rigid::Inertia sum = shaft;
    for (const model::Disc &disc : rotor.discs)
        sum += rigid::inertia_of(disc);
    for (const model::Balancer &balancer : rotor.balancers)
        sum += rigid::inertia_of(balancer);
    return sum;
}

void add_static_sag(results::ShowResult &result, const model::Case &scene,
                    const assembly::Discretization &d) {
    const double gravity = scene.response.gravity;
    try {
        result.sag = forced::static_sag(d, gravity != 0 ? gravity : forced::standard_gravity);
    } catch (const linalg::SolverError &failure) {
        result.model.notes.push_back(std::string("no static sag: ") + failure.what());
        return;
    }
    const auto supports = scene.rotor.supports();
    if (result.sag && std::any_of(supports.begin(), supports.end(),
                                  [](const auto &bearing) { return bearing.depends_on_speed(); }))
        result.model.notes.emplace_back("static sag: with the first row of the bearing tables");
}

} // namespace

results::ShowResult show(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    const mesh::ShaftMesh mesh = mesh::make_mesh(rotor);
    const rigid::Inertia shaft = rigid::inertia_of(rotor.shaft, mesh);
    const rigid::Inertia all = whole_inertia(rotor, shaft);
    results::ShowResult result;
    result.mass = all.mass;
    result.center_of_mass = all.center();
    result.Id = all.diametral();
    result.Ip = all.polar;
    result.type = rigid::rigid_type(result.Id, result.Ip);
    result.shaft_mass = shaft.mass;
    result.length = rotor.shaft.length();
    const results::Formulation eigen = modes::choose_formulation(scene);
    const results::Formulation real = modes::choose_formulation(scene, false);
    for (const std::string_view command :
         {"campbell", "critical", "modes", "accuracy", "stability"})
        if (eigen.form != results::Form::hill || command != "critical")
            result.formulations.emplace_back(
                command, command == "critical" || command == "stability" ? real : eigen);
    try {
        result.formulations.emplace_back("response", forced::response_formulation(scene));
    } catch (const model::AnalysisFailure &none) {
        result.model.notes.emplace_back(none.what());
    }
    result.model.formulation = eigen;
    result.model.order = mesh_error::resolve_order(scene, eigen);
    const assembly::Discretization d(rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = (results::is_planar(eigen.form) ? 1 : 2) * d.planar_size();
    result.balancers = rigid::show_balancers(rotor, all, result.model.notes);
    if (const auto a = rigid::anisotropy_of(rotor, result.balancers)) {
        // Below rounding no axis is the one of smaller inertia.
        const bool some = std::abs(*a) > 1e-14 * result.Id;
        result.dI = some ? std::abs(*a) : 0;
        result.dI_angle = some ? std::arg(*a) / 2 : 0;
    }
    result.anisotropy = rigid::anisotropy_chart(rotor, all, result.model.notes);
    add_static_sag(result, scene, d);
    return result;
}

} // namespace whirl::analyses

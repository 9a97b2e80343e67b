#include "analyses/show.h"

#include "analyses/periodic_response.h"
#include "assembly/discretization.h"
#include "balancers/kind.h"
#include "forced/forced_motion.h"
#include "forced/static_sag.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "results/enum_name.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "results/show.h"
#include "rigid/anisotropy.h"
#include "rigid/composite_rotor.h"
#include "rigid/inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

void note_shaft(const model::Shaft &shaft, std::vector<results::Sentence> &notes) {
    if (shaft.alpha != 0 || shaft.beta != 0)
        notes.emplace_back(model::Weight::information,
                           "the shaft has damping that does not turn: alpha = {} of its mass, beta "
                           "= {} of its stiffness",
                           as::rate(shaft.alpha), as::time(shaft.beta));
    if (!shaft.modal_damping.empty())
        notes.emplace_back(model::Weight::information,
                           "damping ratios of the lowest modes at rest in each plane: {}",
                           as::number.list(shaft.modal_damping));
    if (shaft.axial_torque != 0)
        notes.emplace_back(
            model::Weight::information, "the shaft carries a torque of {}, {} at its ends",
            as::moment(shaft.axial_torque),
            results::enum_name(shaft.torque_kind, {"axial", "semitangential", "tangential"}));
}

void note_bearings(std::span<const model::Bearing> bearings, const char *kind,
                   std::vector<results::Sentence> &notes) {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
        const model::Bearing &b = bearings[i];
        const std::string name = b.name.empty() ? fmt::format("{}[{}]", kind, i) : b.name;
        const Eigen::Matrix2d &m = b.rows.front().m;
        if (model::isotropic(m) && m(0, 0) > 0)
            notes.emplace_back(model::Weight::information,
                               "{}: mass coefficient {}, no part of the mass above", name,
                               as::mass(m(0, 0)));
        else if (!m.isZero(0))
            notes.emplace_back(model::Weight::information,
                               "{}: mass coefficients mxx = {}, mxy = {}, myx = {}, myy = {}, no "
                               "part of the mass above",
                               name, as::mass(m(0, 0)), as::mass(m(0, 1)), as::mass(m(1, 0)),
                               as::mass(m(1, 1)));
        if (!b.pedestal)
            continue;
        const model::Pedestal &p = *b.pedestal;
        notes.emplace_back(model::Weight::information,
                           "{}: on a pedestal of k = {} in x, {} in y, mass {}, c = {}", name,
                           as::stiffness(p.k(0)), as::stiffness(p.k(1)),
                           as::mass.list({p.mass(0), p.mass(1)}),
                           as::damping.list({p.c(0), p.c(1)}));
    }
}

void note_races(const model::Rotor &rotor, std::vector<results::Sentence> &notes) {
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const std::string name = model::name_or_number(rotor.balancers[i].name, "balancer", i);
        const auto kind = balancers::kind_of(rotor.balancers[i]);
        if (const auto centre = kind->race_centre(); centre != 0.0)
            notes.emplace_back(model::Weight::information,
                               "{}: the race is off the axis by {} at {}", name,
                               as::length(std::abs(centre)), as::angle(std::arg(centre)));
        if (const auto h = kind->out_of_round(); h != 0.0)
            notes.emplace_back(model::Weight::information,
                               "{}: the race is out of round by {} of its radius, farthest from "
                               "its centre at {} and opposite",
                               name, as::number(std::abs(h)), as::angle(std::arg(h) / 2));
        if (const auto slope = -kind->inclination(); slope != 0.0)
            notes.emplace_back(model::Weight::information,
                               "{}: the race is tilted by {}, farthest along z at {}", name,
                               as::angle(std::abs(slope)), as::angle(std::arg(slope)));
    }
}

void add_static_sag(results::ShowResult &result, const model::Case &scene,
                    const assembly::Discretization &d) {
    const double gravity = scene.response.gravity;
    try {
        result.sag = forced::static_sag(d, gravity != 0 ? gravity : forced::standard_gravity);
    } catch (const linalg::SolverError &failure) {
        result.model.notes.emplace_back("no static sag: {}", failure.sentence());
        return;
    }
    const auto supports = scene.rotor.supports();
    if (result.sag && std::ranges::any_of(
                          supports, [](const auto &bearing) { return bearing.depends_on_speed(); }))
        result.model.notes.emplace_back(model::Weight::information,
                                        "static sag: with the first row of the bearing tables");
}

} // namespace

results::ShowResult show(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    const rigid::Inertia all = rigid::inertia_of(rotor);
    results::ShowResult result;
    result.mass = all.mass;
    result.center_of_mass = all.center();
    result.Id = all.diametral();
    result.Ip = all.polar;
    result.type = rigid::rigid_type(result.Id, result.Ip);
    result.shaft_mass = rigid::inertia_of(rotor.shaft, mesh::make_mesh(rotor)).mass;
    result.length = rotor.shaft.length();
    note_shaft(rotor.shaft, result.model.notes);
    note_bearings(rotor.supports(), "bearing", result.model.notes);
    note_bearings(rotor.seals(), "seal", result.model.notes);
    note_races(rotor, result.model.notes);
    const results::Formulation eigen = modes::choose_formulation(scene);
    const results::Formulation real = modes::without_planar_damped(eigen, rotor);
    for (const std::string_view command :
         {"campbell", "critical", "modes", "accuracy", "stability"})
        result.formulations.emplace_back(
            command, command == "critical" || command == "stability" ? real : eigen);
    try {
        result.formulations.emplace_back(
            "response", response_is_periodic(scene) ? eigen : forced::response_formulation(scene));
    } catch (const model::AnalysisFailure &none) {
        result.model.notes.push_back(none.sentence());
    }
    result.model.formulation = eigen;
    result.model.order = mesh_error::resolve_order(scene, eigen);
    const assembly::Discretization d(rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = (results::is_planar(eigen.form) ? 1 : 2) * d.planar_size();
    std::string why; // said of the balancers, for whom the papers have these numbers
    result.dimensionless = rigid::rotor_numbers(rotor, all, why);
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

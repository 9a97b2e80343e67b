#include "analyses/show.h"

#include "analyses/discretization_error.h"
#include "analyses/response.h"
#include "assembly/discretization.h"
#include "elements/quadrature.h"
#include "elements/section.h"

#include <chrono>
#include <cmath>

namespace whirl::analyses {

namespace {

/// Moments of the mass over z = 0, and inertias of the parts about their own centres.
struct Inertia {
    double mass = 0;   ///< kg
    double first = 0;  ///< sum of m z, kg m
    double second = 0; ///< sum of m z^2 + own Id, kg m2
    double polar = 0;  ///< kg m2
};

/// int rho A (1, z, z^2) dz, int rho I dz with z^2, int 2 rho I dz. A cone's rho A z^2 and rho I
/// have degree 4 in z: three Gauss points are exact.
Inertia shaft_inertia(const model::Shaft &shaft, const mesh::ShaftMesh &mesh) {
    const elements::Quadrature &rule = elements::gauss_legendre(3);
    Inertia sum;
    for (const mesh::Span &span : mesh.spans) {
        const elements::Beam beam = elements::beam_of(shaft, span);
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
            const elements::Section section = beam.at(rule.points[q]);
            const double z = span.z + rule.points[q] * span.length;
            const double dz = rule.weights[q] * span.length;
            sum.mass += section.rhoA * dz;
            sum.first += section.rhoA * z * dz;
            sum.second += (section.rhoA * z * z + section.rhoI) * dz;
            sum.polar += 2 * section.rhoI * dz;
        }
    }
    return sum;
}

Inertia with_discs(Inertia sum, const std::vector<model::Disc> &discs) {
    for (const model::Disc &disc : discs) {
        sum.mass += disc.mass;
        sum.first += disc.mass * disc.z;
        sum.second += disc.mass * disc.z * disc.z + disc.Id;
        sum.polar += disc.Ip;
    }
    return sum;
}

std::string rigid_type(double Id, double Ip) {
    // Inputs carry nine digits or more where a spherical rotor is meant.
    constexpr double equal = 1e-9;
    if (std::abs(Id - Ip) <= equal * std::max(Id, Ip))
        return "spherical";
    return Id > Ip ? "long" : "short";
}

} // namespace

ShowResult show(const model::Case &scene) {
    const auto start = std::chrono::steady_clock::now();
    const model::Rotor &rotor = scene.rotor;
    const mesh::ShaftMesh mesh = mesh::make_mesh(rotor);
    const Inertia shaft = shaft_inertia(rotor.shaft, mesh);
    const Inertia all = with_discs(shaft, rotor.discs);
    ShowResult result;
    result.mass = all.mass;
    result.center_of_mass = all.first / all.mass;
    result.Id = all.second - all.mass * result.center_of_mass * result.center_of_mass;
    result.Ip = all.polar;
    result.type = rigid_type(result.Id, result.Ip);
    result.shaft_mass = shaft.mass;
    result.length = rotor.shaft.length();
    model::Case turning = scene; // what the analyses of this version can describe
    turning.rotor.anisotropies.clear();
    turning.rotor.balancers.clear();
    const Formulation eigen = choose_formulation(turning);
    for (const char *command : {"campbell", "critical", "modes", "accuracy"})
        result.formulations.emplace_back(command, eigen);
    result.formulations.emplace_back("response", response_formulation(scene));
    result.model.formulation = eigen;
    result.model.order = resolve_order(turning, eigen);
    const assembly::Discretization d(rotor, result.model.order);
    result.model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    result.model.unknowns = (eigen.form == Form::planar ? 1 : 2) * d.planar_size();
    if (rotor.rotating_anisotropy())
        result.model.notes.emplace_back(
            "mass, inertias and formulations are those of the rotor without its balancers and "
            "rotating anisotropies; the analyses refuse scenes that have them");
    result.model.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace whirl::analyses

#include "rigid/inertia.h"

#include "balancers/balanced_position.h"
#include "elements/quadrature.h"
#include "elements/section.h"

#include <algorithm>
#include <cmath>

namespace whirl::rigid {

Inertia &Inertia::operator+=(const Inertia &other) {
    mass += other.mass;
    first += other.first;
    second += other.second;
    polar += other.polar;
    a += other.a;
    return *this;
}

Inertia &Inertia::operator-=(const Inertia &other) {
    mass -= other.mass;
    first -= other.first;
    second -= other.second;
    polar -= other.polar;
    a -= other.a;
    return *this;
}

/// int rho A (1, z, z^2) dz, int rho I dz with z^2, int 2 rho I dz, and int rho I asymmetry
/// exp(2 i angle) dz: the rotary inertia shares the asymmetry of bending. A cone's rho A z^2 and
/// rho I have degree 4 in z: three Gauss points are exact.
Inertia inertia_of(const model::Shaft &shaft, const mesh::ShaftMesh &mesh) {
    const elements::Quadrature &rule = elements::gauss_legendre(3);
    Inertia sum;
    for (const mesh::Span &span : mesh.spans) {
        const auto &segment = shaft.segments[static_cast<std::size_t>(span.segment)];
        const elements::Beam beam = elements::beam_of(shaft, span);
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
            const elements::Section section = beam.at(rule.points[q]);
            const double z = span.z + rule.points[q] * span.length;
            const double dz = rule.weights[q] * span.length;
            sum.mass += section.rhoA * dz;
            sum.first += section.rhoA * z * dz;
            sum.second += (section.rhoA * z * z + section.rhoI) * dz;
            sum.polar += 2 * section.rhoI * dz;
            sum.a += segment.asymmetry * std::polar(1.0, 2 * segment.asymmetry_angle) *
                     (section.rhoI * rule.weights[q] * span.length);
        }
    }
    return sum;
}

Inertia inertia_of(const model::Balancer &balancer) {
    const double mass = balancers::mass_of(balancer);
    const double polar = balancers::added_inertias(balancer).polar();
    // Point masses and thin rings in one plane: the mean diametral inertia is half the polar one.
    return {mass, mass * balancer.z, mass * balancer.z * balancer.z + polar / 2, polar, 0};
}

Inertia inertia_of(const model::Rotor &rotor) {
    Inertia sum = inertia_of(rotor.shaft, mesh::make_mesh(rotor));
    for (const model::Disc &disc : rotor.discs)
        sum += {disc.mass, disc.mass * disc.z, disc.mass * disc.z * disc.z + disc.Id, disc.Ip, 0};
    for (const model::Balancer &balancer : rotor.balancers)
        sum += inertia_of(balancer);
    for (const model::Anisotropy &anisotropy : rotor.anisotropies)
        sum.a += anisotropy.dI * std::polar(1.0, 2 * anisotropy.angle);
    return sum;
}

std::string rigid_type(double Id, double Ip) {
    // Inputs carry nine digits or more where a spherical rotor is meant.
    constexpr double equal = 1e-9;
    if (std::abs(Id - Ip) <= equal * std::max(Id, Ip))
        return "spherical";
    return Id > Ip ? "long" : "short";
}

} // namespace whirl::rigid

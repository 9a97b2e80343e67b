#include "properties/random_rotors.h"

#include <algorithm>

namespace whirl::properties {

namespace {

model::Material random_material(Draw &draw) {
    const double nu = draw.between(0.2, 0.35);
    model::Material material;
    material.name = "metal";
    material.E = draw.between(0.7e11, 2.2e11);
    material.G = material.E / (2 * (1 + nu));
    material.rho = draw.between(2700, 8000);
    return material;
}

double segment_mass(const model::Segment &s) {
    return s.material.rho * 0.785 * s.length *
           (s.outer_start * s.outer_start - s.inner_start * s.inner_start);
}

/// Anywhere, at a joint of two segments, or close to one.
double random_station(Draw &draw, const model::Shaft &shaft) {
    const double length = shaft.length();
    if (draw.chance(0.6))
        return length * draw.between(0.02, 0.98);
    double z = 0;
    const int joint = draw.integer(0, static_cast<int>(shaft.segments.size()));
    for (int i = 0; i < joint; ++i)
        z += shaft.segments[static_cast<std::size_t>(i)].length;
    if (draw.chance(0.3))
        z += length * draw.over_decades(1e-5, 1e-2) * (z > length / 2 ? -1 : 1);
    return std::min(z, length);
}

Eigen::Matrix2d random_stiffness(Draw &draw, Kind kind) {
    const double k = draw.chance(0.2) ? 1e9 : draw.over_decades(1e5, 1e9);
    Eigen::Matrix2d out = k * Eigen::Matrix2d::Identity();
    if (kind == Kind::isotropic)
        return out;
    out(1, 1) *= draw.over_decades(0.2, 5);
    if (kind == Kind::damped && draw.chance(0.4)) {
        out(0, 1) = std::sqrt(out(0, 0) * out(1, 1)) * draw.between(-0.3, 0.3);
        out(1, 0) = draw.chance(0.5) ? out(0, 1) : -out(0, 1);
    }
    return out;
}

void add_bearings(Draw &draw, model::Rotor &rotor, Kind kind) {
    const double length = rotor.shaft.length();
    std::vector<double> places{length * draw.between(0, 0.25), length * draw.between(0.7, 1)};
    if (draw.chance(0.4))
        places = {0, length};
    if (draw.chance(0.15))
        places.push_back(length * draw.between(0.4, 0.6));
    const bool round = kind == Kind::damped && draw.chance(0.4);
    for (const double z : places) {
        model::BearingCoefficients at;
        at.k = random_stiffness(draw, round ? Kind::isotropic : kind);
        if (kind == Kind::damped) {
            // Of the order of a few percent of critical for the shaft's own mass.
            double mass = 0;
            for (const model::Segment &s : rotor.shaft.segments)
                mass += segment_mass(s);
            const double c = draw.over_decades(0.005, 0.1) * std::sqrt(at.k(0, 0) * mass);
            at.c = c * Eigen::Matrix2d::Identity();
            if (!round && draw.chance(0.5))
                at.c(1, 1) *= draw.between(0.3, 2);
        }
        model::Bearing bearing;
        bearing.z = z;
        bearing.rows = {at};
        rotor.bearings.push_back(bearing);
    }
}

} // namespace

model::Rotor random_rotor(Draw &draw, Kind kind) {
    model::Rotor rotor;
    const model::Material material = random_material(draw);
    const double length = draw.between(0.3, 2);
    const double diameter = length * draw.over_decades(0.015, 0.12);
    const int segments = draw.integer(1, 5);
    double mass = 0;
    for (int i = 0; i < segments; ++i) {
        model::Segment s;
        s.length = length / segments * (segments == 1 ? 1 : draw.between(0.4, 1.6));
        s.outer_start = s.outer_end = diameter * (segments == 1 ? 1 : draw.between(0.6, 1.6));
        s.inner_start = s.inner_end = draw.chance(0.3) ? s.outer_start * draw.between(0.2, 0.8) : 0;
        s.material = material;
        mass += segment_mass(s);
        rotor.shaft.segments.push_back(s);
    }
    add_bearings(draw, rotor, kind);
    for (int i = draw.integer(0, 4); i > 0; --i) {
        model::Disc disc;
        disc.z = random_station(draw, rotor.shaft);
        disc.mass = mass * draw.over_decades(0.05, 2);
        const double radius = diameter * draw.between(0.8, 4);
        disc.Ip = disc.mass * radius * radius / 2;
        disc.Id = disc.Ip * draw.between(0.5, 1.3);
        rotor.discs.push_back(disc);
    }
    if (kind == Kind::damped && draw.chance(0.4))
        rotor.shaft.internal_damping = draw.over_decades(1e-7, 1e-5);
    return rotor;
}

oracles::SteppedRotor continuum_of(const model::Rotor &rotor) {
    oracles::SteppedRotor out;
    for (const model::Segment &s : rotor.shaft.segments)
        out.shaft.push_back(
            {s.length, s.outer_start, s.inner_start, s.material.E, s.material.G, s.material.rho,
             rotor.shaft.shear == model::ShearFormula::given ? rotor.shaft.shear_coefficient : 0});
    for (const model::Disc &d : rotor.discs)
        out.discs.push_back({d.z, d.mass, d.Id, d.Ip});
    const auto block = [](const Eigen::Matrix2d &m) {
        return oracles::Block{{{m(0, 0), m(0, 1)}, {m(1, 0), m(1, 1)}}};
    };
    for (const model::Bearing &b : rotor.bearings) {
        const model::BearingCoefficients &at = b.rows.front();
        oracles::Support support;
        support.z = b.z;
        support.k = block(at.k);
        support.c = block(at.c);
        support.kt = block(at.kt);
        support.ct = block(at.ct);
        if (b.pedestal) {
            support.pedestal = true;
            support.pedestal_mass = b.pedestal->mass.x(); // those drawn are the same in y
            support.pedestal_k = b.pedestal->k.x();
            support.pedestal_c = b.pedestal->c.x();
        }
        out.supports.push_back(support);
    }
    out.internal_damping = rotor.shaft.internal_damping;
    return out;
}

} // namespace whirl::properties

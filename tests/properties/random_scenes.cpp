#include "properties/random_scenes.h"
#include "properties/random_rotors.h"
#include "support/balancer_parts.h"

#include <numbers>

namespace whirl::properties {

namespace {

double shaft_mass(const model::Shaft &shaft) {
    double mass = 0;
    for (const model::Segment &s : shaft.segments)
        mass += s.material.rho * std::numbers::pi / 4 * s.length *
                (s.outer_start * s.outer_start - s.inner_start * s.inner_start);
    return mass;
}

double rotor_mass(const model::Rotor &rotor) {
    double mass = shaft_mass(rotor.shaft);
    for (const model::Disc &d : rotor.discs)
        mass += d.mass;
    return mass;
}

/// Tables, pedestals and stiffness against tilt.
void furnish(Draw &draw, model::Bearing &bearing, double mass) {
    const model::BearingCoefficients at = bearing.rows.front();
    const double k = at.k(0, 0);
    if (draw.chance(0.2)) {
        bearing.speeds = {0, 400, 1500};
        for (const double factor : {draw.between(1.2, 3), draw.between(0.5, 2)}) {
            model::BearingCoefficients next = at;
            next.k *= factor;
            next.c *= draw.between(0.4, 1);
            bearing.rows.push_back(next);
        }
    }
    if (draw.chance(0.2))
        bearing.pedestal =
            model::Pedestal{mass * draw.between(0.1, 1), k * draw.between(0.5, 10),
                            at.c.isZero(0) ? 0 : std::sqrt(k * mass) * draw.between(0.01, 0.1)};
    if (draw.chance(0.2)) {
        const double arm = draw.between(0.01, 0.05);
        for (model::BearingCoefficients &row : bearing.rows)
            row.kt = k * arm * arm * Eigen::Matrix2d::Identity();
    }
}

void make_round(model::Rotor &rotor) {
    for (model::Bearing &b : rotor.bearings)
        for (model::BearingCoefficients &row : b.rows) {
            row.k = row.k(0, 0) * Eigen::Matrix2d::Identity();
            row.c = row.c(0, 0) * Eigen::Matrix2d::Identity();
        }
}

void add_discs(Draw &draw, model::Rotor &rotor) {
    const int wanted = draw.integer(2, 5);
    const double mass = shaft_mass(rotor.shaft);
    const double length = rotor.shaft.length();
    while (static_cast<int>(rotor.discs.size()) < wanted) {
        model::Disc disc;
        disc.z = length * draw.between(0, 1);
        disc.mass = mass * draw.over_decades(0.05, 1);
        const double radius = length * draw.between(0.05, 0.2);
        disc.Ip = disc.mass * radius * radius / 2;
        disc.Id = disc.Ip * draw.between(0.5, 1.3);
        rotor.discs.push_back(disc);
    }
}

void add_balancers(Draw &draw, model::Rotor &rotor) {
    const double mass = rotor_mass(rotor);
    const double length = rotor.shaft.length();
    for (int i = draw.integer(1, 2); i > 0; --i) {
        model::Balancer b;
        b.z = length * draw.between(0.1, 0.9);
        tests::row(b).n = draw.integer(2, 4);
        tests::row(b).mass = mass * draw.over_decades(1e-4, 3e-2) / tests::row(b).n;
        tests::row(b).radius = length * draw.between(0.05, 0.15);
        tests::row(b).damping = tests::row(b).mass * draw.over_decades(5, 200);
        b.imbalance =
            tests::row(b).n * tests::row(b).mass * tests::row(b).radius / draw.between(1.1, 3);
        b.imbalance_phase = draw.chance(0.5) ? 0 : draw.between(-3, 3);
        rotor.balancers.push_back(b);
    }
}

void add_anisotropy(Draw &draw, model::Rotor &rotor) {
    const model::Disc &disc = rotor.discs.front();
    model::Anisotropy a;
    a.z = disc.z;
    a.dI = disc.Ip / 2 * draw.between(0.05, 0.8);
    a.angle = draw.chance(0.5) ? 0 : draw.between(-3, 3);
    rotor.anisotropies.push_back(a);
}

} // namespace

model::Case random_scene(int number) {
    Draw draw(static_cast<std::uint64_t>(number) + 1000003);
    model::Case scene;
    scene.name = "scene " + std::to_string(number);
    const int kind = draw.integer(0, 3);
    model::Rotor &rotor = scene.rotor;
    rotor = random_rotor(draw, kind == 0   ? Kind::isotropic
                               : kind == 1 ? Kind::orthotropic
                                           : Kind::damped);
    rotor.shaft.order = draw.integer(1, 6);
    for (model::Segment &s : rotor.shaft.segments)
        s.elements = rotor.shaft.order < 3 ? 3 : 1;
    add_discs(draw, rotor);
    for (model::Bearing &b : rotor.bearings)
        furnish(draw, b, rotor_mass(rotor));
    const bool balls = draw.chance(0.15);
    const bool anisotropy = draw.chance(0.2);
    if ((balls || anisotropy) && draw.chance(0.95)) // else a Hill series
        make_round(rotor);
    if (balls)
        add_balancers(draw, rotor);
    if (anisotropy)
        add_anisotropy(draw, rotor);
    const double length = rotor.shaft.length();
    for (int i = 0; i < 2; ++i) {
        rotor.imbalances.push_back(
            {"", length * draw.between(0, 1), draw.over_decades(1e-6, 1e-3), draw.between(-3, 3)});
        rotor.planes.push_back({"", length * draw.between(0.1 + 0.5 * i, 0.4 + 0.5 * i)});
    }
    const double from = draw.between(20, 400);
    scene.speeds = model::SpeedRange{from, from + draw.between(50, 800), 3};
    scene.campbell.modes = 6;
    scene.campbell.multiples = {1};
    return scene;
}

} // namespace whirl::properties

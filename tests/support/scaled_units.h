#pragma once

#include "model/case.h"
#include "support/balancer_parts.h"

namespace whirl::tests {

/// The numbers of a case in other units: lengths, masses and times times these factors. With powers
/// of two every number keeps its digits.
struct Units {
    double length = 1;
    double mass = 1;
    double time = 1;

    [[nodiscard]] double inertia() const { return mass * length * length; }
    [[nodiscard]] double force() const { return mass * length / (time * time); }
    [[nodiscard]] double stiffness() const { return mass / (time * time); }
    [[nodiscard]] double damping() const { return mass / time; }
    [[nodiscard]] double moment() const { return force() * length; }
};

inline void scale_shaft(model::Shaft &shaft, const Units &u) {
    for (model::Segment &segment : shaft.segments) {
        for (double *length : {&segment.length, &segment.outer_start, &segment.outer_end,
                               &segment.inner_start, &segment.inner_end})
            *length *= u.length;
        segment.material.E *= u.stiffness() / u.length;
        segment.material.G *= u.stiffness() / u.length;
        segment.material.rho *= u.mass / (u.length * u.length * u.length);
    }
    shaft.internal_damping *= u.time;
    shaft.axial_force *= u.force();
}

inline void scale_bearing(model::Bearing &bearing, const Units &u) {
    bearing.z *= u.length;
    for (double &speed : bearing.speeds)
        speed /= u.time;
    for (model::BearingCoefficients &row : bearing.rows) {
        row.k *= u.stiffness();
        row.c *= u.damping();
        row.kt *= u.moment();
        row.ct *= u.moment() * u.time;
    }
    if (bearing.pedestal) {
        bearing.pedestal->mass *= u.mass;
        bearing.pedestal->k *= u.stiffness();
        bearing.pedestal->c *= u.damping();
    }
}

inline void scale_balancer(model::Balancer &balancer, const Units &u) {
    balancer.z *= u.length;
    scale_parts(balancer, u.length, u.mass, u.time);
    balancer.imbalance *= u.mass * u.length;
    if (balancer.imbalance_radius)
        *balancer.imbalance_radius *= u.length;
}

inline void scale_settings(model::Case &scene, const Units &u) {
    if (scene.speeds) {
        scene.speeds->from /= u.time;
        scene.speeds->to /= u.time;
    }
    model::SimulateSettings &s = scene.simulate;
    s.time *= u.time;
    for (auto &[time, speed] : s.run_up) {
        time *= u.time;
        speed /= u.time;
    }
    if (s.torque)
        *s.torque *= u.moment();
    s.torque_slope *= u.moment() * u.time;
    s.inertia *= u.inertia();
    s.gravity *= u.length / (u.time * u.time);
}

/// Everything that a file can give but for maps.
[[nodiscard]] inline model::Case scaled(model::Case scene, const Units &u) {
    model::Rotor &rotor = scene.rotor;
    scale_shaft(rotor.shaft, u);
    for (model::Disc &disc : rotor.discs) {
        disc.z *= u.length;
        disc.mass *= u.mass;
        disc.Id *= u.inertia();
        disc.Ip *= u.inertia();
        disc.outer *= u.length;
        disc.width *= u.length;
    }
    for (model::Bearing &bearing : rotor.bearings)
        scale_bearing(bearing, u);
    for (model::Anisotropy &anisotropy : rotor.anisotropies) {
        anisotropy.z *= u.length;
        anisotropy.dI *= u.inertia();
    }
    for (model::Balancer &balancer : rotor.balancers)
        scale_balancer(balancer, u);
    for (model::CorrectionPlane &plane : rotor.planes)
        plane.z *= u.length;
    for (model::Imbalance &imbalance : rotor.imbalances) {
        imbalance.z *= u.length;
        imbalance.mr *= u.mass * u.length;
    }
    for (model::Probe &probe : rotor.probes)
        probe.z *= u.length;
    scale_settings(scene, u);
    return scene;
}

} // namespace whirl::tests

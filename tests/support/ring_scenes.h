#pragma once

#include "support/scenes.h"

namespace whirl::tests {

/// Rings of steel that hang on a journal with 10 mm of clearance.
inline model::Balancer ring_balancer(double z, int n, double imbalance) {
    model::Rings rings;
    rings.n = n;
    rings.mass = 0.1;
    rings.journal_radius = 0.04;
    rings.clearance = 0.01;
    rings.inertia = rings.mass * (0.06 * 0.06 + 0.05 * 0.05) / 2;
    rings.damping = 2;
    rings.drag = 1e-3;
    model::Balancer balancer;
    balancer.z = z;
    balancer.parts = rings;
    balancer.imbalance = imbalance;
    return balancer;
}

/// A Jeffcott rotor: 10 kg in the middle of a stiff shaft without mass, critical at 100 rad/s, with
/// two rings of capacity E = 2.
inline model::Case ring_rotor(double speed) {
    model::Case scene;
    scene.name = "rings";
    scene.rotor.shaft = uniform_shaft(1, 0.04, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(0.5, 10, 1, 0.1)};
    scene.rotor.bearings = {isotropic_bearing(0, 5e4, 100), isotropic_bearing(1, 5e4, 100)};
    scene.rotor.balancers = {ring_balancer(0.5, 2, 1e-3)};
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = 20;
    return scene;
}

} // namespace whirl::tests

#pragma once

#include "support/balancer_parts.h"
#include "support/scenes.h"

namespace whirl::tests {

/// The rotor of the empirical criterion (G. Filimonikhin et al.): M = 60 kg, A = 3, C = 1 kg m2,
/// k1 = 2e6 and k2 = 3e6 N/m at l1 = 0.4 and l2 = 0.5 m, on an elastic shaft without mass.
inline model::Case two_support_case() {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(0.9, 0.06, weightless_steel());
    scene.rotor.discs = {disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {isotropic_bearing(0, 2e6), isotropic_bearing(0.9, 3e6)};
    return scene;
}

/// Source: A. N. Gorbenko, On the permissible level of inertial anisotropy of a gyroscopic rotor:
/// A = 1, C = 0.8, a = 0.1 kg m2, p = 1.25 rad/s, h = 0.156 1/s, in the middle of an elastic shaft
/// of 60 times the stiffness of the bearings, without mass.
inline model::Case anisotropic_case() {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(2, 0.02, weightless_steel());
    scene.rotor.shaft.segments[0].material.E = 2e9;
    scene.rotor.shaft.segments[0].material.G = 7.7e8;
    scene.rotor.discs = {disc_at(1, 10, 1, 0.8)};
    scene.rotor.anisotropies = {{"", 1, 0.1, 0.3}};
    scene.rotor.bearings = {isotropic_bearing(0, 0.78125, 0.078),
                            isotropic_bearing(2, 0.78125, 0.078)};
    scene.speeds = model::SpeedRange{0, 6, 121};
    return scene;
}

/// The same on a shaft whose own modes are not far above the rotor's, which analyses of free
/// motion need.
inline model::Case heavier_anisotropic_case() {
    model::Case scene = anisotropic_case();
    scene.rotor.shaft = uniform_shaft(2, 0.2, {"soft", 2e5, 7.7e4, 1});
    scene.rotor.shaft.order = 2;
    return scene;
}

/// Two balls with their point-mass imbalance off the middle of a rotor on an elastic shaft.
inline model::Case balancer_case() {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(0.9, 0.08, steel());
    scene.rotor.discs = {disc_at(0.4, 57.83, 0.413, 0.289)};
    model::Balancer balancer;
    balancer.z = 0.5;
    tests::row(balancer).mass = 2;
    tests::row(balancer).radius = 0.2;
    tests::row(balancer).damping = 20;
    balancer.imbalance = 0.4;
    balancer.imbalance_radius = 0.3;
    scene.rotor.balancers = {balancer};
    scene.rotor.bearings = {isotropic_bearing(0.1, 2e6, 500), isotropic_bearing(0.8, 2e6, 500)};
    return scene;
}

} // namespace whirl::tests

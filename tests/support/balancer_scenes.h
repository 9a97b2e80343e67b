#pragma once

#include "support/balancer_parts.h"
#include "support/scenes.h"

#include <numbers>
#include <utility>
#include <vector>

namespace whirl::tests {

inline model::Balancer ball_balancer(double z, int n, double mass, double radius, double damping,
                                     double imbalance = 0) {
    model::Balancer balancer;
    balancer.z = z;
    tests::row(balancer).n = n;
    tests::row(balancer).mass = mass;
    tests::row(balancer).radius = radius;
    tests::row(balancer).damping = damping;
    balancer.imbalance = imbalance;
    return balancer;
}

/// Rodrigues, Champneys, Friswell, Wilson: two balls in each of two planes z = +-2 about the
/// centre of mass of a rigid rotor, lengths in ball radii, masses in rotor masses, time in
/// 1/Omega_1; Jt = 3.25, Jp = 0.5, k11 = 1, k22 = 9, C = 0.02 K, race damping 0.01; static
/// eccentricity. Here the shaft is 8 long, the centre at z = 4, a bearing with k = 1/2 at 3 to
/// either side (k11 = 2 k, k22 = 2 k 9). Balls start at +-90 deg, one of them 0.01 rad off.
inline model::Case rodrigues_rotor(double speed, double eccentricity, double ball_mass) {
    constexpr double centre = 4;
    model::Case scene;
    scene.name = "rodrigues";
    scene.rotor.shaft = uniform_shaft(2 * centre, 0.01, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(centre, 1, 3.25, 0.5)};
    scene.rotor.bearings = {isotropic_bearing(centre - 3, 0.5, 0.01),
                            isotropic_bearing(centre + 3, 0.5, 0.01)};
    scene.rotor.imbalances = {imbalance_at(centre, eccentricity)};
    for (const double z : {-2.0, 2.0})
        scene.rotor.balancers.push_back(
            ball_balancer(centre + z, 2, ball_mass, 1, 0.01 * ball_mass));
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = 600;
    const double quarter = std::numbers::pi / 2;
    scene.simulate.ball_angles = {{quarter + 0.01, -quarter}, {quarter, -quarter}};
    return scene;
}

/// Jeffcott rotor with two balls (K. Green, A. R. Champneys, N. J. Lieven; J. Chung and D. Ro) in
/// units of M, R and sqrt(k/M): delta = eps/R = 0.01, zeta = 0.01, beta = 0.01.
inline model::Case jeffcott_two_balls(double ball_mass) {
    model::Case scene;
    scene.rotor.shaft = uniform_shaft(2, 0.01, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(1, 1, 1, 0.1)};
    scene.rotor.bearings = {isotropic_bearing(0, 0.5, 0.01), isotropic_bearing(2, 0.5, 0.01)};
    scene.rotor.balancers = {ball_balancer(1, 2, ball_mass, 1, 0.01 * ball_mass, 0.01)};
    scene.rotor.balancers[0].tilt_inertia = false; // a planar rotor
    scene.speeds = model::SpeedRange{0.6, 3, 121};
    return scene;
}

/// A steel shaft of 1.2 m on soft damped bearings with two discs; a race with three balls at the
/// first, one with a point-mass imbalance at the second.
inline model::Case flexible_rotor(double speed) {
    model::Case scene;
    scene.name = "flexible";
    scene.rotor.shaft = uniform_shaft(1.2, 0.04, steel());
    scene.rotor.shaft.segments.front().elements = 4;
    scene.rotor.shaft.order = 3;
    scene.rotor.discs = {disc_at(0.3, 12, 0.06, 0.11), disc_at(0.85, 15, 0.08, 0.15)};
    scene.rotor.bearings = {isotropic_bearing(0, 8e5, 300), isotropic_bearing(1.2, 6e5, 400)};
    scene.rotor.balancers = {ball_balancer(0.3, 3, 0.02, 0.08, 0.3, 0.002),
                             ball_balancer(0.85, 2, 0.03, 0.07, 0.4, 0.0025)};
    scene.rotor.balancers[1].imbalance_radius = 0.05;
    scene.rotor.imbalances = {imbalance_at(0.6, 5e-4, 1.0)};
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = 0.5;
    scene.simulate.ball_angles = {{0.5, 2.5, -2.0}, {1.0, -1.5}};
    return scene;
}

/// The four-pendulum rotor of the first figure of its paper: M = 5 kg, m = 1 kg, l = 18 cm,
/// a = 2 cm, on a rigid symmetric rotor whose plane moves without tilt.
/// @param speed_ratio       spin speed over sqrt(c / M_Sigma)
/// @param external,hinge    H and h of the paper
/// @param imbalance         M e, kg m
inline model::Case pendulum_rotor_scene(double speed_ratio, double external, double hinge,
                                        double imbalance) {
    constexpr double mass = 5 + 4;
    constexpr double stiffness = 9e4;
    const double natural = 100; // sqrt(9e4 / 9)
    model::Case scene;
    scene.name = "pendulums";
    scene.rotor.shaft = uniform_shaft(1, 0.01, weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {disc_at(0.5, 5, 0.4, 0.1)};
    const double c = external * mass * natural;
    scene.rotor.bearings = {isotropic_bearing(0, stiffness / 2, c / 2),
                            isotropic_bearing(1, stiffness / 2, c / 2)};
    scene.rotor.imbalances = {imbalance_at(0.5, imbalance)};
    model::Balancer pendulums;
    pendulums.z = 0.5;
    tests::pendulums_of(pendulums).mass = 1;
    tests::pendulums_of(pendulums).arm = 0.18;
    tests::pendulums_of(pendulums).pivot = 0.02;
    tests::pendulums_of(pendulums).damping = hinge * 0.18 * 0.18 * natural;
    scene.rotor.balancers = {pendulums};
    scene.speeds = model::SpeedRange{speed_ratio * natural, speed_ratio * natural, 1};
    scene.simulate.time = 10;
    scene.simulate.ball_angles = {{0.05, -0.02}};
    return scene;
}

} // namespace whirl::tests

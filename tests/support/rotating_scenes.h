#pragma once

#include "closed_form/balanced_position.h"
#include "closed_form/composite_rotor_matrices.h"
#include "model/case.h"
#include "support/balancer_parts.h"
#include "support/test_rotors.h"

#include <cmath>
#include <complex>
#include <vector>

namespace whirl::tests {

/// A shaft that only holds parts together: below 1e-15 kg.
inline model::Shaft weightless_rigid_shaft(double length) {
    model::Shaft shaft;
    shaft.segments = {{length, 0.02, 0.02, 0, 0, {"weightless", 2e11, 7.7e10, 1e-12}}};
    shaft.rigid = true;
    return shaft;
}

inline model::Bearing round_bearing(double z, double k, double c = 0) {
    return bearing(z, k, k, 0, c);
}

inline model::Case scene_of(model::Rotor rotor, double from, double to, int count) {
    model::Case scene;
    scene.name = "scene";
    scene.rotor = std::move(rotor);
    scene.speeds = model::SpeedRange{from, to, count};
    return scene;
}

/// Three balls in a balanced position without symmetry: one at 2.6 rad, two close the polygon.
inline std::vector<double> unsymmetric_position(double E) {
    const std::complex<double> rest(-3.0 / E - std::cos(2.6), -std::sin(2.6));
    const double opening = std::acos(0.5 * std::abs(rest));
    return {2.6, std::arg(rest) + opening, std::arg(rest) - opening};
}

/// The same rigid rotor with one ball balancer as a scene and for the closed forms.
struct CompositeScene {
    model::Rotor rotor;
    closed_form::FixedFrameRotor exact;
};

struct CompositeInput {
    closed_form::BareRotor bare{57.83, 1.413, 0.889, 0.1};
    double E = 1.6;
    double imbalance = 0.5;         ///< kg m
    double imbalance_radius = 0.25; ///< m
    double radius = 0.2;
    double damping = 0.9;
    double left_k = 3e4, left_c = 40, right_k = 5e4, right_c = 90;
    double left = -0.3, right = 0.35; ///< bearings from the common centre of mass, m
};

inline CompositeScene composite_scene(const CompositeInput &in, const std::vector<double> &angles) {
    const auto n = static_cast<int>(angles.size());
    const double ball = in.E * in.imbalance / (n * in.radius);
    const closed_form::BallSet balls{n, ball, in.radius, in.damping};
    const closed_form::PlaneImbalance imbalance{in.imbalance, in.imbalance / in.imbalance_radius};
    const auto D = closed_form::second_harmonic(angles);
    const auto body = closed_form::composite_rotor(in.bare, balls, imbalance, D);
    CompositeScene out;
    out.exact.physical = closed_form::physical_parameters(
        in.bare, balls, imbalance, D,
        closed_form::reduced_supports({in.left_k, in.left_c, in.left},
                                      {in.right_k, in.right_c, in.right}),
        1.0);
    out.exact.ball_angles = angles;
    const double centre = 0.55; // of mass, in the scene
    out.rotor.shaft = weightless_rigid_shaft(1.1);
    out.rotor.discs = {disc(centre + body.rotor_position, in.bare.mass, in.bare.diametral_inertia,
                            in.bare.polar_inertia)};
    out.rotor.bearings = {round_bearing(centre + in.left, in.left_k, in.left_c),
                          round_bearing(centre + in.right, in.right_k, in.right_c)};
    model::Balancer balancer;
    balancer.z = centre + body.balancer_position;
    tests::row(balancer).n = n;
    tests::row(balancer).mass = ball;
    tests::row(balancer).radius = in.radius;
    tests::row(balancer).damping = in.damping;
    balancer.imbalance = in.imbalance;
    balancer.imbalance_radius = in.imbalance_radius;
    balancer.position = angles;
    out.rotor.balancers = {balancer};
    return out;
}

/// Rigid rotor of mean diametral inertia 1 in the middle between two bearings at -+1 m, so that
/// sum k z^2 = p^2 and sum c z^2 = h: the rotor of closed_form::AnisotropicRotor as a scene.
inline model::Rotor tilt_rotor(double C, double a, double p, double h) {
    model::Rotor rotor;
    rotor.shaft = weightless_rigid_shaft(2);
    rotor.discs = {disc(1, 10, 1, C)};
    model::Anisotropy anisotropy;
    anisotropy.z = 1;
    anisotropy.dI = a;
    rotor.anisotropies = {anisotropy};
    rotor.bearings = {round_bearing(0, p * p / 2, h / 2), round_bearing(2, p * p / 2, h / 2)};
    return rotor;
}

} // namespace whirl::tests

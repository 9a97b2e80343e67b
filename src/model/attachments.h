#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::model {

/// Rotating inertial anisotropy at z: diametral inertias Id + dI and Id - dI about two
/// perpendicular axes that turn with the rotor.
struct Anisotropy {
    std::string name;
    double z = 0;     ///< m
    double dI = 0;    ///< kg m2
    double angle = 0; ///< direction of the axis of smaller inertia in the rotor, rad
};

enum class BalancerKind {
    ball,     ///< equal balls rolling in a race filled with fluid
    pendulum4 ///< two tied pairs of pendulums on two perpendicular lines
};

/// A passive auto-balancer at z.
struct Balancer {
    std::string name;
    double z = 0; ///< m
    BalancerKind kind = BalancerKind::ball;
    int n = 2;                  ///< number of balls (ball)
    double mass = 0;            ///< of one ball or pendulum, kg
    double radius = 0;          ///< of the circle of ball centres, m (ball)
    double arm = 0;             ///< m (pendulum4)
    double pivot = 0;           ///< radius of the pivots, m (pendulum4)
    double damping = 0;         ///< ball: N s/m along the race; pendulum4: N m s/rad at the hinge
    double imbalance = 0;       ///< m0 R0 that it is to balance, kg m
    double imbalance_phase = 0; ///< direction of that imbalance in the rotor, rad
    std::optional<double> imbalance_radius; ///< R0, m: the imbalance is a point mass that counts
    bool tilt_inertia = true; ///< false: balls and imbalance as if on the axis, for comparison with
                              ///< models that leave their moments of inertia out
    std::vector<double> position; ///< ball angles in the rotor, rad; empty: symmetric position
};

/// A correction plane for the empirical criterion.
struct CorrectionPlane {
    std::string name;
    double z = 0; ///< m
};

/// A displacement sensor beside the shaft, which does not turn: it reads x cos(angle) + y
/// sin(angle).
struct Probe {
    std::string name;
    double z = 0;     ///< m
    double angle = 0; ///< direction in which it looks, from x towards y, rad
};

/// A small static imbalance fixed in the rotor.
struct Imbalance {
    std::string name;
    double z = 0;     ///< m
    double mr = 0;    ///< mass times radius, kg m
    double phase = 0; ///< rad
};

} // namespace whirl::model

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// A steady motion with four-pendulum balancers, seen at one of them.
struct PendulumState {
    double ratio = 0;  ///< shaft deflection over that with the pendulums held
    double phi = 0;    ///< rad
    double psi = 0;    ///< rad
    double growth = 0; ///< largest real part of small motions about it, 1/s
    bool stable = false;
    bool collision = false; ///< |phi| or |psi| reaches pi/4 here or at another balancer
};

/// Efficiency of the planar rotor over the speed ratio, for one design and one damping.
struct PendulumCurve {
    double arm = 0;              ///< m
    double pivot = 0;            ///< m
    double rho = 0;              ///< R_m / R_a
    double external_damping = 0; ///< H
    std::vector<double> ratios;  ///< R_w = omega / omega_0
    std::vector<double> approximate;
    std::vector<std::optional<double>> exact; ///< least deflection; none where there is no motion
    std::vector<bool> stable;                 ///< that motion
};

struct PendulumBalance {
    std::string name;
    double z = 0;                              ///< m
    double rho = 0;                            ///< R_m / R_a
    double threshold = 0;                      ///< speed ratio above which n < 1
    double limit = 0;                          ///< n of fast rotation
    double mass = 0;                           ///< M_Sigma of the planar equivalent, kg
    double omega_0 = 0;                        ///< its resonance, rad/s
    double external_damping = 0;               ///< H
    double hinge_damping = 0;                  ///< h
    std::vector<double> speeds;                ///< rad/s
    std::vector<double> approximate;           ///< planar, small angles
    std::vector<std::optional<double>> planar; ///< planar, exact: least deflection
    /// Every steady motion found on the flexible shaft, [speed], ascending by deflection.
    std::vector<std::vector<PendulumState>> states;
    std::vector<PendulumCurve> designs;  ///< [balance] designs, at the first damping
    std::vector<PendulumCurve> dampings; ///< the case's own design at each damping
};

} // namespace whirl::results

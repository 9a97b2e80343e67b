#pragma once

#include "results/interval.h"
#include "results/model_summary.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// Dimensionless numbers of the whole rotor (docs/theory.md, "Composite rotor"): units of mass
/// M_s, of length sqrt(A_Sigma/M_s), of time sqrt(M_s/c_x). Those that need the bearings are empty
/// where these do not reduce to isotropic coefficients.
struct RotorNumbers {
    double C = 0;            ///< polar inertia over the mean diametral one, A_Sigma
    std::optional<double> A; ///< anisotropy over A_Sigma; none: a balancer has no balanced position
    std::optional<double> p2, c_y, h_x, h_beta, h_y;
    std::optional<double> omega_0; ///< sqrt(c_x/M_s), rad/s
};

/// The same of one balancer and the rotor around it.
struct DimensionlessNumbers {
    RotorNumbers rotor;        ///< its A: |A_m0 + A_m D|/2 over A_Sigma, with a balanced position
    double A_m = 0;            ///< n m R^2 over A_Sigma
    double A_m0 = 0;           ///< m0 R0^2 over A_Sigma
    double m = 0;              ///< n m over M_s
    double z_A = 0;            ///< plane of the balancer from the centre of mass
    std::optional<double> h_s; ///< damping rate of its parts over omega_0
};

/// The rotor without one of its balancers and that one's point-mass imbalance.
struct BareRotorNumbers {
    double mass = 0; ///< kg
    double Id = 0;   ///< mean diametral, about its own centre of mass, kg m2
    double Ip = 0;   ///< kg m2
    double z_GA = 0; ///< from its centre of mass to the balancer, m
};

/// Curves of the composite rotor over the mass of the balls at the case's capacity, all inertias
/// over A_Sigma. "paper": with the unsigned D_A = |D| in place of D.
struct CompositeCurves {
    std::vector<double> m; ///< n m/M_s
    std::vector<double> A_m, C;
    std::vector<double> A_C1, A_C2;             ///< about angles 0 and pi/2; principal ones where
    std::vector<double> A_C1_paper, A_C2_paper; ///< D is not real
    std::vector<double> A, A_paper;             ///< anisotropy
    std::vector<double> A_without, A_full;      ///< for D_A = 0 and 1
    std::vector<double> A_least, A_largest;     ///< over all balanced positions; may be empty
    std::vector<double> angle;                  ///< rad, once around
    std::vector<double> A_C, A_C_paper;         ///< diametral inertia about that angle, case's mass
};

/// What a balancer adds to the rotor at its balanced position, or where its parts are held. Without
/// such a position (E < 1) what depends on it is empty.
struct BalancerNumbers {
    std::string name;
    double z = 0;                 ///< m
    double E = 0;                 ///< capacity, infinite without an imbalance
    bool held = false;            ///< its parts are fixed in the rotor, where `position` says
    std::vector<double> position; ///< in the rotor, rad
    std::optional<std::complex<double>> D;
    std::optional<Interval> D_interval; ///< of |D| over all balanced positions
    std::optional<double> dA;           ///< |A_m0 + A_m D|/2, kg m2
    std::optional<Interval> dA_interval;
    std::optional<double> dA_paper; ///< (A_m0 + A_m |D|)/2, kg m2
    BareRotorNumbers bare;
    DimensionlessNumbers dimensionless;
    std::optional<CompositeCurves> curves;
};

/// A band of spin speed, rad/s; no upper end: up to infinity.
struct ChartBand {
    double from = 0;
    std::optional<double> to;
};

/// Critical speeds and stability limits of a rigid rotor with unequal diametral inertias,
/// symmetric on isotropic supports; its tilt motion (docs/theory.md).
struct AnisotropyChart {
    double C = 0;          ///< polar inertia over the mean diametral one
    double anisotropy = 0; ///< half the difference of the diametral inertias over their mean
    double p = 0;          ///< natural frequency of tilt at rest, rad/s
    double h = 0;          ///< tilt damping over the mean diametral inertia, 1/s
    std::vector<double> critical_speeds; ///< rad/s
    std::optional<ChartBand> unstable;
    double permissible = 0;                  ///< largest anisotropy stable at every speed
    std::optional<double> permissible_speed; ///< where it is least; none: at infinity
    std::vector<double> speed;               ///< rad/s, the axis of the next two
    std::vector<double> limit, undamped;     ///< anisotropy at the stability limit, and at a
                                             ///< critical speed
    std::vector<double> polar;               ///< C, the axis of the next two
    std::vector<std::vector<double>> critical_over_polar;
    std::vector<std::optional<ChartBand>> unstable_over_polar;
};

/// Of a station under the weight: where the shaft stands, and how its section is turned there.
struct SagStation {
    double z = 0;
    std::string name;       ///< of what is attached there, or empty
    double x = 0, y = 0;    ///< deflection, m; the weight acts along -y
    double slope_x = 0;     ///< rotation of the section in the plane z-x, rad
    double slope_y = 0;     ///< in the plane z-y; without shear dy/dz
    double error = 0;       ///< estimated, relative to the size of the deflection
    double slope_error = 0; ///< the same of the slope
};

/// What the shaft lays on a bearing.
struct SagBearing {
    double z = 0;
    std::string name;
    double load = 0;  ///< downwards, N; negative: the shaft pulls it up
    double side = 0;  ///< along x, N
    double error = 0; ///< estimated, relative to the size of both
};

/// A rotor at rest under the weight of shaft and discs.
struct StaticSag {
    double gravity = 0; ///< m/s2 along -y
    std::vector<SagStation> stations;
    std::vector<SagBearing> bearings;
};

/// What the scene is.
struct ShowResult {
    ModelSummary model;
    double mass = 0;           ///< kg, with balls and point-mass imbalances
    double center_of_mass = 0; ///< m
    double Id = 0;             ///< mean diametral, about the centre of mass, kg m2
    double Ip = 0;             ///< polar, kg m2
    std::string type;          ///< "long", "spherical" or "short"
    double shaft_mass = 0;     ///< kg
    double length = 0;         ///< m
    std::vector<std::pair<std::string, Formulation>> formulations; ///< command, what it will use
    std::optional<double> dI;       ///< principal diametral inertias Id -+ dI, kg m2
    std::optional<double> dI_angle; ///< axis of the smaller one in the rotor, rad
    RotorNumbers dimensionless;
    std::vector<BalancerNumbers> balancers;
    std::optional<AnisotropyChart> anisotropy;
    std::optional<StaticSag> sag; ///< none: nothing carries the weight
};

} // namespace whirl::results

#pragma once

#include "closed_form/composite_rotor.h"

namespace whirl::closed_form {

/// The nineteen physical parameters of the composite rotor with its auto-balancer (S.I. units).
struct PhysicalParameters {
    double spin_speed = 0.0;              ///< rad/s
    double mass = 0.0;                    ///< kg, M_s
    double base_inertia = 0.0;            ///< kg m2, A_s
    double polar_inertia = 0.0;           ///< kg m2, C_r of the bare rotor
    double balancer_position = 0.0;       ///< m, z_A
    ReducedSupports supports;             ///< six of them
    PlaneImbalance imbalance;             ///< m0 and R0 (as the moment m0 R0)
    BallSet balls;                        ///< n, m, R, h_A
    std::complex<double> second_harmonic; ///< D_c, D_s
};

[[nodiscard]] PhysicalParameters physical_parameters(const BareRotor &rotor, const BallSet &balls,
                                                     const PlaneImbalance &imbalance,
                                                     std::complex<double> second_harmonic,
                                                     const ReducedSupports &supports,
                                                     double spin_speed);

/// The thirteen dimensionless parameters that decide stability, D_c with its sign, and a
/// fourteenth, D_s, for positions of the balls that are not symmetric about the imbalance. Unit of
/// time 1/omega_0, omega_0 = sqrt(c_x/M_s); of mass M_s; of length rho_s = sqrt(A_Sigma/M_s).
struct DimensionlessParameters {
    double polar_inertia = 0.0;     ///< C / A_Sigma
    double balancer_position = 0.0; ///< z_A / rho_s
    double h_x = 0.0;               ///< h_x / (M_s omega_0)
    double h_beta = 0.0;            ///< h_beta / (A_Sigma omega_0)
    double h_y = 0.0;               ///< h_y / (sqrt(M_s A_Sigma) omega_0)
    double p = 0.0;                 ///< sqrt(c_beta / (A_Sigma omega_0^2))
    double c_y = 0.0;               ///< c_y / (sqrt(M_s A_Sigma) omega_0^2)
    double ball_mass = 0.0;         ///< n m / M_s
    double h_s = 0.0;               ///< h_A / (m omega_0)
    std::complex<double>
        second_harmonic;            ///< D_c (the thirteenth in the list), D_s (the fourteenth)
    double imbalance_inertia = 0.0; ///< A_m0 / A_Sigma
    double ball_inertia = 0.0;      ///< A_m / A_Sigma
    double spin_speed = 0.0;        ///< Omega / omega_0

    /// (A_m0 + A_m D) / (2 A_Sigma).
    [[nodiscard]] std::complex<double> anisotropy() const;
};

[[nodiscard]] DimensionlessParameters to_dimensionless(const PhysicalParameters &physical);

} // namespace whirl::closed_form

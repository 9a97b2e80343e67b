#pragma once

#include <complex>
#include <vector>

namespace whirl::closed_form {

/// Rigid rotor with a ball auto-balancer and an imbalance in one plane, seen as one body while the
/// balls stand at a balanced position. Source: A. N. Gorbenko, Mass-inertia characteristics and
/// dimensionless equations of motion of a rotor with an auto-balancer; its D_A >= 0 is replaced by
/// the signed, complex D.

/// Axisymmetric rotor without balls and imbalance; G its centre of mass.
struct BareRotor {
    double mass = 0.0;              ///< kg, M_r
    double diametral_inertia = 0.0; ///< kg m2, A_r about G
    double polar_inertia = 0.0;     ///< kg m2, C_r
    double balancer_distance = 0.0; ///< m, z_GA from G to the plane A of balls and imbalance
};

/// n equal point balls.
struct BallSet {
    int count = 0;
    double mass = 0.0;    ///< kg, of one ball
    double radius = 0.0;  ///< m
    double damping = 0.0; ///< N s/m, h_A of one ball against the rotor
};

/// Imbalance in the balancer's plane, at angle 0.
struct PlaneImbalance {
    double moment = 0.0; ///< kg m, m0 R0
    double mass =
        0.0; ///< kg, m0; 0 for the rotor's own eccentricity, which adds neither mass nor inertia

    /// A_m0 = m0 R0^2, kg m2.
    [[nodiscard]] double inertia() const { return mass > 0.0 ? moment * moment / mass : 0.0; }
};

struct CompositeRotor {
    double mass = 0.0;              ///< kg, M_s = M_r + m0 + n m
    double balancer_position = 0.0; ///< m, z_A of the plane A from the common centre of mass C
    double rotor_position = 0.0;    ///< m, z_G of the bare rotor's centre of mass from C
    double base_inertia = 0.0;      ///< kg m2, A_s = A_r + M_r z_G^2 + (m0 + n m) z_A^2
    double polar_inertia = 0.0;     ///< kg m2, C = C_r + A_m0 + A_m
    double ball_inertia = 0.0;      ///< kg m2, A_m = n m R^2
    double imbalance_inertia = 0.0; ///< kg m2, A_m0
    std::complex<double> second_harmonic; ///< D = D_c + i D_s

    /// A_Sigma = A_s + (A_m0 + A_m)/2, kg m2.
    [[nodiscard]] double mean_inertia() const;
    /// a = (A_m0 + A_m D)/2, kg m2: modulus of the anisotropy, and twice the direction of the axis
    /// of smaller inertia as argument.
    [[nodiscard]] std::complex<double> anisotropy() const;
    /// Diametral inertia about the axis at `angle` in the rotor, A_Sigma - Re[a exp(-2 i angle)],
    /// kg m2. A_C1 is the value at 0 (the line of the imbalance) and A_C2 the one at pi/2 when D is
    /// real.
    [[nodiscard]] double inertia_about(double angle) const;
    /// The same body as the paper describes it, with D_A = |D| in place of D: right only for real D
    /// >= 0.
    [[nodiscard]] CompositeRotor with_unsigned_harmonic() const;
};

[[nodiscard]] CompositeRotor composite_rotor(const BareRotor &rotor, const BallSet &balls,
                                             const PlaneImbalance &imbalance,
                                             std::complex<double> second_harmonic);

/// Isotropic supports reduced to the common centre of mass C: force per deflection (x), moment per
/// slope (beta), and force per slope = moment per deflection (y).
struct ReducedSupports {
    double c_x = 0.0;    ///< N/m
    double c_beta = 0.0; ///< N m
    double c_y = 0.0;    ///< N
    double h_x = 0.0;    ///< N s/m
    double h_beta = 0.0; ///< N m s
    double h_y = 0.0;    ///< N s
};

} // namespace whirl::closed_form

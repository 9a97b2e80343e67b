#pragma once

#include "closed_form/composite_rotor_equations.h"
#include "closed_form/composite_rotor_parameters.h"

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace whirl::closed_form {

/// One support: stiffness N/m, damping N s/m, position z from C, m.
struct Support {
    double stiffness = 0.0;
    double damping = 0.0;
    double position = 0.0;
};

/// c_x = sum c, c_y = sum c z, c_beta = sum c z^2, and the same for damping. The left support is at
/// z = -l_cL, the right one at z = l_cR (negative for an overhung rotor).
[[nodiscard]] ReducedSupports reduced_supports(const Support &left, const Support &right);

/// Coefficients of the equations in the rotating frame, dimensional or dimensionless:
/// M_s a_C + h_x w' + h_y phi' + c_x w + c_y phi + b = 0,
/// A (phi'' ) - i Omega C phi' + a conj(phi'' + Omega^2 phi) + h_beta phi' + h_y w' + c_beta phi +
/// c_y w
///   + z_A b = 0 and s'' + h_s s' + (n m/2)(a_A - D conj a_A) = 0,
/// where primes on w, phi outside the conjugate are absolute (d/dt + i Omega) and b = s'' + 2 i
/// Omega s'
/// - Omega^2 s.
struct RotatingEquations : RotatingCoefficients {
    double ball_mass = 0.0;               ///< n m
    double h_s = 0.0;                     ///< h_A / m
    std::complex<double> second_harmonic; ///< D
    double spin_speed = 0.0;              ///< Omega
};
[[nodiscard]] RotatingEquations rotating_coefficients(const PhysicalParameters &physical);
[[nodiscard]] RotatingEquations rotating_coefficients(const DimensionlessParameters &dimensionless);

/// M q'' + C q' + K q = 0 of the composite rotor; q = (x, y of the centre of mass C; slopes phi_x,
/// phi_y; s_x, s_y). s = sum m R i exp(i a_j) eps_j (kg m) is the balls' displacement from balance.
/// The frame is in the name of the function that makes it.
struct MotionMatrices {
    Eigen::MatrixXd M;
    Eigen::MatrixXd C;
    Eigen::MatrixXd K;
};

/// Constant matrices in the rotating frame.
[[nodiscard]] MotionMatrices rotating_frame_matrices(const RotatingEquations &coefficients);

/// The rotor of the periodic equations: an axisymmetric body with point masses on it, ball by ball.
struct FixedFrameRotor {
    PhysicalParameters physical;     ///< its second_harmonic is not read
    std::vector<double> ball_angles; ///< rad, in the rotor from the imbalance; a balanced position
};

/// Periodic matrices in the fixed frame at time t (s), q with S = s exp(i Omega t) in place of s.
/// Written from the energy of the point masses, T_j = m R^2 (c'^2 - g'^2 c^2)/2 with c = Re(phi
/// exp(-i g)) at angle g = Omega t + a_j, which gives m R^2 e (e . phi'' + 2 Omega e' . phi') with
/// e = (cos g, sin g); independent of the rotating matrices, D and the mean inertias.
[[nodiscard]] MotionMatrices fixed_frame_matrices(const FixedFrameRotor &rotor, double time);

/// The same motion with the balls held at their places: rows and columns of s deleted.
[[nodiscard]] MotionMatrices frozen_balls(const MotionMatrices &matrices);

/// First-order form z' = S z, z = (q, q').
[[nodiscard]] Eigen::MatrixXd state_matrix(const MotionMatrices &matrices);

/// Eigenvalues of constant matrices, 1/s, in no particular order.
[[nodiscard]] std::vector<std::complex<double>> eigenvalues(const MotionMatrices &matrices);

} // namespace whirl::closed_form

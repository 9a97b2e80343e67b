#pragma once

#include "closed_form/composite_rotor_equations.h"

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace whirl::closed_form {

/// M q'' + C q' + K q = 0 of the composite rotor; q = (x, y of the centre of mass C; slopes phi_x,
/// phi_y; s_x, s_y). s = sum m R i exp(i a_j) eps_j (kg m) is the balls' displacement from balance.
/// The frame is in the name of the function that makes it.
struct MotionMatrices {
    Eigen::MatrixXd M;
    Eigen::MatrixXd C;
    Eigen::MatrixXd K;
};

/// Constant matrices in the rotating frame.
[[nodiscard]] MotionMatrices rotating_frame_matrices(const RotatingCoefficients &coefficients);

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

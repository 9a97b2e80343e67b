#pragma once

#include "assembly/discretization.h"
#include "linalg/harmonic_solve.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::synchronous {

/// Forward synchronous receptance of a rotor at places of its shaft, times the spin speed squared:
/// the deflection (m) that turns with the rotor at all places under unit imbalances (1 kg m).
/// Forms:
///
/// planar: R = Omega^2 B^T [K + i Omega C_e - Omega^2 (M - G)]^-1 B over x + i y, one complex row
/// and column a place; internal damping drops out.
///
/// general: an axisymmetric rotor on bearings that differ; with H the receptance in (x, y) what a
/// turn leaves of it on the mean, R = 1/2 Omega^2 [H_xx + H_yy + i (H_yx - H_xy)].
///
/// rotating: a rotor that is not axisymmetric answers differently to imbalances of different
/// directions: real, R = Omega^2 B^T K_r(Omega)^-1 B with all that is constant in rotating axes,
/// two rows and columns a place, along the axes x and y of the rotor. hill: likewise, with the
/// constant term of the motion in rotating axes, its mean over a turn.
/// docs/theory.md, "The criterion on a flexible rotor".
class ForwardReceptance {
  public:
    /// @param form       planar only where the bearings are isotropic; rotating where they are the
    ///                   same from every direction
    /// @param places     combinations of planar unknowns; the discretisation must outlive this
    /// @param harmonics  form hill: terms of the series in twice the spin speed
    ForwardReceptance(const assembly::Discretization &rotor, results::Form form,
                      const std::vector<assembly::Combination> &places, int harmonics = 0);

    /// R at a spin speed (rad/s), 1/kg.
    /// @throws linalg::SolverError at an undamped resonance.
    [[nodiscard]] Eigen::MatrixXcd at(double speed);

    /// How far s^H R s can be off, to first order, by rounding of the entries of Z: epsilon times
    /// |u|^H |Z| |u| with the motion u under the imbalances s, 1/kg.
    /// @throws linalg::SolverError at an undamped resonance.
    [[nodiscard]] double rounding(double speed, const Eigen::VectorXcd &s);

    /// What moves under the imbalances, bearings as at a speed (rad/s), and the loads of the
    /// imbalances by the speed squared, a column each: R = speed^2 B^H Z(speed)^-1 B.
    [[nodiscard]] linalg::HarmonicTerms system(double bearing_speed) const;
    [[nodiscard]] const Eigen::MatrixXcd &places() const { return _places; }
    /// Rows of the bearing tables, between which their coefficients are linear (rad/s).
    [[nodiscard]] std::vector<double> table_speeds() const;

    /// Rows and columns of R.
    [[nodiscard]] Eigen::Index size() const { return _places.cols(); }
    /// Unknowns of the linear system, as real numbers.
    [[nodiscard]] int unknowns() const {
        return (results::in_rotating_axes(_form) ? 1 : 2) * _solver->size();
    }
    /// Nothing in the supports (general form: in the rotor either) takes energy out.
    [[nodiscard]] bool undamped() const { return _solver->conserves(); }

  private:
    const assembly::Discretization &_rotor;
    results::Form _form;
    int _harmonics;
    std::optional<linalg::HarmonicSolver> _solver; ///< of the bearings as at the last speed
    Eigen::MatrixXcd _places; ///< a column each; general: (1, -i)/sqrt 2 a place

    [[nodiscard]] Eigen::MatrixXcd motion(double speed, const Eigen::MatrixXcd &forces);
};

/// Rows and columns of R a place: an imbalance of an axisymmetric rotor is one complex number, of
/// another one its components along the two axes.
[[nodiscard]] inline int imbalances_a_place(results::Form form) {
    return results::in_rotating_axes(form) ? 2 : 1;
}

/// (R + R^H) / 2.
[[nodiscard]] Eigen::MatrixXcd hermitian_part(const Eigen::MatrixXcd &R);

} // namespace whirl::synchronous

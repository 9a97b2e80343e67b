#pragma once

#include "assembly/discretization.h"
#include "linalg/harmonic_solve.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::synchronous {

/// Forward synchronous receptance of a rotor at places of its shaft, times the spin speed squared:
/// column k is the deflection (m) at all places under a unit imbalance (1 kg m) at place k.
///
/// Isotropic bearings: R = Omega^2 B^T [K + i Omega C_e - Omega^2 (M - G)]^-1 B; internal damping
/// drops out. Else, with H the receptance in (x, y), what a turn leaves of it on the mean:
/// R = 1/2 Omega^2 [H_xx + H_yy + i (H_yx - H_xy)]. docs/theory.md, "The criterion on a flexible
/// rotor".
class ForwardReceptance {
  public:
    /// @param form    planar only where the bearings are isotropic
    /// @param places  combinations of planar unknowns; the discretisation must outlive this
    ForwardReceptance(const assembly::Discretization &rotor, results::Form form,
                      const std::vector<assembly::Combination> &places);

    /// R at a spin speed (rad/s), places x places, 1/kg.
    /// @throws linalg::SolverError at an undamped resonance.
    [[nodiscard]] Eigen::MatrixXcd at(double speed);

    /// How far s^H R s can be off, to first order, by rounding of the entries of Z: epsilon times
    /// |u|^H |Z| |u| with the motion u under the imbalances s (places), 1/kg.
    /// @throws linalg::SolverError at an undamped resonance.
    [[nodiscard]] double rounding(double speed, const Eigen::VectorXcd &s);

    /// Unknowns of the linear system, as real numbers.
    [[nodiscard]] int unknowns() const { return 2 * _solver->size(); }
    /// Nothing in the supports (general form: in the rotor either) takes energy out.
    [[nodiscard]] bool undamped() const { return _solver->conserves(); }

  private:
    const assembly::Discretization &_rotor;
    bool _planar;
    std::optional<linalg::HarmonicSolver> _solver; ///< of the bearings as at the last speed
    Eigen::MatrixXcd _places; ///< a column a place; general: (1, -i)/sqrt 2 a place

    [[nodiscard]] Eigen::MatrixXcd motion(double speed, const Eigen::MatrixXcd &forces);
};

/// (R + R^H) / 2.
[[nodiscard]] Eigen::MatrixXcd hermitian_part(const Eigen::MatrixXcd &R);

} // namespace whirl::synchronous

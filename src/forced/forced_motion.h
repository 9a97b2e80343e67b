#pragma once

#include "assembly/rotating_system.h"
#include "linalg/harmonic_solve.h"
#include "model/case.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <vector>

namespace whirl::forced {

inline constexpr std::complex<double> imaginary_unit(0, 1);

/// Two components over time: Re(x exp(i Omega t)), Re(y exp(i Omega t)).
struct Phasor {
    std::complex<double> x;
    std::complex<double> y;
};

/// Forward and backward part: x(t) + i y(t) = a exp(i Omega t) + conj(d) exp(-i Omega t).
struct WhirlParts {
    explicit WhirlParts(const Phasor &motion)
        : a((motion.x + imaginary_unit * motion.y) / 2.0),
          d((motion.x - imaginary_unit * motion.y) / 2.0) {}
    std::complex<double> a, d;
};

/// What a probe sees that looks along `angle`, from x towards y: x cos(angle) + y sin(angle).
[[nodiscard]] std::complex<double> reading(const Phasor &motion, double angle);

/// The imbalances of the rotor as forces on w = x + i y, over planar unknowns, by the spin speed
/// squared: kg m.
[[nodiscard]] Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization);

/// What a bearing's force works on: the deflection of the shaft there, against that of a pedestal.
[[nodiscard]] assembly::Combination
stretch_of_bearing(const assembly::Discretization &discretization, int bearing);

/// Synchronous steady motion of a discretised rotor.
///
/// Planar (isotropic bearings), w = u exp(i Omega t): [K + i Omega C_e - Omega^2 (M - G)] u = f;
/// internal damping drops out, since nothing flexes in rotating axes. General, (x, y):
/// [K + Omega Kc + i Omega (C + Omega G) - Omega^2 M] q = f. Rotating (asymmetric rotor): the
/// motion stands still in rotating axes, [K + Omega Ks + Omega^2 Kss] u = f. docs/theory.md, "The
/// forms".
class ForcedMotion {
  public:
    ForcedMotion(const assembly::Discretization &discretization, results::Form form);

    /// Solves under the forward synchronous imbalances of the rotor.
    /// @throws linalg::SolverError where the rotor is at an undamped resonance.
    void solve(double speed);

    /// Deflection of a combination of planar unknowns in the last solution, m.
    [[nodiscard]] Phasor motion(const assembly::Combination &combination) const;
    /// Force k u + c u' of a bearing on the shaft's support in the last solution, N.
    [[nodiscard]] Phasor bearing_force(int bearing) const;
    /// Planar unknowns x and y of the last solution, a column each; one column where the orbits are
    /// circles, y = -i x.
    [[nodiscard]] Eigen::MatrixXcd planar_motion() const;
    /// Relative error of the last solution by rounding.
    [[nodiscard]] double rounding() const { return _rounding; }
    /// Unknowns of the real linear system.
    [[nodiscard]] int unknowns() const;

  private:
    const assembly::Discretization &_discretization;
    bool _planar;              ///< one complex deflection in each place
    bool _rotating;            ///< solved in rotating axes
    std::vector<double> _rows; ///< of bearing tables, rad/s
    int _piece = -1;           ///< rows below the speeds that the matrices hold for
    std::unique_ptr<assembly::RotatingSystem> _turning;
    std::unique_ptr<linalg::HarmonicSolver> _solver;
    double _speed = 0;
    Eigen::VectorXcd _displacements;
    double _rounding = 0;

    /// Between two rows of bearing tables, in which the coefficients are linear; equal: constant.
    void assemble(double from, double to);
    void assemble_rotating(double from, double to);
    void assemble_planar(double from, double to);
    void assemble_general(double from, double to);
    void enter_piece(double speed);
    void solve_in_rotating_axes(double speed);
    [[nodiscard]] int size() const; ///< of the displacements
    [[nodiscard]] Eigen::VectorXcd imbalance_forces(double speed) const;
};

/// The form the response uses: planar with isotropic bearings, damped or not, else general.
/// @throws model::BadInput where the case forces the planar form and it cannot describe the scene.
[[nodiscard]] results::Formulation response_formulation(const model::Case &scene);

} // namespace whirl::forced

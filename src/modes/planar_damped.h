#pragma once

#include "assembly/discretization.h"
#include "linalg/complex_factors.h"
#include "linalg/definite_pencil.h"
#include "modes/general_spectrum.h"
#include "modes/whirl_mode.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <vector>

namespace whirl::modes {

/// Whirl modes of a damped rotor that is the same from every direction, on w = x + i y alone:
/// Q(l) = l^2 M + l (C + i Cx - i speed G) + K + i Kx - i speed Kc, complex and symmetric. The sign
/// of Im l is the direction of whirl.
///
/// Each eigenvalue starts from one of the rotor without damping and cross coupling, of which the
/// inertia says that none is missing, and is refined by Rayleigh quotient iteration of the full
/// matrices. The argument around a circle of det Q over that of the undamped rotor, the
/// eigenvalues known of both divided out, then counts what is missing within: where there is
/// something (creeping motions against strong dampers), the real form of twice the size takes its
/// place.
class PlanarDamped {
  public:
    /// Bearings as at `bearing_speed` (rad/s).
    PlanarDamped(const assembly::Discretization &discretization, double bearing_speed);

    /// At least `wanted` whirl modes of least modulus, or all. The shape w of a mode goes with
    /// `rotating_value`, its eigenvalue with the sign of the whirl.
    /// @throws linalg::SolverError
    [[nodiscard]] GeneralSpectrum::Modes modes(double speed, int wanted) const;

  private:
    using Complex = std::complex<double>;
    using Sparse = linalg::SymmetricFactor::Sparse;
    struct Pair {
        double undamped = 0; ///< whirl speed of the rotor without damping that it started from
        Complex value;
        Eigen::VectorXcd vector;
        double residual = 0;
        double rounding = 0;
    };
    /// The problem at one speed.
    class AtSpeed;

    const assembly::Discretization &_discretization;
    double _bearing_speed;
    Sparse _pattern; ///< of all matrices, whose values stand in one order
    Eigen::VectorXd _M, _C, _Cx, _G, _K, _Kx, _Kc;
    std::unique_ptr<linalg::DefinitePencil> _undamped; ///< none: no start from there
    mutable std::unique_ptr<linalg::SymmetricFactor> _factor;
    mutable std::unique_ptr<GeneralSpectrum> _general;
    mutable int _failures = 0; ///< speeds at which the undamped rotor was no good start

    [[nodiscard]] bool refined(AtSpeed &problem, int ask, std::vector<Pair> &pairs) const;
    [[nodiscard]] static double complete_radius(AtSpeed &problem, const std::vector<Pair> &pairs,
                                                int wanted);
    [[nodiscard]] GeneralSpectrum::Modes of_real_form(double speed, int wanted) const;
};

} // namespace whirl::modes
